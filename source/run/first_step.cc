// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What shows only when a model is about to take its first step.

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/output/error_norms.h>
#include <moraine/output/grid_evaluation.h>
#include <moraine/run/boundary_ends.h>
#include <moraine/run/boundary_notes.h>
#include <moraine/run/condition_checks.h>
#include <moraine/run/held_stress.h>
#include <moraine/run/hold_watch.h>
#include <moraine/run/initial_stress.h>
#include <moraine/run/load_notes.h>
#include <moraine/run/model.h>
#include <moraine/run/narrow_gaps.h>
#include <moraine/run/near_bodies.h>
#include <moraine/run/removed_bodies.h>
#include <moraine/scene/scene_conditions.h>
#include <moraine/run/point_volumes.h>
#include <moraine/run/skipped_tables.h>
#include <moraine/run/thin_bodies.h>
#include <moraine/run/velocity_jump.h>
#include <moraine/solver/newton.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Forces out of balance at the start that are more than this are said to
     * move something. */
    constexpr double told_share_of_forces = 0.01;

    /** Places absorb on the bodies that were there when it began. */
    template <int dim>
    void
    tell_of_not_absorbed(const Scene<dim>         &scene,
                         const StageParameters    &stage,
                         const StageParameters    &before,
                         const Model<dim>         &model,
                         std::vector<std::string> &notes)
    {
      std::vector<std::string> come;
      for (const std::string &body : stage.bodies)
        if (!contains(before.bodies, body))
          come.push_back(body);
      if (come.empty())
        return;
      for (const auto &boundary : model.absorbing_boundaries)
        if (absorbs_in(before, scene, boundary) &&
            absorbs_in(stage, scene, boundary))
          notes.push_back(boundary.name() +
                          " absorbs on bodies that were there as it began; " +
                          list_of(come) +
                          " is free where it touches it, and a second boundary "
                          "that begins in a later stage absorbs there");
    }



    /** Dashpots hold nothing that is at rest. */
    template <int dim>
    void
    tell_of_absorbing_at_rest(const Scene<dim>         &scene,
                              const StageParameters    &stage,
                              const Model<dim>         &model,
                              std::vector<std::string> &notes)
    {
      if (stage.time.integrator.dynamic())
        return;
      for (const auto &boundary : model.absorbing_boundaries)
        {
          const std::string &name = boundary.name();
          if (contains(boundary.is_on_side() ? stage.grid_conditions :
                                               stage.boundaries,
                       name) &&
              !scene.absorbs_later(name) &&
              boundary.law().springs == AbsorbingLaw::Springs::none)
            notes.push_back(
              name + ": it absorbs waves and holds nothing in this stage "
                     "without inertia; let it hold here, and name it in "
                     "'Absorbing' of the stage with waves");
        }
    }



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
    start_motion(const Scene<dim>         &scene,
                 const StageParameters    &stage,
                 Model<dim>               &model,
                 std::vector<std::string> &notes)
    {
      const bool first = &stage == &scene.first_dynamic_stage();
      if (first)
        model.motion->start(initial_velocity(scene, model.body_names));
      else
        model.motion->start([](const unsigned int, const Point<dim> &) {
          return Tensor<1, dim>();
        });
      model.motion->begin_step();
      const std::string jump = velocity_jump(stage, first, model);
      if (!jump.empty())
        notes.push_back(jump);
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



    template <int dim>
    void
    check_that_it_is_held(const StageParameters &stage, Model<dim> &model)
    {
      model.system->set_target(stage.time.start_time);
      model.system->assemble(model.space->vector(), true);
      try
        {
          model.system->check_that_it_is_held(true);
        }
      catch (const InputError &error)
        {
          // What was to hold it may miss it.
          std::string text = error.what();
          for (const std::string &note : idle_conditions(stage, model))
            text += "; " + note;
          throw InputError(text);
        }
    }



    /**
     * The displacement from the places of an accepted step to equilibrium in
     * these: small strain has found it before points moved, and what holds
     * forces of another place would let go of the difference for good.
     * In a step of the stage @p before that has begun, which aims at its start
     * then; 0 with inertia.
     */
    template <int dim>
    LA::Vector
    to_equilibrium(const Scene<dim>         &scene,
                   const StageParameters    &before,
                   Model<dim>               &model,
                   std::vector<std::string> &notes)
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
      notes.push_back("what absorbs from now on holds forces that are out of "
                      "balance, as there is no equilibrium where points are by "
                      "now: " +
                      report.message);
      model.system->set_target(t);
      return model.space->vector();
    }



    /** How far an initial stress is from equilibrium, in a step that has begun.
     */
    template <int dim>
    std::string
    describe_balance(const StageParameters &stage, Model<dim> &model)
    {
      const double       share = model.system->unbalanced_share();
      std::ostringstream text;
      text << "initial stress: ";
      if (share < 1e-12)
        return text.str() + "in equilibrium to round-off";
      text << std::setprecision(100 * share < 10 ? 2 : 3) << 100 * share
           << " % of the forces are out of balance";
      if (std::any_of(model.boundaries.begin(),
                      model.boundaries.end(),
                      [&stage](const auto &boundary) {
                        return contains(stage.boundaries, boundary.name()) &&
                               !boundary.enforcement().carries_multiplier;
                      }))
        text << " (surfaces that cut cells begin to hold with the first step)";
      if (share > told_share_of_forces)
        text << (stage.time.integrator.dynamic() ?
                   "; they set the bodies in motion at once" :
                   "; the first step brings them to equilibrium");
      return text.str();
    }



    /** That boundaries which act are on material. */
    template <int dim>
    void
    check_places_of_boundaries(const StageParameters &stage,
                               const Model<dim>      &model)
    {
      const MPI_Comm communicator = model.space->communicator();
      for (const auto &boundary : model.boundaries)
        if (contains(stage.boundaries, boundary.name()) &&
            !contains(stage.absorbing, boundary.name()) &&
            boundary.n_points(communicator) == 0)
          throw InputError("section 'Boundaries/" + boundary.name() +
                           "': found a surface that touches no body, allowed: "
                           "a surface on or in a body, which is behind it: "
                           "points the other way round, or 'Flip', turn it");
      for (const auto &boundary : model.absorbing_boundaries)
        if (boundary.has_cells() && boundary.n_on_material() == 0)
          throw InputError(
            "section '" +
            (boundary.is_on_side() ? std::string("Grid conditions/") :
                                     std::string("Boundaries/")) +
            boundary.name() + "': found a " +
            (boundary.is_on_side() ? "side" : "surface") +
            " that touches no body, allowed: one on or in a body");
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  begin_first_step(const Scene<dim> &scene, Model<dim> &model)
  {
    const StageParameters &stage  = scene.stages.front().second;
    MechanicsSystem<dim>  &system = *model.system;
    system.begin_step(scene.start_time());
    check_places_of_boundaries(stage, model);
    std::vector<std::string> notes;
    check_prescribed_motion(stage, true, model, notes);
    check_displacements_at_start(scene, stage, nullptr, model, notes);
    check_loads(stage, model, notes);
    tell_of_loads_outside(model, notes);
    tell_of_point_volumes(model, notes);
    tell_of_skipped_tables(scene, stage, notes);
    tell_of_absorbing_at_rest(scene, stage, model, notes);
    tell_of_thin_bodies(stage, model, {}, notes);
    tell_of_near_bodies(model, {}, notes);
    tell_of_narrow_gaps(model, {}, notes);
    tell_of_boundaries(scene, model, notes);
    model.probes->tell_of_absent(*model.points, model.body_names, notes);
    model.probes->check_places(
      grid_evaluation<dim>(*model.space, model.state->nodal_increments()),
      model.points->exchanged());
    const ExactSolution<dim> exact = scene.exact.solution();
    if (exact.displacement || exact.stress)
      error_norms(*model.points, exact, scene.end_time(), false);
    if (begins_with_stress(scene, 0))
      {
        hold_stress_at_start(stage, {}, model);
        notes.push_back(describe_balance(stage, model));
      }
    if (stage.time.integrator.dynamic())
      start_motion(scene, stage, model, notes);
    else
      check_that_it_is_held(stage, model);
    return notes;
  }



  template <int dim>
  std::vector<std::string>
  begin_stage(const Scene<dim> &scene, const unsigned int k, Model<dim> &model)
  {
    const StageParameters &stage  = scene.stages[k].second,
                          &before = scene.stages[k - 1].second;
    const double          t       = stage.time.start_time;
    MechanicsSystem<dim> &system  = *model.system;
    // What absorbs from now on holds what it held so far.
    std::vector<std::pair<std::string, LA::Vector>> held;
    std::vector<std::string>                        notes;
    LA::Vector                                      x;
    for (const std::string &name : stage.absorbing)
      if (!contains(before.absorbing, name))
        {
          if (held.empty())
            x = to_equilibrium(scene, before, model, notes);
          held.emplace_back(name, system.constraint_forces(name, x));
        }

    if (stage.bodies != before.bodies || stage.loads != before.loads)
      tell_of_removed_bodies(stage, before, model, notes);
    if (stage.bodies != before.bodies)
      {
        remove_absorbing_places(stage, model, notes);
        tell_of_not_absorbed(scene, stage, before, model, notes);
      }
    model.linear_solver->clear();
    model.set_stage(scene, k);
    try
      {
        system.begin_step(t);
      }
    catch (const ComputationError &error)
      {
        // What goes with a body is why nothing is left.
        std::string text =
          "as stage '" + scene.stages[k].first + "' begins, " + error.what();
        for (const std::string &note : notes)
          text += "; " + note;
        throw ComputationError(text);
      }
    for (const auto &[name, forces] : held)
      {
        const double missed = system.hold(name, forces);
        if (missed > 0.01)
          notes.push_back(name + ": " +
                          std::to_string(std::lround(100 * missed)) +
                          " % of the forces that it held are no traction on "
                          "it, and end");
      }
    if (!held.empty())
      system.begin_step(t); // with what is held among the forces at its start
    if (stage.reset_displacements)
      {
        model.probes->reset_displacements(*model.points);
        model.points->reset_displacements();
      }
    if (stage.bodies != before.bodies)
      model.probes->tell_of_absent(*model.points, model.body_names, notes);
    check_places_of_boundaries(stage, model);
    check_prescribed_motion(stage, false, model, notes);
    check_displacements_at_start(scene, stage, &before, model, notes);
    check_loads(stage, model, notes);
    tell_of_volume_twice(model, stage.bodies, before.bodies, notes);
    tell_of_thin_bodies(stage, model, before.bodies, notes);
    tell_of_near_bodies(model, before.bodies, notes);
    tell_of_narrow_gaps(model, before.bodies, notes);
    tell_of_skipped_tables(scene, stage, notes);
    tell_of_absorbing_at_rest(scene, stage, model, notes);
    hold_stress_of_newcomers(stage, before, model);
    hold_stress_at_start(stage, before.boundaries, model);
    tell_of_gaps(stage, before, model, notes);
    tell_of_material_behind(stage, before.boundaries, model, notes);
    tell_of_ends(stage, before.boundaries, model, notes);
    for (const Effect &effect : system.effects())
      if (effect.kind == "note")
        notes.push_back(effect.text);
    if (begins_with_stress(scene, k))
      notes.push_back(describe_balance(stage, model));
    const bool dynamic = stage.time.integrator.dynamic();
    if (dynamic && !before.time.integrator.dynamic())
      start_motion(scene, stage, model, notes);
    else if (!dynamic)
      {
        if (before.time.integrator.dynamic())
          model.motion->rest();
        check_that_it_is_held(stage, model);
      }
    else if (forces_jump(before, stage))
      {
        set_first_target(stage.time, model);
        find_accelerations(model);
      }
    return notes;
  }



  template std::vector<std::string>
  begin_stage(const Scene<2> &, const unsigned int, Model<2> &);
  template std::vector<std::string>
  begin_stage(const Scene<3> &, const unsigned int, Model<3> &);
  template std::vector<std::string>
  begin_first_step(const Scene<2> &, Model<2> &);
  template std::vector<std::string>
  begin_first_step(const Scene<3> &, Model<3> &);
} // namespace moraine
