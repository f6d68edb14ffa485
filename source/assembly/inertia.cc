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
    const State<dim>  &state   = context.state;
    const Motion<dim> &motion  = *context.motion;
    const unsigned int n_nodes = block.n_nodes;
    accelerations.resize(n_nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      accelerations[a] =
        motion.inertial_acceleration(block.nodes[a], local.nodal_increments[a]);
    if (tangent)
      masses.assign(n_nodes * n_nodes, 0.);
    mass.find_lumped(
      block,
      [&state](const unsigned int p) { return state.mass(p); },
      motion.lumped_mass());
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const double *N = block.N(p);
        const double  m = state.mass(block.points[p]);
        mass.add_product(N, -m, accelerations, local.force);
        if (tangent)
          mass.add_matrix(N, m, masses);
      }
    hold_massless_nodes(context, block, tangent, local);
    if (tangent)
      local.add_in_all_directions(motion.inertial_acceleration_by_increment(),
                                  masses);
  }



  template <int dim>
  void
  Inertia<dim>::hold_massless_nodes(const StepContext<dim>  &context,
                                    const StencilBlock<dim> &block,
                                    const bool               tangent,
                                    LocalSystem<dim>        &local) const
  {
    constexpr double   next_to_none = 1e-10;
    const Motion<dim> &motion       = *context.motion;
    for (unsigned int a = 0; a < block.n_nodes; ++a)
      {
        if (!motion.is_massless(block.nodes[a]))
          continue;
        double m = 0;
        for (unsigned int p = 0; p < block.n_points; ++p)
          m += next_to_none * context.state.mass(block.points[p]);
        const Tensor<1, dim> change =
          accelerations[a] - motion.accelerations()[block.nodes[a]];
        for (unsigned int d = 0; d < dim; ++d)
          local.force[dim * a + d] -= m * change[d];
        if (tangent)
          masses[a * block.n_nodes + a] += m;
      }
  }



  template class Inertia<2>;
  template class Inertia<3>;
} // namespace moraine
