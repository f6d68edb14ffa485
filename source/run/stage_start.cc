// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/stage_start.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/output/error_norms.h>
#include <moraine/output/grid_evaluation.h>
#include <moraine/run/initial_stress.h>
#include <moraine/run/initial_traction.h>
#include <moraine/run/start_checks.h>
#include <moraine/run/velocity_jump.h>
#include <moraine/scene/scene_conditions.h>
#include <moraine/solver/newton.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Accelerations from the balance of momentum, in a step that has begun
     * and has a target. */
    template <int dim>
    void
    find_accelerations(Model<dim> &model)
    {
      const LA::Vector missing = model.system->forces_and_mass();
      LA::Vector       change  = model.space->vector();
      model.linear_solver->set_up(model.system->tangent(), true, {});
      const LinearReport report = model.linear_solver->solve(change, missing);
      if (!report.converged)
        throw ComputationError(
          "accelerations at the start: " + report.message +
          ". A consistent mass is singular where a cell has one point; 'Mass = "
          "lumped' in section 'Time' or more points ('Points per direction' in "
          "section 'Method') help then");
      model.system->apply_constraints(change);
      change += model.space->vector_of(model.motion->accelerations());
      model.motion->set_accelerations(change);
      model.linear_solver->clear();
    }



    /** Set in motion what was at rest, by the initial velocities of bodies if
     * this is the first stage with inertia. */
    template <int dim>
    void
    start_motion(const Scene<dim>      &scene,
                 const StageParameters &stage,
                 Model<dim>            &model,
                 Diagnostics<dim>      &diagnostics)
    {
      const bool first = &stage == &scene.first_dynamic_stage();
      if (first)
        model.motion->start(initial_velocity(scene, model.body_names));
      else
        model.motion->start([](const unsigned int, const Point<dim> &) {
          return Tensor<1, dim>();
        });
      model.motion->begin_step();
      if (const auto jump = velocity_jump(stage, first, model))
        diagnostics.report(*jump);
      find_accelerations(model);
    }



    /** Whether what acts on the bodies may be another at the start of @p stage.
     */
    bool
    forces_jump(const StageParameters &before, const StageParameters &stage)
    {
      return stage.bodies != before.bodies || stage.loads != before.loads ||
             stage.boundaries != before.boundaries ||
             stage.grid_conditions != before.grid_conditions ||
             stage.absorbing != before.absorbing;
    }



    /** The finding with this id, to go on with a message; "" without one. */
    template <int dim>
    std::string
    cause(const Diagnostics<dim> &diagnostics, const std::string &id)
    {
      for (const Finding &finding : diagnostics.ledger.findings())
        if (finding.id == id)
          return "; " + finding.object + ": " + finding.text;
      return "";
    }



    /** @throws InputError for a body that is not held, with the condition that
     * holds nothing, if there is one. */
    template <int dim>
    void
    check_that_it_is_held(const StageParameters  &stage,
                          Model<dim>             &model,
                          const Diagnostics<dim> &diagnostics)
    {
      model.system->set_target(stage.time.start_time);
      model.system->assemble(model.space->vector(), true);
      try
        {
          model.system->check_that_it_is_held(true);
        }
      catch (const InputError &error)
        {
          throw InputError(error.what() + cause(diagnostics, "no-effect"));
        }
    }



    /**
     * The displacement from the places of an accepted step to equilibrium in
     * these: at small strain it was found before points moved, and a boundary
     * that holds forces of another place would lose the difference. In a step
     * of the stage @p before that has begun, which aims at its start then; 0
     * with inertia.
     */
    template <int dim>
    LA::Vector
    to_equilibrium(const Scene<dim>      &scene,
                   const StageParameters &before,
                   Model<dim>            &model,
                   Diagnostics<dim>      &diagnostics)
    {
      const double t = before.time.end_time;
      LA::Vector   x = model.space->vector();
      model.system->set_target(t);
      if (before.time.integrator.dynamic())
        return x;
      const NewtonReport report =
        Newton(scene.newton).solve(*model.system, *model.linear_solver, x);
      if (report.converged())
        return x;
      diagnostics.report({"absorbing-boundary",
                          "",
                          1,
                          0,
                          "there is no equilibrium before it begins to absorb; "
                          "the forces that it holds are out of balance"});
      model.system->set_target(t);
      return model.space->vector();
    }



    /** By how much an initial stress is out of equilibrium, in a step that has
     * begun. */
    template <int dim>
    void
    report_imbalance(Model<dim> &model, Diagnostics<dim> &diagnostics)
    {
      constexpr double allowed = 1e-12; // round-off
      const double     share   = model.system->unbalanced_share();
      if (share > allowed)
        diagnostics.report({"initial-imbalance",
                            "",
                            share,
                            allowed,
                            per_cent(share) +
                              " of the forces of the initial stress are out of "
                              "balance as the first step begins"});
    }



    /** Probes whose bodies are not there. */
    template <int dim>
    void
    report_absent_probes(const Model<dim> &model, Diagnostics<dim> &diagnostics)
    {
      std::vector<std::string> sentences;
      model.probes->report_absent(*model.points, model.body_names, sentences);
      if (!sentences.empty())
        diagnostics.report({"absent-probe", "", 1, 0, sentences.front()});
    }



    template <int dim>
    typename Facts<dim>::Moment
    moment_of(const StageParameters &stage, const StageParameters *before)
    {
      typename Facts<dim>::Moment moment;
      moment.stage  = &stage;
      moment.before = before;
      moment.t      = stage.time.start_time;
      return moment;
    }



    using HeldForces = std::vector<std::pair<std::string, LA::Vector>>;

    /** The forces of boundaries that absorb from @p stage on. */
    template <int dim>
    HeldForces
    forces_to_hold(const Scene<dim>      &scene,
                   const StageParameters &stage,
                   const StageParameters &before,
                   Model<dim>            &model,
                   Diagnostics<dim>      &diagnostics)
    {
      HeldForces held;
      LA::Vector x;
      for (const std::string &name : stage.absorbing)
        if (!contains(before.absorbing, name))
          {
            if (held.empty())
              x = to_equilibrium(scene, before, model, diagnostics);
            held.emplace_back(name, model.system->constraint_forces(name, x));
          }
      return held;
    }



    /** Let boundaries that absorb hold these forces. */
    template <int dim>
    void
    hold(const HeldForces &held,
         const double      t,
         Model<dim>       &model,
         Diagnostics<dim> &diagnostics)
    {
      constexpr double allowed = 0.01;
      for (const auto &[name, forces] : held)
        if (const double lost = model.system->hold(name, forces);
            lost > allowed)
          diagnostics.report({"absorbing-boundary",
                              name,
                              lost,
                              allowed,
                              per_cent(lost) +
                                " of the forces that it held are no traction "
                                "on it and end"});
      if (!held.empty())
        model.system->begin_step(t); // with these among the forces at its start
    }



    /** The forces at the start of @p stage: those of stress, and accelerations
     * with inertia. */
    template <int dim>
    void
    start_forces(const Scene<dim>      &scene,
                 const StageParameters &stage,
                 const StageParameters *before,
                 Model<dim>            &model,
                 Diagnostics<dim>      &diagnostics)
    {
      const bool dynamic = stage.time.integrator.dynamic();
      const bool was     = before && before->time.integrator.dynamic();
      if (dynamic && !was)
        start_motion(scene, stage, model, diagnostics);
      else if (!dynamic)
        {
          if (was)
            model.motion->rest();
          check_that_it_is_held(stage, model, diagnostics);
        }
      else if (forces_jump(*before, stage))
        {
          set_first_target(stage.time, model);
          find_accelerations(model);
        }
    }



    /** Whether the body that is nearest to a place in a cell of this rank goes.
     * A cell without points is on the rim of a body as it was drawn. */
    template <int dim>
    bool
    is_on_what_goes(const Point<dim>        &x,
                    const unsigned int       cell,
                    const std::vector<bool> &goes,
                    const Model<dim>        &model)
    {
      const auto [first, last] = model.points->points_in(cell);
      double     nearest       = std::numeric_limits<double>::max();
      bool       of_goes       = false;
      const auto take = [&](const double away, const unsigned int body) {
        if (away >= nearest)
          return;
        nearest = away;
        of_goes = goes[body];
      };
      for (unsigned int p = first; p < last; ++p)
        take(model.points->position(p).distance(x), model.points->body(p));
      for (unsigned int b = 0; first == last && b < goes.size(); ++b)
        if (model.present[b] && model.bodies[b].shape)
          take(-model.bodies[b].shape->distance(x, model.mesh->cell_size()), b);
      return of_goes;
    }



    /** Remove the places of absorbing boundaries that lie on bodies which @p
     * stage does not have, before they go.
     * @return what was lost, if anything */
    template <int dim>
    std::optional<Finding>
    remove_absorbing_places(const StageParameters &stage, Model<dim> &model)
    {
      std::vector<bool> goes;
      for (unsigned int b = 0; b < model.bodies.size(); ++b)
        goes.push_back(model.present[b] &&
                       !contains(stage.bodies, model.body_names[b]));
      std::optional<Finding> found;
      for (auto &boundary : model.absorbing_boundaries)
        {
          const auto               &places = boundary.places();
          std::vector<unsigned int> is_lost(places.size(), 0);
          for (unsigned int k = 0; k < places.size(); ++k)
            if (places[k].active_cell_index != GridSpace<dim>::no_cell)
              is_lost[k] = is_on_what_goes(places[k].x,
                                           places[k].active_cell_index,
                                           goes,
                                           model);
          Utilities::MPI::max(is_lost, model.space->communicator(), is_lost);
          double                    lost = 0, all = 0;
          std::vector<unsigned int> numbers;
          for (unsigned int k = 0; k < places.size(); ++k)
            {
              all += places[k].weight;
              if (is_lost[k] > 0)
                {
                  lost += places[k].weight;
                  numbers.push_back(k);
                }
            }
          if (numbers.empty())
            continue;
          boundary.remove_places(numbers);
          found = {"absorbing-boundary",
                   boundary.name(),
                   lost / all,
                   0,
                   per_cent(lost / all) +
                     " of it lies on bodies that go, and goes with them"};
        }
      return found;
    }
  } // namespace



  template <int dim>
  void
  begin_first_step(const Scene<dim> &scene,
                   Model<dim>       &model,
                   Diagnostics<dim> &diagnostics)
  {
    const StageParameters &stage = scene.stages.front().second;
    model.system->begin_step(scene.start_time());
    check_start(scene, stage, true, model);
    diagnostics.ask(When::stage, moment_of<dim>(stage, nullptr));
    report_absent_probes(model, diagnostics);
    model.probes->check_places(
      grid_evaluation<dim>(*model.space, model.state->nodal_increments()),
      model.points->exchanged());
    const ExactSolution<dim> exact = scene.exact.solution();
    if (exact.displacement || exact.stress)
      error_norms(*model.points, exact, scene.end_time(), false);
    if (begins_with_stress(scene, 0))
      {
        set_initial_tractions(stage, {}, model);
        report_imbalance(model, diagnostics);
      }
    start_forces(scene, stage, nullptr, model, diagnostics);
  }



  template <int dim>
  void
  begin_stage(const Scene<dim>  &scene,
              const unsigned int k,
              Model<dim>        &model,
              Diagnostics<dim>  &diagnostics)
  {
    const auto            &name   = scene.stages[k].first;
    const StageParameters &stage  = scene.stages[k].second,
                          &before = scene.stages[k - 1].second;
    const double     t            = stage.time.start_time;
    const auto       moment       = moment_of<dim>(stage, &before);
    const HeldForces held =
      forces_to_hold(scene, stage, before, model, diagnostics);
    diagnostics.ask(When::bodies_go, moment);
    if (stage.bodies != before.bodies)
      if (const auto lost = remove_absorbing_places(stage, model))
        diagnostics.report(*lost);
    model.linear_solver->clear();
    model.set_stage(scene, k);
    try
      {
        model.system->begin_step(t);
      }
    catch (const ComputationError &error)
      {
        throw ComputationError("stage '" + name + "': " + error.what() +
                               cause(diagnostics, "removed-body"));
      }
    hold(held, t, model, diagnostics);
    if (stage.reset_displacements)
      {
        model.probes->reset_displacements(*model.points);
        model.points->reset_displacements();
      }
    report_absent_probes(model, diagnostics);
    check_start(scene, stage, false, model);
    diagnostics.ask(When::stage, moment);
    set_tractions_of_new_bodies(stage, before, model);
    set_initial_tractions(stage, before.boundaries, model);
    if (begins_with_stress(scene, k))
      report_imbalance(model, diagnostics);
    start_forces(scene, stage, &before, model, diagnostics);
  }



#define INSTANTIATE(dim)                                          \
  template decltype(begin_first_step<dim>) begin_first_step<dim>; \
  template decltype(begin_stage<dim>)      begin_stage<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
