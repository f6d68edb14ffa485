// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What following a path of equilibria asks of the equations.

#include <moraine/assembly/mechanics_system.h>

#include <deal.II/base/mpi.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  MechanicsSystem<dim>::set_parameter(const double t)
  {
    context.t_end = t;
    state.set_step_time({context.t_start, context.t_end});
    each<ConstraintTerm<dim>>([this](auto &term) { term.move_trial(context); });
    if (constraints.any_lines())
      constraints.set_values(lines_of_terms());
    find_dead_forces();
  }



  template <int dim>
  LA::Vector
  MechanicsSystem<dim>::path_weights() const
  {
    const PointSet<dim>        &points = state.material_points();
    std::vector<Tensor<1, dim>> shares(state.grid().n_nodes());
    StencilBlock<dim>           block;
    double                      volume = 0;
    for (unsigned int g = 0; g < state.point_basis().n_batches(); ++g)
      {
        state.point_basis().evaluate(g, block);
        for (unsigned int i = 0; i < block.n_points; ++i)
          {
            const double v = points.volume(block.points[i]);
            volume += v;
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              for (unsigned int d = 0; d < dim; ++d)
                shares[block.nodes[a]][d] += v * block.N(i)[a];
          }
      }
    LA::Vector weights = state.grid().vector();
    state.grid().sum_node_values(shares, weights);
    weights /= Utilities::MPI::sum(volume, state.grid().communicator());
    return weights;
  }



#define INSTANTIATE(dim)                                                 \
  template void       MechanicsSystem<dim>::set_parameter(const double); \
  template LA::Vector MechanicsSystem<dim>::path_weights() const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
