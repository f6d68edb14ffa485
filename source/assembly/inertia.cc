// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/inertia.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  std::vector<Effect>
  Inertia<dim>::effects(const StepContext<dim> &) const
  {
    return {{"inertia", "", ""}};
  }



  template <int dim>
  void
  Inertia<dim>::add(const StepContext<dim>  &context,
                    const StencilBlock<dim> &block,
                    const bool               tangent,
                    LocalSystem<dim>        &local) const
  {
    const State<dim>    &state   = context.state;
    const PointSet<dim> &points  = state.material_points();
    const Motion<dim>   &motion  = *context.motion;
    const unsigned int   n_nodes = block.n_nodes;
    accelerations.resize(n_nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      accelerations[a] =
        motion.inertial_acceleration(block.nodes[a], local.nodal_increments[a]);
    if (tangent)
      masses.assign(n_nodes * n_nodes, 0.);
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const unsigned int point = block.points[p];
        const double      *N     = block.N(p);
        const double       m = state.material(points.body(point)).density() *
                         state.initial_volume(point);
        Tensor<1, dim> of_point;
        for (unsigned int a = 0; a < n_nodes; ++a)
          of_point += N[a] * accelerations[a];
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            const Tensor<1, dim> &acceleration =
              motion.lumped_mass() ? accelerations[a] : of_point;
            for (unsigned int d = 0; d < dim; ++d)
              local.force[dim * a + d] -= m * N[a] * acceleration[d];
            if (!tangent)
              continue;
            if (motion.lumped_mass())
              masses[a * n_nodes + a] += m * N[a];
            else
              for (unsigned int b = 0; b < n_nodes; ++b)
                masses[a * n_nodes + b] += m * N[a] * N[b];
          }
      }
    if (!tangent)
      return;
    const double c = motion.inertial_acceleration_by_increment();
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int d = 0; d < dim; ++d)
          local.matrix(dim * a + d, dim * b + d) += c * masses[a * n_nodes + b];
  }



  template class Inertia<2>;
  template class Inertia<3>;
} // namespace moraine
