// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/soil_strength.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <set>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    double
    value_of(const SoilParameters::Table &table, const double kappa)
    {
      for (std::size_t i = 1; i < table.size(); ++i)
        if (kappa < table[i].first)
          {
            const auto &[k_0, v_0] = table[i - 1];
            const auto &[k_1, v_1] = table[i];
            return v_0 + (kappa - k_0) * (v_1 - v_0) / (k_1 - k_0);
          }
      return table.back().second;
    }



    constexpr double per_degree = numbers::PI / 180;
  } // namespace



  SoilStrengthTables::SoilStrengthTables(const SoilParameters &parameters)
    : scales(parameters.scales)
  {
    const std::array<const SoilParameters::Table *, 4> tables{
      {&parameters.cohesion,
       &parameters.friction_angle,
       &parameters.dilation_angle,
       &parameters.tensile_strength}};
    const std::array<double, 4> units{{1, per_degree, per_degree, 1}};

    std::set<double> kinks;
    for (const auto *table : tables)
      for (const auto &row : *table)
        kinks.insert(row.first);
    Assert(!kinks.empty() && *kinks.begin() == 0,
           ExcMessage("A strength is not given from kappa = 0 on."));

    for (auto kink = kinks.begin(); kink != kinks.end(); ++kink)
      {
        Segment    segment{*kink, {}, {}};
        const auto next = std::next(kink);
        for (unsigned int i = 0; i < tables.size(); ++i)
          {
            segment.value[i] = units[i] * value_of(*tables[i], *kink);
            if (next == kinks.end())
              continue;
            const double at_end = units[i] * value_of(*tables[i], *next);
            // Infinity does not change.
            if (at_end != segment.value[i])
              segment.slope[i] = (at_end - segment.value[i]) / (*next - *kink);
          }
        segments.push_back(segment);
      }
    // Tables that say the same number again.
    while (segments.size() > 1 &&
           segments[segments.size() - 2].slope == std::array<double, 4>{})
      segments.pop_back();
  }



  SoilStrengthTables
  SoilStrengthTables::over(const double factor) const
  {
    SoilStrengthTables weaker = *this;
    weaker.reduction *= factor;
    return weaker;
  }



  unsigned int
  SoilStrengthTables::segment_at(const double kappa) const
  {
    unsigned int segment = 0;
    while (segment + 1 < segments.size() &&
           segments[segment + 1].kappa <= kappa)
      ++segment;
    return segment;
  }



  SoilStrengthTables::Row
  SoilStrengthTables::at(const double       kappa,
                         const unsigned int segment,
                         const double      *fields) const
  {
    Segment               start = segments[segment];
    std::array<double, 4> value;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const double scale = scales[i].at(fields);
        start.slope[i] *= scale;
        value[i] = scale * start.value[i];
        // Infinity does not change.
        if (start.slope[i] != 0)
          value[i] += start.slope[i] * (kappa - start.kappa);
      }
    Row row;
    row.value.cohesion = value[0] / reduction;
    row.slope.cohesion = start.slope[0] / reduction;
    row.value.tension  = value[3] / reduction;
    row.slope.tension  = start.slope[3] / reduction;

    const double tangent = std::tan(value[1]) / reduction;
    const double phi     = reduction == 1 ? value[1] : std::atan(tangent);
    row.value.sin_phi    = std::sin(phi);
    row.value.cos_phi    = std::cos(phi);
    // d tan(phi) / F = (1 + tan(phi)^2) d phi / F
    const double tan_full = tangent * reduction;
    const double d_phi    = start.slope[1] / reduction *
                         (1 + tan_full * tan_full) / (1 + tangent * tangent);
    row.slope.sin_phi = row.value.cos_phi * d_phi;
    row.slope.cos_phi = -row.value.sin_phi * d_phi;

    const bool as_friction = value[2] >= phi;
    row.value.sin_psi = as_friction ? row.value.sin_phi : std::sin(value[2]);
    row.slope.sin_psi =
      as_friction ? row.slope.sin_phi : std::cos(value[2]) * start.slope[2];
    return row;
  }



  namespace
  {
    /** A strength and what multiplies it, from a number, a table over kappa or
     * an expression. */
    void
    read_strength(MaterialInput         &input,
                  const std::string     &key,
                  const NumberRange     &range,
                  const std::string     &unit,
                  SoilParameters::Table &table,
                  Parameter             &scale)
    {
      if (input.is_table(key))
        {
          table = input.table(key);
          for (const auto &[kappa, value] : table)
            if (!range.contains(value))
              input.refuse(key,
                           "values of the table that are each " +
                             range.describe());
          return;
        }
      const Parameter parameter = input.parameter(key, range, unit);
      if (parameter.is_field())
        {
          table = {{0., 1.}};
          scale = parameter;
        }
      else
        table = {{0., parameter.nominal()}};
    }



    const NumberRange strength_range{0.,
                                     std::numeric_limits<double>::infinity(),
                                     true};
    const NumberRange angle_range{0., 60., true, true};

    /** Angles below are radians. */
    constexpr double least_angle = 1;

    void
    read_angle(MaterialInput         &input,
               const std::string     &key,
               SoilParameters::Table &table,
               Parameter             &scale)
    {
      read_strength(input, key, angle_range, "degree", table, scale);
      for (const auto &[kappa, angle] : table)
        if (!scale.is_field() && angle > 0 && angle < least_angle)
          input.refuse(key,
                       "0, or degrees from 1 on; " + text_of(angle) +
                         " rad are " + text_of(angle / per_degree, 3) +
                         " degrees");
    }



    /** Refuse a dilation angle above the friction angle: in tables, and of
     * fields where points start. */
    void
    check_dilation(const MaterialInput &input, SoilParameters &soil)
    {
      const std::string      key     = "Dilation angle";
      const std::string      allowed = "0 to 'Friction angle' = ";
      SoilParameters::Table &phi     = soil.friction_angle;
      SoilParameters::Table &psi     = soil.dilation_angle;
      const Parameter        of_phi = soil.scales[1], of_psi = soil.scales[2];
      if (!of_phi.is_field() && !of_psi.is_field())
        {
          for (const auto *table : {&phi, &psi})
            for (const auto &row : *table)
              if (value_of(psi, row.first) > value_of(phi, row.first))
                input.refuse(key, allowed + text_of(value_of(phi, row.first)));
          return;
        }
      std::vector<InternalVariable> &fields = soil.elasticity.fields;
      fields.back().initial_at              = [        =,
                                  section = input.section,
                                  dim     = input.dim(),
                                  all     = fields](const Point<3> &x) {
        std::vector<double> values;
        for (const InternalVariable &field : all)
          values.push_back(field.initial_at(x));
        const double friction = phi[0].second * of_phi.at(values.data());
        const double dilation = psi[0].second * of_psi.at(values.data());
        if (dilation > friction)
          throw InputError(
            place(section, key) + ": found " + text_of(dilation) + " at (" +
            (dim == 2 ? coordinates(Point<2>(x[0], x[1]), 6, ", ") :
                                     coordinates(x, 6, ", ")) +
            "), allowed: " + allowed + text_of(friction));
        return values.back();
      };
    }



    /** `Tensile strength` and `Largest plastic dilation`. */
    void
    read_tension(MaterialInput &input, SoilParameters &parameters)
    {
      constexpr double no_limit = std::numeric_limits<double>::infinity();
      if (input.has("Largest plastic dilation"))
        {
          const auto number =
            number_from(input.text("Largest plastic dilation"));
          if (!number || !(*number > 0))
            input.refuse("Largest plastic dilation",
                         "nothing, or a number > 0");
          parameters.largest_dilation = *number;
        }
      const std::string key = "Tensile strength";
      const double      phi = parameters.friction_angle[0].second;
      const double      psi = parameters.dilation_angle[0].second;
      if (input.text(key) == "none")
        {
          if (phi > 0 && psi == 0)
            input.refuse(
              key,
              "a number >= 0; 'none' needs a dilation angle > 0 or no "
              "friction");
          parameters.tensile_strength = {{0., no_limit}};
          return;
        }
      read_strength(input,
                    key,
                    strength_range,
                    "stress",
                    parameters.tensile_strength,
                    parameters.scales[3]);
      const auto &scales = parameters.scales;
      if (scales[0].is_field() || scales[1].is_field() ||
          scales[3].is_field() || phi == 0)
        return;
      const double apex =
        parameters.cohesion[0].second / std::tan(phi * per_degree);
      // As rounded in the message.
      if (parameters.tensile_strength[0].second > apex * (1 + 1e-3))
        input.refuse(key, "up to c cot(phi) = " + text_of(apex, 4));
    }
  } // namespace



  namespace
  {
    const std::string forms =
      ": a number, an expression in x, y, z, or a table 'kappa: value, kappa: "
      "value, ...' over the accumulated plastic strain.";
  }



  std::vector<MaterialKey>
  undrained_keys()
  {
    std::vector<MaterialKey> keys = elastic_keys();
    keys.push_back(
      {"Shear strength",
       "The undrained shear strength s_u > 0 (stress)" + forms + " Required."});
    keys.push_back(softening_key());
    return keys;
  }



  std::vector<MaterialKey>
  soil_keys()
  {
    std::vector<MaterialKey> keys = elastic_keys();
    keys.push_back({"Cohesion",
                    "Cohesion c (stress)" + forms +
                      " Larger than 0 where the friction angle is 0.",
                    "0"});
    keys.push_back({"Friction angle",
                    "Angle of internal friction phi (degrees, 0 to 60)" + forms,
                    "0"});
    keys.push_back(
      {"Dilation angle",
       "Dilation angle psi (degrees, at most the friction angle)" + forms,
       "0"});
    keys.push_back(softening_key());
    return keys;
  }



  SoilParameters
  read_soil(MaterialInput &input, const bool has_tension)
  {
    SoilParameters result;
    result.elasticity = read_elasticity(input);
    read_strength(input,
                  "Cohesion",
                  strength_range,
                  "stress",
                  result.cohesion,
                  result.scales[0]);
    read_angle(input,
               "Friction angle",
               result.friction_angle,
               result.scales[1]);
    read_angle(input,
               "Dilation angle",
               result.dilation_angle,
               result.scales[2]);
    if (!result.scales[0].is_field() && !result.scales[1].is_field() &&
        result.cohesion[0].second == 0 && result.friction_angle[0].second == 0)
      input.refuse("Cohesion", "a number > 0, as 'Friction angle' is 0");
    if (has_tension)
      read_tension(input, result);
    input.check_softening_length();
    result.elasticity.fields = input.fields();
    check_dilation(input, result);
    return result;
  }



  SoilParameters
  read_undrained(MaterialInput &input)
  {
    SoilParameters result;
    result.elasticity = read_elasticity(input);
    read_strength(input,
                  "Shear strength",
                  {0.},
                  "stress",
                  result.cohesion,
                  result.scales[0]);
    result.tensile_strength = {{0., std::numeric_limits<double>::infinity()}};
    input.check_softening_length();
    result.elasticity.fields = input.fields();
    return result;
  }
} // namespace moraine
