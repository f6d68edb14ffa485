// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_parameter_h
#define moraine_material_parameter_h

#include <deal.II/base/point.h>

#include <functional>
#include <limits>
#include <string>

namespace moraine
{
  /** A number that a point keeps for its material from step to step: an
   * internal variable, or a parameter that differs from place to place. It
   * becomes a field of the points and an array of the output with this name. */
  struct InternalVariable
  {
    std::string name;
    std::string unit;
    double      initial = 0; ///< before the first step

    /** If set, the initial value by place (z = 0 in plane strain).
     * @throws InputError where the value is not allowed. */
    std::function<double(const dealii::Point<3> &)> initial_at = {};
  };

  /** A place, in plane strain with z = 0. */
  template <int dim>
  dealii::Point<3>
  point_in_space(const dealii::Point<dim> &x)
  {
    dealii::Point<3> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = x[d];
    return result;
  }



  /** A parameter of a material: one number for all points, or a field, of which
   * each point keeps its value behind the internal variables. */
  class Parameter
  {
  public:
    /** The same @p value everywhere. */
    Parameter(const double value = 0)
      : value(value)
    {}

    /** The field of number @p index; @p nominal is its value somewhere in the
     * middle. */
    Parameter(const unsigned int index, const double nominal)
      : value(nominal)
      , index(index)
    {}

    bool
    is_field() const
    {
      return index != none;
    }

    /** The value everywhere, of a field the nominal one. */
    double
    nominal() const
    {
      return value * factor;
    }

    /** At the point whose fields are @p fields. */
    double
    at(const double *fields) const
    {
      return factor * (is_field() ? fields[index] : value);
    }

    Parameter
    operator*(const double by) const
    {
      Parameter result = *this;
      result.factor *= by;
      return result;
    }

  private:
    static constexpr unsigned int none =
      std::numeric_limits<unsigned int>::max();

    double       value;
    double       factor = 1;
    unsigned int index  = none;
  };

  /** The numbers that a parameter may be. */
  struct NumberRange
  {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    /** Whether the bounds themselves are allowed. */
    bool includes_lower = false, includes_upper = false;

    bool
    contains(const double x) const
    {
      return (x > lower || (includes_lower && x == lower)) &&
             (x < upper || (includes_upper && x == upper));
    }

    /** For messages, as "a number > -1 and < 0.5". */
    std::string
    describe() const;
  };
} // namespace moraine

#endif
