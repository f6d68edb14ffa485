// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_stress_rows_h
#define moraine_output_stress_rows_h

#include <moraine/points/point_fields.h>

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
} // namespace moraine

#endif
