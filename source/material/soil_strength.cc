// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/soil_strength.h>

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



    constexpr double degree = 3.14159265358979323846 / 180;
  } // namespace



  SoilStrengthTables::SoilStrengthTables(const SoilParameters &parameters)
  {
    const std::array<const SoilParameters::Table *, 4> tables{
      {&parameters.cohesion,
       &parameters.friction_angle,
       &parameters.dilation_angle,
       &parameters.tensile_strength}};
    const std::array<double, 4> units{{1, degree, degree, 1}};

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
  SoilStrengthTables::at(const double kappa, const unsigned int segment) const
  {
    const Segment        &start = segments[segment];
    std::array<double, 4> value;
    for (unsigned int i = 0; i < 4; ++i)
      value[i] =
        start.value[i] +
        (start.slope[i] == 0 ? 0. : start.slope[i] * (kappa - start.kappa));
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
} // namespace moraine
