// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_stress_rows_h
#define moraine_output_stress_rows_h

#include <moraine/points/point_set.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace moraine
{
  /** Where the nine components of a symmetric tensor that is stored as stress
   * is are found; one past the end stands for 0. */
  template <int dim>
  inline constexpr std::array<unsigned int, 9> tensor_components =
    dim == 2 ? std::array<unsigned int, 9>{{0, 3, 4, 3, 1, 4, 4, 4, 2}} :
               std::array<unsigned int, 9>{{0, 3, 4, 3, 1, 5, 4, 5, 2}};

  /** Of the n_stress_components numbers @p sigma. */
  inline double
  mean_stress(const double *sigma)
  {
    return (sigma[0] + sigma[1] + sigma[2]) / 3.;
  }

  /** @f$\sqrt{3/2\, s:s}@f$ of the n_stress_components numbers @p sigma,
   * @f$s@f$ the deviator. */
  template <int dim>
  double
  von_mises_stress(const double *sigma)
  {
    const double mean   = mean_stress(sigma);
    double       square = 0;
    for (unsigned int c = 0; c < 3; ++c)
      square += (sigma[c] - mean) * (sigma[c] - mean);
    for (unsigned int c = 3; c < n_stress_components<dim>; ++c)
      square += 2. * sigma[c] * sigma[c];
    return std::sqrt(1.5 * square);
  }

  /** Whether there are undrained materials, so that stress is not effective. */
  template <int dim>
  bool
  has_excess_pressure(const PointFields &fields)
  {
    return fields.find(FieldNames<dim>::excess_pressure).exists();
  }

  /** Cauchy's excess pressure of point @p p; @f$p_e@f$ is J times that. */
  template <int dim>
  double
  excess_pressure(const PointSet<dim> &points, const unsigned int p)
  {
    const double      *values = points.values(p);
    const PointFields &fields = points.fields();
    const auto         v_0    = fields.find(FieldNames<dim>::initial_volume);
    return fields.find(FieldNames<dim>::excess_pressure)(values) /
           (v_0.exists() ? points.volume(p) / v_0(values) : 1.);
  }

  /** The n_stress_components numbers @f$\sigma + p_e/J\, 1@f$ of point @p p. */
  template <int dim>
  std::array<double, n_stress_components<dim>>
  effective_stress(const PointSet<dim> &points, const unsigned int p)
  {
    std::array<double, n_stress_components<dim>> sigma;
    std::copy_n(points.values(p) + points.stress_offset(),
                sigma.size(),
                sigma.begin());
    for (unsigned int c = 0; c < 3; ++c)
      sigma[c] += excess_pressure(points, p);
    return sigma;
  }
} // namespace moraine

#endif
