// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/cell_materials.h>

#include <algorithm>
#include <numeric>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  CellMaterials<dim>::update(const State<dim> &state)
  {
    const PointSet<dim> &points = state.material_points();
    const unsigned int   n_cells =
      state.grid().mesh().triangulation().n_active_cells();
    body_of_cell.assign(n_cells, 0);
    stiffness.assign(n_cells, state.material(0).elastic_stiffness());
    densities.assign(n_cells, state.material(0).density());
    std::vector<double> volumes;
    for (const auto &in_cell : points.cells())
      {
        const unsigned int cell  = in_cell.cell->active_cell_index();
        const unsigned int first = points.body(in_cell.first);
        unsigned int       same  = in_cell.first;
        while (same < in_cell.last && points.body(same) == first)
          ++same;
        if (same == in_cell.last)
          {
            body_of_cell[cell] = first;
            stiffness[cell]    = state.material(first).elastic_stiffness();
            densities[cell]    = state.material(first).density();
            continue;
          }
        volumes.clear();
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          {
            if (points.body(p) >= volumes.size())
              volumes.resize(points.body(p) + 1, 0.);
            volumes[points.body(p)] += points.volume(p);
          }
        const double volume =
          std::accumulate(volumes.begin(), volumes.end(), 0.);
        const auto largest = std::max_element(volumes.begin(), volumes.end());
        body_of_cell[cell] = largest - volumes.begin();
        stiffness[cell]    = {0., 0.};
        densities[cell]    = 0.;
        for (unsigned int body = 0; body < volumes.size(); ++body)
          if (volumes[body] > 0)
            {
              const LameConstants C = state.material(body).elastic_stiffness();
              const double        share = volumes[body] / volume;
              stiffness[cell].lambda += share * C.lambda;
              stiffness[cell].mu += share * C.mu;
              densities[cell] += share * state.material(body).density();
            }
      }
  }



  template class CellMaterials<2>;
  template class CellMaterials<3>;
} // namespace moraine
