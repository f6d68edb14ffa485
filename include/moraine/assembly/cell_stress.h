// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_cell_stress_h
#define moraine_assembly_cell_stress_h

#include <moraine/points/point_set.h>

#include <optional>

namespace moraine
{
  /** The mean stress of the points in a cell of this rank, by their volumes;
   * nothing if there are none. */
  template <int dim>
  std::optional<dealii::SymmetricTensor<2, dim>>
  stress_in_cell(const PointSet<dim> &points, const unsigned int cell)
  {
    const auto [first, last] = points.points_in(cell);
    dealii::SymmetricTensor<2, dim> sum;
    double                          volume = 0;
    for (unsigned int p = first; p < last; ++p)
      {
        const dealii::SymmetricTensor<2, 3> sigma =
          points.stress_field()(points.values(p));
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d; e < dim; ++e)
            sum[d][e] += points.volume(p) * sigma[d][e];
        volume += points.volume(p);
      }
    if (!(volume > 0))
      return {};
    return sum / volume;
  }
} // namespace moraine

#endif
