// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/cell_materials.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of each body, as first components, @f$\sum_p N_a v_p@f$ at the nodes
     * where @p wanted is not zero; at others maybe less. Collective. */
    template <int dim>
    std::vector<std::vector<Tensor<1, dim>>>
    volumes_at_nodes(const State<dim>                  &state,
                     const std::vector<Tensor<1, dim>> &wanted,
                     const unsigned int                 n_bodies)
    {
      const PointSet<dim>                     &points = state.material_points();
      const Basis<dim>                        &basis  = state.point_basis();
      StencilBlock<dim>                        block;
      std::vector<std::vector<Tensor<1, dim>>> volumes(
        n_bodies, std::vector<Tensor<1, dim>>(wanted.size()));
      for (unsigned int g = 0; g < basis.n_batches(); ++g)
        {
          const auto nodes = basis.batch_nodes(g);
          if (std::none_of(nodes.begin(), nodes.end(), [&](const auto node) {
                return wanted[node][0] > 0;
              }))
            continue;
          basis.evaluate(g, block);
          for (unsigned int i = 0; i < block.n_points; ++i)
            {
              const unsigned int p = block.points[i];
              for (unsigned int a = 0; a < block.n_nodes; ++a)
                volumes[points.body(p)][block.nodes[a]][0] +=
                  block.N(i)[a] * points.volume(p);
            }
        }
      for (auto &of_body : volumes)
        state.grid().sum_over_ranks(of_body);
      return volumes;
    }
  } // namespace



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
    unsigned int        n_bodies = 1;
    for (const auto &in_cell : points.cells())
      {
        volumes.clear();
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          {
            if (points.body(p) >= volumes.size())
              volumes.resize(points.body(p) + 1, 0.);
            volumes[points.body(p)] += points.volume(p);
          }
        n_bodies = std::max<unsigned int>(n_bodies, volumes.size());
        take_mean(state, in_cell.cell->active_cell_index(), volumes);
      }
    n_bodies = Utilities::MPI::max(n_bodies, state.grid().communicator());
    if (n_bodies > 1)
      update_cells_without_points(state, n_bodies);
  }



  template <int dim>
  void
  CellMaterials<dim>::take_mean(const State<dim>          &state,
                                const unsigned int         cell,
                                const std::vector<double> &volumes)
  {
    const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.);
    if (!(volume > 0))
      return;
    body_of_cell[cell] =
      std::max_element(volumes.begin(), volumes.end()) - volumes.begin();
    stiffness[cell] = {0., 0.};
    densities[cell] = 0.;
    for (unsigned int body = 0; body < volumes.size(); ++body)
      if (volumes[body] > 0)
        {
          const LameConstants C     = state.material(body).elastic_stiffness();
          const double        share = volumes[body] / volume;
          stiffness[cell].lambda += share * C.lambda;
          stiffness[cell].mu += share * C.mu;
          densities[cell] += share * state.material(body).density();
        }
  }



  template <int dim>
  void
  CellMaterials<dim>::update_cells_without_points(const State<dim>  &state,
                                                  const unsigned int n_bodies)
  {
    const GridSpace<dim>       &space = state.grid();
    const auto                 &tria  = space.mesh().triangulation();
    const unsigned int          n     = space.nodes_per_cell();
    std::vector<bool>           has_points(tria.n_active_cells(), false);
    std::vector<unsigned int>   cells;
    std::vector<Tensor<1, dim>> wanted(space.n_nodes());
    for (const auto &in_cell : state.material_points().cells())
      has_points[in_cell.cell->active_cell_index()] = true;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned() && space.is_active(cell) &&
          !has_points[cell->active_cell_index()])
        {
          cells.push_back(cell->active_cell_index());
          for (unsigned int a = 0; a < n; ++a)
            wanted[space.cell_nodes(cell)[a]][0] = 1;
        }
    if (!Utilities::MPI::logical_or(!cells.empty(), space.communicator()))
      return;
    // Points of one rank touch nodes of another's cells.
    space.sum_over_ranks(wanted);
    const auto          at_nodes = volumes_at_nodes(state, wanted, n_bodies);
    std::vector<double> volumes(n_bodies);
    for (const unsigned int cell : cells)
      {
        for (unsigned int body = 0; body < n_bodies; ++body)
          {
            volumes[body] = 0;
            for (unsigned int a = 0; a < n; ++a)
              volumes[body] += at_nodes[body][space.cell_nodes(cell)[a]][0];
          }
        take_mean(state, cell, volumes);
      }
  }



  template class CellMaterials<2>;
  template class CellMaterials<3>;
} // namespace moraine
