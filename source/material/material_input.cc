// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/material_input.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <algorithm>
#include <cctype>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The value of @p text at places, at which it must be in @p range. */
    template <int dim>
    std::function<double(const Point<3> &)>
    field(const std::string &text,
          const std::string &section,
          const std::string &key,
          const NumberRange &range)
    {
      const Expression<dim> expression(
        text, place(section, key), 1, {}, /* with_time = */ false);
      return [expression, section, key, range](const Point<3> &x) {
        Point<dim> at;
        for (unsigned int d = 0; d < dim; ++d)
          at[d] = x[d];
        const double value = expression.value(at);
        if (!range.contains(value))
          {
            throw InputError(place(section, key) + ": found " + text_of(value) +
                             " at (" + coordinates(at, 6, ", ") +
                             "), allowed: " + range.describe());
          }
        return value;
      };
    }



    /** "Young modulus" as name of a field: young_modulus. */
    std::string
    field_name(std::string key)
    {
      std::transform(key.begin(), key.end(), key.begin(), [](const char c) {
        return c == ' ' ? '_' : std::tolower(c);
      });
      return key;
    }
  } // namespace



  std::string
  NumberRange::describe() const
  {
    std::string text = "a number";
    if (lower > -std::numeric_limits<double>::infinity())
      text += (includes_lower ? " >= " : " > ") + text_of(lower);
    if (upper < std::numeric_limits<double>::infinity())
      text += std::string(text.size() > 8 ? " and" : "") +
              (includes_upper ? " <= " : " < ") + text_of(upper);
    return text;
  }



  MaterialInput::MaterialInput(const MaterialParameters &parameters,
                               const std::string        &section,
                               const MaterialPlace      &place)
    : section(section)
    , place(place)
    , parameters(parameters)
  {}



  void
  MaterialInput::refuse(const std::string &key,
                        const std::string &allowed) const
  {
    reject(section, key, text(key), allowed);
  }



  double
  MaterialInput::number(const std::string &key) const
  {
    return Utilities::string_to_double(text(key));
  }



  double
  MaterialInput::number(const std::string &key, const NumberRange &range) const
  {
    if (!has(key))
      throw InputError(moraine::place(section, key) +
                       ": is not set, and has no default");
    const auto value = number_from(text(key));
    if (!value || !range.contains(*value))
      refuse(key, range.describe());
    return *value;
  }



  Parameter
  MaterialInput::parameter(const std::string &key,
                           const NumberRange &range,
                           const std::string &unit)
  {
    if (!has(key))
      throw InputError(moraine::place(section, key) +
                       ": is not set, and has no default");
    if (const auto number = number_from(text(key)))
      {
        if (!range.contains(*number))
          refuse(key, range.describe());
        return *number;
      }
    const auto   value   = parameters.dim == 2 ?
                             field<2>(text(key), section, key, range) :
                             field<3>(text(key), section, key, range);
    const double nominal = place.middle ?
                             value(*place.middle) :
                             std::numeric_limits<double>::quiet_NaN();
    variables.push_back({field_name(key), unit, nominal, value});
    return {static_cast<unsigned int>(variables.size() - 1), nominal};
  }



  std::vector<LinearTable::Row>
  MaterialInput::table(const std::string &key)
  {
    std::vector<LinearTable::Row> rows =
      LinearTable(text(key), moraine::place(section, key), "kappa").rows();
    if (rows.size() == 1 && is_table(key))
      refuse(key, "a number, or a table with at least two rows");
    if (rows.front().first != 0)
      refuse(key, "a table whose first kappa is 0");
    const double length = number("Softening length");
    if (length == 0)
      return rows;
    const auto falls =
      std::adjacent_find(rows.begin(),
                         rows.end(),
                         [](const auto &row, const auto &next) {
                           return next.second < row.second;
                         });
    if (falls == rows.end())
      return rows;
    any_falls         = true;
    const double peak = falls->first;
    for (auto row = falls; place.cell_size > 0 && row != rows.end(); ++row)
      row->first = peak + length / place.cell_size * (row->first - peak);
    return rows;
  }



  void
  MaterialInput::check_softening_length() const
  {
    if (number("Softening length") > 0 && !any_falls)
      refuse("Softening length", "nothing; no strength falls");
  }



  std::vector<MaterialKey>
  elastic_keys()
  {
    return {{"Young modulus",
             "Young's modulus E > 0 (stress): a number or an expression in x, "
             "y, z. Required."},
            {"Poisson ratio",
             "Poisson's ratio, larger than -1 and smaller than 0.5: a number "
             "or an expression in x, y, z. Required."}};
  }



  IsotropicElasticity
  read_elasticity(MaterialInput &input)
  {
    IsotropicElasticity result;
    result.young_modulus = input.parameter("Young modulus", {0.}, "stress");
    result.poisson_ratio = input.parameter("Poisson ratio", {-1., 0.5}, "-");
    result.density       = input.number("Density");
    result.fields        = input.fields();
    return result;
  }



  MaterialKey
  softening_key()
  {
    return {
      "Softening length",
      "Of a strength that falls over the plastic strain: the width of the band "
      "for which the table holds (length). Plastic strains beyond the peak are "
      "multiplied by this over the cell size, the mean edge of the cells of a "
      "box mesh, so that a band of one cell dissipates the same energy per "
      "area in any mesh (crack band, Bazant and Oh 1983). 0: the table holds "
      "for cells of any size, and what a band dissipates falls with them.",
      "0",
      patterns::non_negative()};
  }
} // namespace moraine
