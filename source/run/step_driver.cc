// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/step_driver.h>

#include <moraine/assembly/aggregation.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/interrupt.h>
#include <moraine/core/words.h>
#include <moraine/output/grid_evaluation.h>
#include <moraine/run/stage_start.h>
#include <moraine/run/step_failure.h>
#include <moraine/scene/scene_curves.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The user wants the step under way to be given up. */
    struct Interruption
    {};

    std::vector<TimeParameters>
    times_of(const NamedStages &stages)
    {
      std::vector<TimeParameters> times;
      for (const auto &[name, stage] : stages)
        times.push_back(stage.time);
      return times;
    }



    /** How far nodes have taken a place of the mesh as it was built. */
    template <int dim>
    PlaceFunction<dim>
    move_of_nodes(const GridSpace<dim> &space)
    {
      return [&space](const Point<dim> &place, Tensor<1, dim> &move) {
        std::vector<Tensor<1, dim>> moves;
        for (unsigned int node = 0; node < space.n_nodes(); ++node)
          moves.push_back(space.node_move(node));
        return grid_evaluation<dim>(space, moves)(place, move);
      };
    }



    /** Of all ranks. */
    template <int dim>
    double
    largest_norm(const std::vector<Tensor<1, dim>> &vectors,
                 const MPI_Comm                    &communicator)
    {
      double largest = 0;
      for (const auto &v : vectors)
        largest = std::max(largest, v.norm());
      return Utilities::MPI::max(largest, communicator);
    }
  } // namespace



  template <int dim>
  StepDriver<dim>::StepDriver(const Scene<dim> &scene,
                              Model<dim>       &model,
                              Diagnostics<dim> &diagnostics,
                              const std::vector<RunObserver<dim> *> &observers)
    : scene(scene)
    , method(scene.method)
    , model(model)
    , observers(observers)
    , communicator(model.space->communicator())
    , newton(scene.newton)
    , time_control(times_of(scene.stages), asked_times(scene))
    , fading(*model.space)
    , diagnostics(diagnostics)
  {
    if (model.mesh_motion.moves())
      lasting.add(*model.mesh);
    lasting.add(*model.points);
    if (model.mesh_motion.moves() ||
        model.state->mesh_after_step() == MeshAfterStep::follow_material)
      lasting.add(*model.space);
    if (model.motion)
      lasting.add(*model.motion);
    for (auto &boundary : model.boundaries)
      lasting.add(boundary);
    for (auto &boundary : model.absorbing_boundaries)
      lasting.add(boundary);
    for (auto &boundary : model.contact_boundaries)
      lasting.add(boundary);
    for (auto &load : model.loads.carried)
      lasting.add(load);
    for (auto &load : model.loads.on_points)
      lasting.add(load);
    lasting.add(*model.probes);
    lasting.add(time_control);
    lasting.add(fading);
    if (scene.stages.back().second.time.follows_path())
      lasting.add(
        last_increment.emplace(*model.space, "path/increment", "length"));
    for (RunObserver<dim> *observer : observers)
      if (StatePart *record = observer->record())
        lasting.add_record(*record);
  }



  template <int dim>
  bool
  StepDriver<dim>::run(const std::function<void()> &after_step)
  {
    newton.watch(report_iteration());
    for (RunObserver<dim> *observer : observers)
      if (time_control.n_accepted() == 0)
        observer->run_begins();
      else
        observer->run_resumes(time_control);
    // What went on and takes no step is asked for its sizes all the same.
    if (!first_step && (time_control.finished() || is_to_end()))
      model.system->begin_step(time_control.time());
    while (!time_control.finished())
      {
        if (is_to_end())
          return false;
        const RunCounts before = sums;
        try
          {
            advance();
          }
        catch (const Interruption &)
          {
            undo();
            sums = before;
            return false;
          }
        if (after_step && !time_control.between_parts())
          after_step();
      }
    return true;
  }



  template <int dim>
  void
  StepDriver<dim>::undo()
  {
    lasting.undo([this](const Archive &accepted) {
      if (!stage_is_begun)
        find_stencils(accepted);
    });
    if (!stage_is_begun)
      model.system->set_motion(
        scene.stages[stage - 1].second.time.integrator.dynamic() ?
          model.motion.get() :
          nullptr);
  }



  template <int dim>
  bool
  StepDriver<dim>::is_to_end() const
  {
    // A stiffness that the step under way has given to empty parts is no part
    // of the last accepted state.
    return !time_control.between_parts() &&
           (!support || support->stiffness_fraction() == accepted_fraction) &&
           interrupted(communicator);
  }



  template <int dim>
  Newton::Watcher
  StepDriver<dim>::report_iteration() const
  {
    return [this](const NewtonIteration &iteration) {
      for (RunObserver<dim> *observer : observers)
        observer->newton_iteration(iteration, time_control);
      if (is_to_end())
        throw Interruption();
    };
  }



  template <int dim>
  void
  StepDriver<dim>::advance()
  {
    if (time_control.stage() != stage)
      begin_next_stage();
    else if (!first_step)
      model.system->begin_step(time_control.time(),
                               [this]() { model.linear_solver->clear(); });
    ask(When::step_begins);
    for (unsigned int n_rejections = 0;;)
      {
        if (n_rejections > 0 && is_to_end())
          throw Interruption();
        time_control.next();
        if (scene.stages[stage].second.time.integrator.dynamic())
          model.motion->set_integrator(time_control.integrator());
        LA::Vector   x;
        NewtonReport report = solve(x);
        const bool   passes = may_pass_limit_point(report);
        if (passes)
          report = pseudo_transient(report, x);
        sums.condition_number =
          std::max(sums.condition_number, report.condition_number);
        const std::string too_long = error_too_large(report, x);
        std::string       reason =
          too_long.empty() ? reason_to_reject(report, x) : too_long;
        if (reason.empty() && may_support_more())
          reason = point_that_leaves(model, time_control, x);
        if (reason.empty())
          return accept(report, x, passes);
        n_rejections = too_long.empty() ? n_rejections + 1 : 0;
        reject(report, reason, n_rejections);
      }
  }



  template <int dim>
  void
  StepDriver<dim>::begin_next_stage()
  {
    model.system->begin_step(time_control.time());
    ++stage;
    stage_is_begun                 = false;
    const auto &[name, parameters] = scene.stages[stage];
    const auto &before             = scene.stages[stage - 1].second;
    tell(fmt::format("stage {}, {}, from t = {:.6g} to {:.6g}{}",
                     name,
                     parameters.time.integrator.integrator,
                     parameters.time.start_time,
                     parameters.time.end_time,
                     change_of_bodies(parameters, before)));
    if (parameters.reset_displacements)
      ask(When::strains_end);
    fading.has_term = false;
    diagnostics.stage_begins(parameters.bodies != before.bodies,
                             parameters.time.integrator.dynamic() &&
                               !before.time.integrator.dynamic());
    lasting.keep([&]() {
      begin_stage(scene, stage, model, diagnostics);
      if (support)
        add_support(accepted_fraction, false);
    });
    stage_is_begun = true;
  }



  template <int dim>
  NewtonReport
  StepDriver<dim>::solve(LA::Vector &x)
  {
    MechanicsSystem<dim> &system = *model.system;
    for (;;)
      {
        // Along a path the time is found from where it is.
        system.set_target(time_control.follows_path() ?
                            time_control.time() :
                            time_control.trial_time());
        system.initial_guess(x);
        const NewtonReport report =
          time_control.follows_path() ?
            follow_path(x) :
            newton.solve(system, *model.linear_solver, x);
        count(report);
        if (report.status != NewtonStatus::linear_solver_failed ||
            !model.linear_solver->solves_directly() || !hold_empty_parts())
          return report;
      }
  }



  template <int dim>
  NewtonReport
  StepDriver<dim>::follow_path(LA::Vector &x)
  {
    const TimeParameters &time = scene.stages[stage].second.time;
    PathStep              step{time_control.trial_length(),
                  time_control.time(),
                  time.earliest_time(),
                  time.end_time,
                  {}};
    if (time_control.path_length() > 0)
      step.before = {last_increment->values(), time_control.path_rate()};
    const PathReport report = moraine::follow_path(scene.newton,
                                                   *model.system,
                                                   *model.linear_solver,
                                                   step,
                                                   x,
                                                   report_iteration());
    if (!report.parameter_acts)
      throw InputError(
        "section '" + time_section(scene.stages[stage].first) +
        "', key 'Arc length': found a path along which no load and no "
        "prescribed displacement changes with t, allowed: 0, or one that does");
    time_control.set_trial_time(report.t);
    return report;
  }



  template <int dim>
  bool
  StepDriver<dim>::may_pass_limit_point(const NewtonReport &report) const
  {
    return !report.converged() && !time_control.can_cut() &&
           report.status != NewtonStatus::linear_solver_failed &&
           scene.newton.limit_points == "pseudo-transient";
  }



  template <int dim>
  NewtonReport
  StepDriver<dim>::pseudo_transient(const NewtonReport &failed, LA::Vector &x)
  {
    NewtonReport report =
      newton.pseudo_transient(*model.system, *model.linear_solver, x);
    count(report);
    if (!report.converged())
      report.message =
        failed.message + "; pseudo-transient continuation: " + report.message;
    return report;
  }



  template <int dim>
  void
  StepDriver<dim>::count(const NewtonReport &report)
  {
    sums.newton_iterations += report.iterations;
    sums.linear_iterations += report.linear_iterations;
    sums.linear_solver = report.linear_solver;
  }



  template <int dim>
  void
  StepDriver<dim>::accept(const NewtonReport &report,
                          const LA::Vector   &x,
                          const bool          was_pseudo_transient)
  {
    if (model.mesh_motion.moves())
      model.mesh->check_motion([&](const Point<dim> &X) {
        return model.mesh_motion.map(X,
                                     time_control.time(),
                                     time_control.trial_time());
      });
    const std::string leaves = point_that_leaves(model, time_control, x);
    const std::vector<Tensor<1, dim>> increments =
      model.state->nodal_increments();
    motion.of_nodes = largest_norm(increments, communicator);
    // Nodes with next to no material can be flung further than any of it.
    motion.of_points =
      model.boundaries.empty() ?
        motion.of_nodes :
        largest_norm(model.state->point_increments(), communicator);
    const bool dynamic = scene.stages[stage].second.time.integrator.dynamic();
    if (!leaves.empty())
      throw ComputationError(leaves);
    typename Motion<dim>::Nodal nodal;
    const bool moves_probes = dynamic && model.probes->any_interpolated();
    if (moves_probes)
      nodal = model.motion->at_end();
    const auto at = [&](const std::vector<Tensor<1, dim>> &values) {
      return grid_evaluation<dim>(*model.space, values);
    };
    model.probes->try_step(at(increments),
                           *model.points,
                           moves_probes ? at(nodal.v) : PlaceFunction<dim>(),
                           moves_probes ? at(nodal.a) : PlaceFunction<dim>(),
                           model.state->mesh_after_step() ==
                               MeshAfterStep::follow_material ?
                             move_of_nodes(*model.space) :
                             PlaceFunction<dim>());
    count_ghost_term();
    const double t_start = time_control.time();
    const double growth  = allowed_growth(x);
    lasting.keep([&]() {
      last_reports = model.system->accept(x);
      model.probes->keep_step();
      time_control.accept(report.iterations, growth);
      if (last_increment)
        last_increment->keep(increments);
    });
    first_step = false;
    keep_support();

    ask(When::step_ends);
    std::optional<double> distance;
    if (was_pseudo_transient)
      {
        ++sums.n_pseudo_transient;
        distance = motion.of_nodes;
      }
    report_step(
      {time_control, t_start, report, last_reports, increments, distance});
    const std::string failure = diagnostics.failure();
    if (!failure.empty())
      throw ComputationError(failure);
  }



  template <int dim>
  void
  StepDriver<dim>::report_step(AcceptedStep<dim> step)
  {
    if (time_control.between_parts())
      {
        first_part.emplace(
          FirstPart{step.t_start, NodeValuesRecord<dim>(*model.space, "", "")});
        first_part->increment.keep(step.increments);
        return;
      }
    if (first_part)
      {
        const auto before = first_part->increment.of_nodes();
        for (unsigned int node = 0; node < before.size(); ++node)
          step.increments[node] += before[node];
        step.t_start = first_part->t_start;
        first_part.reset();
      }
    for (RunObserver<dim> *observer : observers)
      observer->step_accepted(step);
  }



  template <int dim>
  void
  StepDriver<dim>::ask(const When                   when,
                       const std::optional<double> &stress_error)
  {
    typename Facts<dim>::Moment moment;
    moment.stage         = &scene.stages[stage].second;
    moment.t             = time_control.time();
    moment.node_motion   = motion.of_nodes;
    moment.point_motion  = motion.of_points;
    moment.stress_error  = stress_error;
    moment.follows_path  = time_control.follows_path();
    moment.between_parts = time_control.between_parts();
    if (stage > 0)
      moment.before = &scene.stages[stage - 1].second;
    if (when == When::step_ends)
      moment.reports = &last_reports;
    const bool was_apart = diagnostics.ledger.has("separation");
    diagnostics.ask(when, moment);
    if (!was_apart && method.separation == "stop")
      for (const Finding &finding : diagnostics.ledger.findings())
        if (finding.id == "separation")
          throw ComputationError("body '" + finding.object +
                                 "': " + finding.text);
  }



  template <int dim>
  void
  StepDriver<dim>::ask_at_end(const std::optional<double> &stress_error)
  {
    ask(When::strains_end);
    ask(When::end, stress_error);
  }



  template <int dim>
  void
  StepDriver<dim>::count_ghost_term()
  {
    constexpr double allowed = 0.05;
    if (!method.has_ghost_term())
      return;
    const auto   share = model.system->share([](const Term<dim> &term) {
      return dynamic_cast<const GhostTerm<dim> *>(&term) != nullptr;
    });
    GhostShares &largest =
      sums.ghost_term ? *sums.ghost_term : sums.ghost_term.emplace();
    largest.of_forces = std::max(largest.of_forces, share.of_forces);
    largest.of_work   = std::max(largest.of_work, share.of_work);
    if (share.of_work > allowed)
      diagnostics.report({"ghost-term",
                          "",
                          share.of_work,
                          allowed,
                          "the ghost term took " + per_cent(share.of_work) +
                            " of the work of a step; raise 'Ghost factor', or "
                            "use 'Cut cells = aggregation'"});
  }



  template <int dim>
  void
  StepDriver<dim>::tell(const std::string &text) const
  {
    for (RunObserver<dim> *observer : observers)
      observer->note(text);
  }



  template class StepDriver<2>;
  template class StepDriver<3>;
} // namespace moraine
