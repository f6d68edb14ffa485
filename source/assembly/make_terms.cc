// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/make_terms.h>

#include <moraine/assembly/conserving_force.h>
#include <moraine/assembly/fictitious_stiffness.h>
#include <moraine/assembly/grid_condition_term.h>
#include <moraine/assembly/inertia.h>
#include <moraine/assembly/internal_force.h>
#include <moraine/assembly/load_terms.h>
#include <moraine/assembly/pressure_term.h>
#include <moraine/assembly/shared_cells_term.h>

namespace moraine
{
  template <int dim>
  Terms<dim>
  make_terms(std::vector<ImplicitBoundary<dim>>    &boundaries,
             const std::vector<GridCondition<dim>> &conditions,
             Loads<dim>                            &loads,
             const double                           fictitious_stiffness,
             const bool                             inertia,
             const bool                             conserving,
             std::unique_ptr<Term<dim>>             internal_force,
             const IsActive                        &active,
             const ShapesOfBodies<dim>             &shapes)
  {
    const auto acts = [&active](const std::string &section,
                                const std::string &name) {
      return !active || active(section, name);
    };
    Terms<dim> terms;
    if (internal_force)
      terms.push_back(std::move(internal_force));
    else if (conserving)
      terms.push_back(std::make_unique<ConservingForce<dim>>());
    else
      terms.push_back(std::make_unique<InternalForce<dim>>());
    if (inertia)
      terms.push_back(std::make_unique<Inertia<dim>>());
    if (fictitious_stiffness > 0)
      terms.push_back(
        std::make_unique<FictitiousStiffness<dim>>(fictitious_stiffness));
    std::vector<const BoundaryTerm<dim> *> without_flux;
    for (auto &boundary : boundaries)
      if (acts("Boundaries", boundary.name()))
        {
          auto term = std::make_unique<BoundaryTerm<dim>>(boundary, shapes);
          if (!boundary.enforcement().is_nitsche())
            without_flux.push_back(term.get());
          terms.push_back(std::move(term));
        }
    std::vector<GridCondition<dim>> acting;
    for (const auto &condition : conditions)
      if (acts("Grid conditions", condition.name))
        acting.push_back(condition);
    const GridConditionTerm<dim> *grid_conditions = nullptr;
    if (!acting.empty())
      {
        auto term       = std::make_unique<GridConditionTerm<dim>>(acting);
        grid_conditions = term.get();
        terms.push_back(std::move(term));
      }
    if (without_flux.size() + (grid_conditions ? 1 : 0) > 1)
      terms.push_back(
        std::make_unique<SharedCellsTerm<dim>>(without_flux, grid_conditions));
    for (const auto &force : loads.body_forces)
      if (acts("Loads", force.name))
        terms.push_back(std::make_unique<BodyForceTerm<dim>>(force));
    for (auto &load : loads.carried)
      if (acts("Loads", load.name()))
        {
          if (load.follows())
            terms.push_back(std::make_unique<PressureTerm<dim>>(load));
          else
            terms.push_back(std::make_unique<CarriedLoadTerm<dim>>(load));
        }
    for (auto &force : loads.on_points)
      if (acts("Loads", force.name()))
        terms.push_back(std::make_unique<ForceOnPointsTerm<dim>>(force));
    return terms;
  }



#define INSTANTIATE(dim) template decltype(make_terms<dim>) make_terms<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
