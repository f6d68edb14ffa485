// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/fading_forces.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  FadingForces<dim>::begin(const std::vector<Tensor<1, dim>> &forces_now,
                           const double                       start,
                           const double                       end)
  {
    forces.keep(forces_now);
    of_nodes = forces_now;
    t_start  = start;
    t_end    = end;
  }



  template <int dim>
  void
  FadingForces<dim>::write(Archive &archive) const
  {
    forces.write(archive);
    archive.write("run/fading_forces/time",
                  std::vector<double>{t_start, t_end},
                  1,
                  "time");
  }



  template <int dim>
  void
  FadingForces<dim>::read(const Archive &archive)
  {
    forces.read(archive);
    const auto &times = archive.numbers("run/fading_forces/time");
    t_start           = times[0];
    t_end             = times[1];
  }



  template <int dim>
  void
  FadingForcesTerm<dim>::add(const StepContext<dim> &context,
                             const bool              tangent,
                             GlobalSystem<dim>      &system) const
  {
    const GridSpace<dim> &space = context.state.grid();
    const auto           &r     = forces.nodal_forces();
    const double          share = forces.share(context.t_end);
    LocalSystem<dim>      local;
    for (unsigned int node = 0; share > 0 && node < r.size(); ++node)
      if (space.locally_owned().is_element(space.node_dof(node)))
        {
          local.reinit(context.state, &node, 1, tangent);
          for (unsigned int d = 0; d < dim; ++d)
            local.force[d] = -share * r[node][d];
          system.add(local, tangent);
        }
  }



#define INSTANTIATE(dim)            \
  template class FadingForces<dim>; \
  template class FadingForcesTerm<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
