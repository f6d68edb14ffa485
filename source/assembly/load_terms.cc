// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/load_terms.h>

#include <moraine/mesh/active_search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The effect of a load in words. */
    std::vector<Effect>
    effect_of(const std::string &kind, const std::string &name)
    {
      return {{kind + " " + name, "load", name + ", " + kind}};
    }



    /**
     * Functions that move the places of a follower pressure: those of the mesh,
     * because its continuous displacement keeps a closed surface closed, even
     * if @p force has the interpolants of domains. A place in none of the cells
     * of its domain goes with the domain. Collective.
     */
    template <int dim>
    PlaceFunctions<dim>
    functions_of_motion(
      const GridSpace<dim>                                  &space,
      const std::vector<typename CarriedPlaces<dim>::Place> &places,
      const PlaceFunctions<dim>                             &force)
    {
      const unsigned int        n = space.nodes_per_cell();
      std::vector<unsigned int> cell_of;
      for (const auto &place : places)
        cell_of.push_back(place.active_cell_index);
      // That of the rank that owns it.
      Utilities::MPI::min(cell_of, space.communicator(), cell_of);
      PlaceFunctions<dim> motion;
      for (unsigned int begin = 0, end = 0; begin < force.places.size();
           begin = end)
        {
          const unsigned int k           = force.places[begin];
          bool               is_in_cells = false;
          for (end = begin; end < force.places.size() && force.places[end] == k;
               ++end)
            is_in_cells = is_in_cells || force.cells[end] == cell_of[k];
          if (is_in_cells && end > begin + 1)
            {
              const auto [N, grad_N] = motion.add(k, cell_of[k], n);
              evaluate_shapes(space, cell_of[k], places[k].x, N, grad_N);
              continue;
            }
          for (unsigned int i = begin; i < end; ++i)
            {
              const auto [N, grad_N] = motion.add(k, force.cells[i], n);
              std::copy_n(&force.N[n * i], n, N);
              std::copy_n(&force.grad_N[n * i], n, grad_N);
            }
        }
      return motion;
    }
  } // namespace



  template <int dim>
  BodyForceTerm<dim>::BodyForceTerm(const BodyForce<dim> &force)
    : force(force)
  {}



  template <int dim>
  std::vector<Effect>
  BodyForceTerm<dim>::effects(const StepContext<dim> &) const
  {
    return effect_of(force.times_density ? "gravity" : "body force",
                     force.name);
  }



  template <int dim>
  void
  BodyForceTerm<dim>::add(const StepContext<dim>  &context,
                          const StencilBlock<dim> &block,
                          const bool,
                          LocalSystem<dim> &local) const
  {
    const State<dim>    &state  = context.state;
    const PointSet<dim> &points = state.material_points();
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const unsigned int point = block.points[p];
        const unsigned int body  = points.body(point);
        if (force.acts_on[body])
          local.add_force(
            block.N(p),
            (force.times_density ?
               state.material(body).density() * state.initial_volume(point) :
               points.volume(point)) *
              force.value(force.at_start ? state.original_position(point) :
                                           points.position(point),
                          context.t_end));
      }
  }



  template <int dim>
  ForceOnPointsTerm<dim>::ForceOnPointsTerm(ForceOnPoints<dim> &force)
    : force(force)
  {}



  template <int dim>
  std::vector<Effect>
  ForceOnPointsTerm<dim>::effects(const StepContext<dim> &) const
  {
    return effect_of("force on points", force.name());
  }



  template <int dim>
  bool
  ForceOnPointsTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    const State<dim> &state = context.state;
    force.find_points(state.material_points(), [&state](const unsigned int p) {
      return state.original_position(p);
    });
    return false;
  }



  template <int dim>
  void
  ForceOnPointsTerm<dim>::add(const StepContext<dim>  &context,
                              const StencilBlock<dim> &block,
                              const bool,
                              LocalSystem<dim> &local) const
  {
    for (unsigned int p = 0; p < block.n_points; ++p)
      if (force.acts_on(block.points[p]))
        local.add_force(block.N(p),
                        force.value(context.state.material_points().position(
                                      block.points[p]),
                                    context.t_end));
  }



  template <int dim>
  CarriedLoadTerm<dim>::CarriedLoadTerm(CarriedLoad<dim> &load, const bool acts)
    : load(load)
    , acts(acts)
  {}



  template <int dim>
  std::vector<Effect>
  CarriedLoadTerm<dim>::effects(const StepContext<dim> &) const
  {
    if (!acts)
      return {};
    return effect_of(load.kind(), load.name());
  }



  template <int dim>
  PlaceFunctions<dim>
  CarriedLoadTerm<dim>::functions_of_forces(
    const StepContext<dim> &context) const
  {
    const Basis<dim> &basis = context.state.point_basis();
    return context.state.mesh_after_step() == MeshAfterStep::reset ?
             basis.functions_at(load.places()) :
             basis.functions_of_cells(load.places());
  }



  template <int dim>
  bool
  CarriedLoadTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    // On a mesh that does not reset, places stay in their cells; gradients
    // there go with the nodes.
    if (context.couplings_changed || load.follows() ||
        context.state.mesh_after_step() == MeshAfterStep::reset)
      {
        load.find_cells(context.state.grid(), context.search_tolerance);
        const auto forces = functions_of_forces(context);
        load.set_functions(load.follows() ?
                             functions_of_motion<dim>(context.state.grid(),
                                                      load.places(),
                                                      forces) :
                             forces);
      }
    return false;
  }



  template <int dim>
  void
  CarriedLoadTerm<dim>::add(const StepContext<dim> &context,
                            const bool,
                            GlobalSystem<dim> &system) const
  {
    if (!acts)
      return;
    const GridSpace<dim>      &space     = context.state.grid();
    const unsigned int         n         = space.nodes_per_cell();
    const PlaceFunctions<dim> &functions = load.functions();
    LocalSystem<dim>           local;
    for (unsigned int i = 0; i < functions.places.size(); ++i)
      {
        const auto &place = load.places()[functions.places[i]];
        local.reinit(context.state,
                     space.cell_nodes(functions.cells[i]),
                     n,
                     false);
        local.add_force(&functions.N[n * i],
                        place.weight * load.value(place, context.t_end));
        system.add(local, false);
      }
  }



  template <int dim>
  void
  CarriedLoadTerm<dim>::prepare(const StepContext<dim> &context,
                                const LA::Vector &)
  {
    if (context.state.mesh_after_step() != MeshAfterStep::keep)
      load.prepare_move(context.state.grid(),
                        context.increments(),
                        context.state.mesh_after_step() ==
                          MeshAfterStep::reset);
  }



  template <int dim>
  void
  CarriedLoadTerm<dim>::keep() noexcept
  {
    load.move();
  }



#define INSTANTIATE(dim)                 \
  template class BodyForceTerm<dim>;     \
  template class ForceOnPointsTerm<dim>; \
  template class CarriedLoadTerm<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
