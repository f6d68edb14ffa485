// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/expression.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/ranges.h>
#include <moraine/core/silent_errors.h>
#include <moraine/core/words.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What muParser said, out of deal.II's long message. */
    std::string
    parser_message(const std::string &what)
    {
      const std::string marker = "The parser said: ";
      const auto        begin  = what.find(marker);
      if (begin == std::string::npos)
        return what;
      // deal.II breaks long lines; a blank or ruled line ends the text.
      std::istringstream lines(what.substr(begin + marker.size()));
      std::string        said, line;
      while (std::getline(lines, line))
        {
          line = Utilities::trim(line);
          if (line.empty() || line[0] == '-' || line[0] == '*')
            break;
          said += (said.empty() ? "" : " ") + line;
        }
      return said.substr(0, said.find_last_not_of('.') + 1);
    }



    template <int dim>
    std::shared_ptr<FunctionParser<dim>>
    compile(const std::vector<std::string>      &components,
            const std::string                   &variables,
            const std::map<std::string, double> &constants,
            const bool                           has_time,
            const std::string                   &place,
            const std::string                   &allowed)
    {
      for (const std::string &component : components)
        if (is_random(component))
          throw InputError(place + ": found '" + component +
                           "', whose value is another one each time it is "
                           "asked for. Allowed: " +
                           allowed);
      auto parser = std::make_shared<FunctionParser<dim>>(components.size());
      auto names  = constants;
      names.emplace("pi", numbers::PI);
      const SilentErrors silent;
      // deal.II reports a mistake in the text at the latest when it is
      // evaluated.
      for (unsigned int c = 0; c < components.size(); ++c)
        try
          {
            if (c == 0)
              parser->initialize(variables, components, names, has_time);
            parser->value(Point<dim>(), c);
          }
        catch (const ExceptionBase &e)
          {
            throw InputError(place + ": found '" + components[c] +
                             "': " + parser_message(e.what()) +
                             ". Allowed: " + allowed);
          }
        catch (...) // muParser's own, which deal.II does not catch
          {
            throw InputError(place + ": found '" + components[c] +
                             "' with constants of which one is called like a "
                             "variable or a function, or has no proper name. "
                             "Allowed: " +
                             allowed);
          }
      return parser;
    }



    /** "a ? b : c" is muParser's choice, not a table. */
    bool
    is_table(const std::string &text)
    {
      return text.find(':') != std::string::npos &&
             text.find('?') == std::string::npos;
    }



    void
    check_not_empty(const std::vector<std::string> &components,
                    const std::string              &text,
                    const std::string              &place,
                    const std::string              &allowed)
    {
      for (const std::string &component : components)
        if (component.empty())
          throw InputError(place + ": found '" + text +
                           "', which has an empty part. Allowed: " + allowed);
    }
  } // namespace



  template <int dim>
  Expression<dim>::Expression(const std::string                   &text,
                              const std::string                   &place,
                              const unsigned int                   n_components,
                              const std::map<std::string, double> &constants,
                              const bool                           with_time)
    : expression_text(Utilities::trim(text))
    , origin(place)
    , with_time(with_time)
    , components(split_outside_brackets(expression_text, ";,"))
  {
    const std::string variables =
      FunctionParser<dim>::default_variable_names() + (with_time ? ",t" : "");
    std::string allowed =
      (n_components == 1 ? std::string("an expression") :
                           std::to_string(n_components) +
                             " expressions, separated by ';' or ',',") +
      " in " + variables +
      (constants.empty() ? " with the constant pi" : " with the constants pi");
    for (const auto &constant : constants)
      allowed += ", " + constant.first;

    check_not_empty(components, expression_text, place, allowed);
    if (components.size() != n_components)
      throw InputError(place + ": found '" + expression_text + "', which has " +
                       std::to_string(components.size()) +
                       " components. Allowed: " + allowed);

    for (const std::string &component : components)
      if (const auto number = plain_number(component))
        numbers.push_back(*number);
    if (numbers.size() == components.size())
      return;
    numbers.clear();
    parser =
      compile<dim>(components, variables, constants, with_time, place, allowed);
    if (has_name(expression_text, {"x", "y", "z", "t"}))
      return;
    for (unsigned int c = 0; c < components.size(); ++c)
      numbers.push_back(parser->value(Point<dim>(), c));
    // value() tells of what is none.
    if (!all_of(numbers,
                [](const double number) { return std::isfinite(number); }))
      numbers.clear();
  }



  template <int dim>
  double
  Expression<dim>::value(const Point<dim>  &p,
                         const double       t,
                         const unsigned int component) const
  {
    AssertIndexRange(component, components.size());
    if (!numbers.empty())
      return numbers[component];

    parser->set_time(t);
    const double result = parser->value(p, component);
    if (!std::isfinite(result))
      throw InputError(origin + ": '" + components[component] + "' is " +
                       text_of(result) + ", not a finite number, at (" +
                       coordinates(p) + ")" +
                       (with_time ? " and t = " + text_of(t) : "") + ".");
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  Expression<dim>::vector_value(const Point<dim> &p, const double t) const
  {
    AssertDimension(components.size(), dim);
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = value(p, t, d);
    return result;
  }



  LinearTable::LinearTable(const std::string &text,
                           const std::string &place,
                           const std::string &argument)
  {
    if (const auto number = number_from(Utilities::trim(text)))
      {
        table.emplace_back(0., *number);
        return;
      }

    const std::string row     = "'" + argument + ": value'";
    const std::string allowed = "a number, or a table '" + argument +
                                ": value, " + argument +
                                ": value, ...' with increasing " + argument;
    const auto pairs = split_outside_brackets(text, ";,");
    check_not_empty(pairs, text, place, allowed);
    if (!is_table(text))
      throw InputError(place + ": found '" + text + "'. Allowed: " + allowed);
    for (const std::string &pair : pairs)
      {
        const auto sides = split_outside_brackets(pair, ":");
        const auto x     = number_from(sides.front());
        const auto value = number_from(sides.back());
        if (sides.size() != 2 || !x || !value)
          throw InputError(place + ": found '" + pair +
                           "' in a table; allowed: " + row + ", two numbers");
        if (!table.empty() && *x <= table.back().first)
          throw InputError(place + ": found '" + pair + "' in a table, but " +
                           argument + " must increase");
        table.emplace_back(*x, *value);
      }
  }



  double
  LinearTable::value(const double x) const
  {
    const auto next = std::lower_bound(table.begin(),
                                       table.end(),
                                       x,
                                       [](const Row &row, const double there) {
                                         return row.first < there;
                                       });
    if (next == table.begin())
      return table.front().second;
    if (next == table.end())
      return table.back().second;
    const auto &[x0, f0] = *(next - 1);
    const auto &[x1, f1] = *next;
    // Written so that the ends are met exactly.
    const double s = (x - x0) / (x1 - x0);
    return (1 - s) * f0 + s * f1;
  }



  TimeCurve::TimeCurve(const std::string &text, const std::string &place)
    : curve_text(Utilities::trim(text))
    , origin(place)
  {
    const std::string allowed =
      "an expression in t with the constant pi, or a table 'time: value, "
      "time: value, ...' with increasing times";
    const auto components = split_outside_brackets(curve_text, ";,");
    check_not_empty(components, curve_text, place, allowed);

    if (is_table(curve_text) || plain_number(curve_text))
      table = LinearTable(curve_text, place, "time");
    else if (components.size() == 1)
      parser = compile<1>(components, "t", {}, false, place, allowed);
    else
      throw InputError(place + ": found '" + curve_text +
                       "'. Allowed: " + allowed);
  }



  double
  TimeCurve::value(const double t) const
  {
    if (parser)
      {
        if (t == last_time)
          return last_value;
        const double result = parser->value(Point<1>(t));
        if (std::isfinite(result))
          {
            last_time  = t;
            last_value = result;
            return result;
          }
        throw InputError(origin + ": '" + curve_text + "' is " +
                         text_of(result) +
                         ", not a finite number, at t = " + text_of(t) + ".");
      }
    return table.value(t);
  }



  std::vector<TimeCurve>
  time_curves(const std::string &text,
              const std::string &place,
              const unsigned int n)
  {
    // Commas separate the rows of a table.
    const auto parts = is_table(text) ? split_outside_brackets(text, ";") :
                                        split_outside_brackets(text, ";,");
    const std::string allowed =
      std::to_string(n) + " expressions in t or tables, separated by ';'";
    check_not_empty(parts, text, place, allowed);
    if (parts.size() != n)
      throw InputError(place + ": found '" + text + "', which has " +
                       std::to_string(parts.size()) +
                       " components. Allowed: " + allowed);
    std::vector<TimeCurve> curves;
    for (const std::string &part : parts)
      curves.emplace_back(part, place);
    return curves;
  }



  template class Expression<2>;
  template class Expression<3>;
} // namespace moraine
