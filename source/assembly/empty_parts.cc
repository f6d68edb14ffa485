// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of MechanicsSystem that stiffens what points leave empty.

#include <moraine/assembly/mechanics_system.h>

#include <moraine/mesh/active_search.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  MechanicsSystem<dim>::find_empty_parts()
  {
    empty_volume.clear();
    if (empty_stiffness == 0)
      return;
    const auto         &tria = state.grid().mesh().triangulation();
    std::vector<double> filled(tria.n_active_cells(), 0.);
    for (const auto &in_cell : state.material_points().cells())
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        filled[in_cell.cell->active_cell_index()] +=
          state.material_points().volume(p);
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned() && state.grid().is_active(cell))
        {
          const double volume = cell->measure();
          const double empty  = volume - filled[cell->active_cell_index()];
          // Round-off in a full cell is not a part of it.
          if (empty > 1e-12 * volume)
            empty_volume.emplace_back(cell, empty);
        }
  }



  template <int dim>
  bool
  MechanicsSystem<dim>::stiffen_empty_parts(const double fraction)
  {
    empty_stiffness = fraction;
    find_empty_parts();
    return Utilities::MPI::logical_or(!empty_volume.empty(),
                                      state.grid().communicator());
  }



  template <int dim>
  double
  MechanicsSystem<dim>::share_of_empty_parts() const
  {
    const double squares =
      Utilities::MPI::sum(empty_scale, state.grid().communicator());
    // A step may end without any force.
    const double forces = std::max(scale, scale_at_start);
    return forces > 0 ? std::sqrt(squares) / forces : 0.;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::assemble_empty_parts(const bool tangent)
  {
    const double                before  = local_scale;
    const GridSpace<dim>       &space   = state.grid();
    const unsigned int          n_nodes = space.nodes_per_cell();
    const QGauss<dim>           quadrature(space.degree() + 1);
    std::vector<double>         N(n_nodes);
    std::vector<Tensor<1, dim>> grad_N(n_nodes);
    LocalSystem<dim>            local;
    for (const auto &[cell, empty] : empty_volume)
      {
        const unsigned int  index = cell->active_cell_index();
        const LameConstants C =
          state.material(body_of_cell[index]).elastic_stiffness();
        local.reinit(state, space.cell_nodes(cell), n_nodes, true);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const Point<dim> x =
              space.mesh().mapping().transform_unit_to_real_cell(
                cell, quadrature.point(q));
            evaluate_shapes(space, index, x, N.data(), grad_N.data());
            const double v = empty_stiffness * empty * quadrature.weight(q);
            for (unsigned int a = 0; a < n_nodes; ++a)
              for (unsigned int b = 0; b < n_nodes; ++b)
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = 0; j < dim; ++j)
                    local.matrix(dim * a + i, dim * b + j) +=
                      v * (C.lambda * grad_N[a][i] * grad_N[b][j] +
                           C.mu * grad_N[a][j] * grad_N[b][i] +
                           (i == j ? C.mu * (grad_N[a] * grad_N[b]) : 0.));
          }
        for (unsigned int r = 0; r < dim * n_nodes; ++r)
          for (unsigned int b = 0; b < n_nodes; ++b)
            for (unsigned int j = 0; j < dim; ++j)
              local.force[r] -=
                local.matrix(r, dim * b + j) * local.nodal_increments[b][j];
        add_to_system(local, tangent);
      }
    empty_scale = local_scale - before;
  }



#define INSTANTIATE(dim)                                                   \
  template void   MechanicsSystem<dim>::find_empty_parts();                \
  template bool   MechanicsSystem<dim>::stiffen_empty_parts(const double); \
  template double MechanicsSystem<dim>::share_of_empty_parts() const;      \
  template void   MechanicsSystem<dim>::assemble_empty_parts(const bool);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
