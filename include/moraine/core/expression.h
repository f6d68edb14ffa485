// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_expression_h
#define moraine_core_expression_h

#include <deal.II/base/point.h>

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dealii
{
  template <int dim>
  class FunctionParser;
}

namespace moraine
{
  /**
   * A function of place, and time if wanted, given as text in muParser syntax,
   * with the variables x, y (, z), t and the constant pi. Several components
   * are separated by ';' or ',' outside brackets. Copies share the compiled
   * text; not for use by several threads at once.
   */
  template <int dim>
  class Expression
  {
  public:
    /**
     * @param text the expressions
     * @param place where the text stands, for messages: see place() in
     * exceptions.h
     * @param n_components how many there must be
     * @param constants further names with their values
     * @param with_time whether the text may name t
     * @throw InputError if the text cannot be understood
     */
    Expression(const std::string                   &text,
               const std::string                   &place,
               const unsigned int                   n_components = 1,
               const std::map<std::string, double> &constants    = {},
               const bool                           with_time    = true);

    /**
     * One component at place @p p and time @p t.
     * @throw InputError naming place, text, x and t if that is not a number.
     */
    double
    value(const dealii::Point<dim> &p,
          const double              t         = 0.,
          const unsigned int        component = 0) const;

    /** All components at @p p and @p t; n_components must be dim. */
    dealii::Tensor<1, dim>
    vector_value(const dealii::Point<dim> &p, const double t = 0.) const;

  private:
    std::string              expression_text;
    std::string              origin;
    bool                     with_time;
    std::vector<std::string> components;

    /** Values of the components if none names a variable; else empty. */
    std::vector<double> numbers;

    std::shared_ptr<dealii::FunctionParser<dim>> parser;
  };


  /**
   * A function of one number given by a table "0: 0, 1: 2.5, 2: 2.5" of
   * arguments and values, linear in between and constant outside; or by one
   * number, which is its value everywhere.
   */
  class LinearTable
  {
  public:
    using Row = std::pair<double, double>;

    /** No rows. */
    LinearTable() = default;

    /**
     * @param text the table or the number
     * @param place where the text stands, for messages
     * @param argument what messages call the argument, like "time"
     * @throw InputError if @p text is neither, or if arguments do not increase.
     */
    LinearTable(const std::string &text,
                const std::string &place,
                const std::string &argument);

    /** Argument and value of each row; a number is the row 0: number. */
    const std::vector<Row> &
    rows() const
    {
      return table;
    }

    double
    value(const double x) const;

  private:
    std::vector<Row> table;
  };


  /**
   * A number that changes with time: an expression in t ("min(t, 1)"), or a
   * table "0: 0, 1: 2.5, 2: 2.5" of times and values, linear in between and
   * constant outside.
   */
  class TimeCurve
  {
  public:
    /**
     * @throw InputError if @p text is neither, or if times do not increase.
     */
    TimeCurve(const std::string &text, const std::string &place);

    /** @throw InputError naming place, text and t if that is not a number. */
    double
    value(const double t) const;

    /** Of a table; none of an expression. */
    const std::vector<LinearTable::Row> &
    rows() const
    {
      return table.rows();
    }

  private:
    std::string                                curve_text;
    std::string                                origin;
    LinearTable                                table;
    std::shared_ptr<dealii::FunctionParser<1>> parser;

    /** Many points ask for one time in turn. */
    mutable double last_time  = std::numeric_limits<double>::quiet_NaN();
    mutable double last_value = 0;
  };


  /**
   * @p n curves separated by ';', or by ',' outside brackets if none of them
   * is a table.
   * @throw InputError as for one, and for another number of them.
   */
  std::vector<TimeCurve>
  time_curves(const std::string &text,
              const std::string &place,
              const unsigned int n);
} // namespace moraine

#endif
