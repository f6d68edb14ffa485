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
    /** In a list of sums over points: volume times lambda, volume times mu, and
     * from here on the volumes of bodies. */
    constexpr unsigned int first_body = 2;

    /** Add @p volume of point @p p to the sums. */
    template <int dim, class Add>
    void
    add_point(const State<dim>  &state,
              const unsigned int p,
              const double       volume,
              const Add         &add)
    {
      const LameConstants C = elastic_stiffness(state, p);
      add(0, volume * C.lambda);
      add(1, volume * C.mu);
      add(first_body + state.material_points().body(p), volume);
    }



    /** The sums, as first components, of @f$N_a v_p@f$ at the nodes where @p
     * wanted is not zero; at others maybe less. Collective. */
    template <int dim>
    std::vector<std::vector<Tensor<1, dim>>>
    sums_at_nodes(const State<dim>                  &state,
                  const std::vector<Tensor<1, dim>> &wanted,
                  const unsigned int                 n_sums)
    {
      const PointSet<dim>                     &points = state.material_points();
      const Basis<dim>                        &basis  = state.point_basis();
      StencilBlock<dim>                        block;
      std::vector<std::vector<Tensor<1, dim>>> sums(
        n_sums, std::vector<Tensor<1, dim>>(wanted.size()));
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
              add_point(state,
                        p,
                        points.volume(p),
                        [&](const unsigned int sum, const double value) {
                          for (unsigned int a = 0; a < block.n_nodes; ++a)
                            sums[sum][block.nodes[a]][0] +=
                              block.N(i)[a] * value;
                        });
            }
        }
      for (auto &sum : sums)
        state.grid().sum_over_ranks(sum);
      return sums;
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
    std::vector<double> sums;
    unsigned int        n_sums     = first_body + 1;
    bool                is_uniform = true;
    for (const auto &in_cell : points.cells())
      {
        sums.assign(n_sums, 0.);
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          add_point(state,
                    p,
                    points.volume(p),
                    [&sums](const unsigned int sum, const double value) {
                      if (sum >= sums.size())
                        sums.resize(sum + 1, 0.);
                      sums[sum] += value;
                    });
        n_sums = std::max<unsigned int>(n_sums, sums.size());
        is_uniform =
          is_uniform &&
          state.material(points.body(in_cell.first)).has_uniform_stiffness();
        take_mean(state, in_cell.cell->active_cell_index(), sums);
      }
    n_sums = Utilities::MPI::max(n_sums, state.grid().communicator());
    if (Utilities::MPI::logical_or(n_sums > first_body + 1 || !is_uniform,
                                   state.grid().communicator()))
      update_cells_without_points(state, n_sums);
  }



  template <int dim>
  void
  CellMaterials<dim>::take_mean(const State<dim>          &state,
                                const unsigned int         cell,
                                const std::vector<double> &sums)
  {
    const auto   volumes = sums.begin() + first_body;
    const double volume  = std::accumulate(volumes, sums.end(), 0.);
    if (!(volume > 0))
      return;
    body_of_cell[cell] = std::max_element(volumes, sums.end()) - volumes;
    stiffness[cell]    = {sums[0] / volume, sums[1] / volume};
    densities[cell]    = 0.;
    for (unsigned int sum = first_body; sum < sums.size(); ++sum)
      if (sums[sum] > 0)
        densities[cell] +=
          sums[sum] / volume * state.material(sum - first_body).density();
  }



  template <int dim>
  void
  CellMaterials<dim>::update_cells_without_points(const State<dim>  &state,
                                                  const unsigned int n_sums)
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
    const auto          at_nodes = sums_at_nodes(state, wanted, n_sums);
    std::vector<double> sums(n_sums);
    for (const unsigned int cell : cells)
      {
        for (unsigned int sum = 0; sum < n_sums; ++sum)
          {
            sums[sum] = 0;
            for (unsigned int a = 0; a < n; ++a)
              sums[sum] += at_nodes[sum][space.cell_nodes(cell)[a]][0];
          }
        take_mean(state, cell, sums);
      }
  }



  template class CellMaterials<2>;
  template class CellMaterials<3>;
} // namespace moraine
