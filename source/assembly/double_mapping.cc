// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/double_mapping.h>
#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** @f$\sum_i N_i(x_g)\, S^*_i@f$ of one direction at its two Gauss points.
     */
    std::array<double, 2>
    at_gauss_points(const std::array<double, 2> &S)
    {
      static const double near = 0.5 * (1 + 1 / std::sqrt(3.));
      return {
        {near * S[0] + (1 - near) * S[1], (1 - near) * S[0] + near * S[1]}};
    }
  } // namespace



  template <int dim>
  DoubleMapping<dim>::DoubleMapping(const GridSpace<dim> &space,
                                    const PointSet<dim>  &points,
                                    const std::string    &method)
    : space(space)
    , points(points)
    , method(method)
    , neighbours((require_box_mesh(space, method), space.mesh()))
    , local_functions(space, points)
  {}



  template <int dim>
  std::vector<Effect>
  DoubleMapping<dim>::effects(const StepContext<dim> &context) const
  {
    if (context.motion)
      return {{"internal force", "", ""}};
    return {{"internal force, stiffness at Gauss points", "", ""}};
  }



  template <int dim>
  bool
  DoubleMapping<dim>::begin_step(const StepContext<dim> &context)
  {
    require_box_mesh(space, method);
    const BoxGrid<dim> &grid = *space.mesh().box_grid();
    const QGauss<dim>   quadrature(2);
    for (unsigned int g = 0; g < n_gauss; ++g)
      {
        std::array<Point<dim>, n_gauss> X;
        std::array<double, n_gauss>     N;
        for (unsigned int a = 0; a < n_gauss; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            X[a][d] = ((a >> d) & 1) * grid.cell_size[d];
        CellShapes<dim, 1>::evaluate(quadrature.point(g),
                                     X.data(),
                                     N.data(),
                                     gradients[g].data());
      }
    cells.clear();
    if (context.motion)
      find_recovered_forces(context.state);
    else
      {
        find_cells();
        find_carried_forces(context.state);
      }
    return false;
  }



  template <int dim>
  void
  DoubleMapping<dim>::find_cells()
  {
    const BoxGrid<dim> &grid = *space.mesh().box_grid();
    // Sorted by counting: how many points a cell has, then where it has them.
    std::vector<unsigned int> end(
      space.mesh().triangulation().n_active_cells() + 1, 0);
    const auto for_each_pair = [&](const auto &visit) {
      for (const auto &in_cell : points.cells())
        {
          const auto place = place_in(grid, in_cell.cell->center());
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            local_functions.cells(place, p).for_each_cell([&](const auto &ijk) {
              visit(neighbours.box_cell(ijk), ijk, p);
            });
        }
    };
    for_each_pair([&](const unsigned int cell, const auto &, unsigned int) {
      ++end[cell + 1];
    });
    for (unsigned int cell = 1; cell < end.size(); ++cell)
      end[cell] += end[cell - 1];
    points_of_cells.resize(end.back());
    cells.clear();
    std::vector<unsigned int> next(end);
    for_each_pair(
      [&](const unsigned int cell, const auto &ijk, unsigned int p) {
        if (next[cell] == end[cell])
          cells.push_back({ijk, cell, end[cell], end[cell + 1]});
        points_of_cells[next[cell]++] = p;
      });
  }



  template <int dim>
  void
  DoubleMapping<dim>::evaluate(const Cell &cell, GaussBlock &block) const
  {
    const unsigned int n = (cell.last - cell.first) * n_gauss;
    if (block.points.size() < n)
      {
        block.points.resize(n);
        block.shares.resize(n);
      }
    block.stencil.reinit(n,
                         block.points.data(),
                         n_gauss,
                         space.cell_nodes(cell.index));
    block.stencil.shares = block.shares.data();
    unsigned int entry   = 0;
    for (unsigned int k = cell.first; k < cell.last; ++k)
      {
        const unsigned int    p = points_of_cells[k];
        const auto            S = local_functions.values(cell.place, p);
        std::array<double, 2> w[dim];
        for (unsigned int d = 0; d < dim; ++d)
          w[d] = at_gauss_points(S[d]);
        for (unsigned int g = 0; g < n_gauss; ++g, ++entry)
          {
            double share = 1;
            for (unsigned int d = 0; d < dim; ++d)
              share *= w[d][(g >> d) & 1];
            block.points[entry] = p;
            block.shares[entry] = share;
            std::copy(gradients[g].begin(),
                      gradients[g].end(),
                      &block.stencil.gradients[entry * n_gauss]);
          }
      }
  }



  template <int dim>
  template <class Stress>
  void
  DoubleMapping<dim>::carry(const State<dim> &state, const Stress &stress)
  {
    carried_forces.assign(space.n_nodes(), Tensor<1, dim>());
    StencilBlock<dim> stencil;
    const Basis<dim> &basis = state.point_basis();
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, stencil);
        for (unsigned int p = 0; p < stencil.n_points; ++p)
          {
            const unsigned int          point = stencil.points[p];
            const SymmetricTensor<2, 3> of_p  = stress(point);
            for (unsigned int a = 0; a < stencil.n_nodes; ++a)
              carried_forces[stencil.nodes[a]] -=
                force_of_stress(state.integration_volume(point),
                                of_p,
                                stencil.grad_N(p)[a]);
          }
      }
  }



  template <int dim>
  void
  DoubleMapping<dim>::find_recovered_forces(const State<dim> &state)
  {
    carry(state, [&state](const unsigned int point) {
      return -state.stress_of_recovery(point);
    });
  }



  template <int dim>
  void
  DoubleMapping<dim>::find_carried_forces(const State<dim> &state)
  {
    carry(state, [this](const unsigned int point) {
      return points.stress_field()(points.values(point));
    });
    GaussBlock block;
    for (const Cell &cell : cells)
      {
        evaluate(cell, block);
        for (unsigned int e = 0; e < block.stencil.n_points; ++e)
          {
            const unsigned int point = block.points[e];
            const double v = block.shares[e] * state.integration_volume(point);
            const auto   stress = points.stress_field()(points.values(point));
            for (unsigned int a = 0; a < n_gauss; ++a)
              carried_forces[block.stencil.nodes[a]] +=
                force_of_stress(v, stress, block.stencil.grad_N(e)[a]);
          }
      }
  }



  template <int dim>
  void
  DoubleMapping<dim>::add(const StepContext<dim> &context,
                          const bool              tangent,
                          GlobalSystem<dim>      &system) const
  {
    LocalSystem<dim> local;
    GaussBlock       block;
    for (const Cell &cell : cells)
      {
        evaluate(cell, block);
        local.reinit(context.state,
                     block.stencil.nodes,
                     block.stencil.n_nodes,
                     tangent);
        internal_force.add(context, block.stencil, tangent, local);
        system.add(local, tangent && local.failure.empty());
      }
    const Basis<dim> &basis = context.state.point_basis();
    StencilBlock<dim> stencil;
    for (unsigned int g = 0; context.motion && g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, stencil);
        local.reinit(context.state, stencil.nodes, stencil.n_nodes, tangent);
        internal_force.add(context, stencil, tangent, local);
        system.add(local, tangent && local.failure.empty());
      }
    for (unsigned int node = 0; node < carried_forces.size(); ++node)
      {
        local.reinit(context.state, &node, 1, true);
        for (unsigned int d = 0; d < dim; ++d)
          local.force[d] = carried_forces[node][d];
        system.add(local, false);
      }
  }



  template <int dim>
  std::string
  DoubleMapping<dim>::failure(const StepContext<dim> &context,
                              const std::vector<Tensor<1, dim>> &) const
  {
    const State<dim>           &state = context.state;
    const Basis<dim>           &basis = state.point_basis().strain_basis();
    StencilBlock<dim>           block;
    TrialPoints<dim>            trial;
    std::vector<Tensor<1, dim>> nodal;
    std::string                 reason;
    for (unsigned int g = 0; g < basis.n_batches() && reason.empty(); ++g)
      {
        basis.evaluate(g, block);
        nodal.resize(block.n_nodes);
        for (unsigned int a = 0; a < block.n_nodes; ++a)
          nodal[a] = context.increments()[block.nodes[a]];
        for (unsigned int begin = 0, end = 0; begin < block.n_points;
             begin = end)
          {
            end = state.end_of_body(block, begin);
            trial.evaluate(state, block, begin, end, nodal.data());
            if (trial.first_failure() == trial.n_points())
              continue;
            const unsigned int p = block.points[begin + trial.first_failure()];
            reason =
              why_no_stress(state, trial, state.material(points.body(p)), p);
            break;
          }
      }
    for (const std::string &other :
         Utilities::MPI::all_gather(space.communicator(), reason))
      if (!other.empty())
        return other;
    return "";
  }



  template class DoubleMapping<2>;
  template class DoubleMapping<3>;
} // namespace moraine
