// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/step_driver.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/interrupt.h>
#include <moraine/output/grid_evaluation.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Holds nodes that too few points touch. */
    constexpr double automatic_empty_stiffness = 1e-6;

    /** Held nodes carry next to nothing; a mechanism hangs on empty parts. */
    constexpr double largest_empty_share = 1e-3;
  } // namespace



  template <int dim>
  StepDriver<dim>::StepDriver(const Scene<dim>                      &scene,
                              Model<dim>                            &model,
                              const std::vector<RunObserver<dim> *> &observers)
    : newton_parameters(scene.newton)
    , empty_stiffness(scene.method.empty_stiffness)
    , model(model)
    , observers(observers)
    , communicator(model.space->communicator())
    , newton(scene.newton)
    , time_control(scene.time)
  {}



  template <int dim>
  bool
  StepDriver<dim>::run()
  {
    for (RunObserver<dim> *observer : observers)
      observer->run_begins();
    while (!time_control.finished())
      {
        if (interrupted(communicator))
          return false;
        advance();
      }
    return true;
  }



  template <int dim>
  void
  StepDriver<dim>::advance()
  {
    if (!first_step)
      model.system->begin_step(time_control.time(),
                               [this]() { model.linear_solver->clear(); });
    for (;;)
      {
        time_control.next();
        LA::Vector   x;
        NewtonReport report = solve(x);
        const bool   jumps  = may_jump(report);
        if (jumps)
          report = jump(report, x);
        sums.condition_number =
          std::max(sums.condition_number, report.condition_number);
        const std::string reason = reason_to_reject(report, x);
        if (reason.empty())
          return accept(report, x, jumps);
        reject(report, reason);
      }
  }



  template <int dim>
  NewtonReport
  StepDriver<dim>::solve(LA::Vector &x)
  {
    MechanicsSystem<dim> &system = *model.system;
    for (;;)
      {
        system.set_target(time_control.trial_time());
        system.initial_guess(x);
        if (!first_step && system.coupling_changed())
          {
            system.assemble(x, true);
            system.check_that_it_is_held(false);
            system.start_over();
          }
        const NewtonReport report =
          newton.solve(system, *model.linear_solver, x);
        count(report);
        if (report.status != NewtonStatus::linear_solver_failed ||
            !hold_empty_parts(report))
          return report;
      }
  }



  template <int dim>
  bool
  StepDriver<dim>::may_jump(const NewtonReport &report) const
  {
    return !report.converged() && !time_control.can_cut() &&
           report.status != NewtonStatus::linear_solver_failed &&
           newton_parameters.limit_points == "jump";
  }



  template <int dim>
  NewtonReport
  StepDriver<dim>::jump(const NewtonReport &failed, LA::Vector &x)
  {
    NewtonReport report = newton.jump(*model.system, *model.linear_solver, x);
    count(report);
    if (!report.converged())
      report.message = failed.message + "; no jump: " + report.message;
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
                          const bool          jumped)
  {
    if (model.mesh_motion.moves())
      model.mesh->check_motion([&](const Point<dim> &X) {
        return model.mesh_motion.map(X,
                                     time_control.time(),
                                     time_control.trial_time());
      });
    check_that_points_stay(x);
    const std::vector<Tensor<1, dim>> increments =
      model.state->nodal_increments();
    model.probes->try_step(grid_evaluation<dim>(*model.space, increments));
    last_reports = model.system->accept(x);
    model.probes->keep_step();
    const double t_start = time_control.time();
    time_control.accept(report.iterations);
    first_step = false;

    std::optional<double> distance;
    if (jumped)
      {
        ++sums.jumps;
        double largest = 0;
        for (const auto &u : increments)
          largest = std::max(largest, u.norm());
        distance = Utilities::MPI::max(largest, communicator);
      }
    const AcceptedStep<dim> step{
      time_control, t_start, report, last_reports, increments, distance};
    for (RunObserver<dim> *observer : observers)
      observer->step_accepted(step);
  }



  template <int dim>
  void
  StepDriver<dim>::reject(const NewtonReport &report, const std::string &reason)
  {
    for (RunObserver<dim> *observer : observers)
      observer->step_rejected(time_control.trial_time(), reason);
    if (time_control.reject(reason))
      return;
    const bool path_may_end =
      report.status == NewtonStatus::diverged ||
      report.status == NewtonStatus::too_many_iterations;
    throw ComputationError(
      time_control.message() +
      (newton_parameters.limit_points == "stop" && path_may_end ?
         " If a path of equilibria ends here, 'Limit points = jump' in "
         "section 'Solver' looks for one beyond." :
         ""));
  }



  template <int dim>
  std::string
  StepDriver<dim>::reason_to_reject(const NewtonReport &report,
                                    const LA::Vector   &x)
  {
    if (report.status == NewtonStatus::linear_solver_failed &&
        empty_stiffness == 0 && !sums.holds_empty_parts)
      return report.message +
             " (nodes that too few points touch can be the cause; "
             "'Empty stiffness = 1e-6' in section 'Method' holds them)";
    if (!report.converged())
      return report.message.empty() ? to_string(report.status) : report.message;
    if (sums.holds_empty_parts &&
        model.system->share_of_empty_parts() > largest_empty_share)
      return "what points leave empty would carry the load: too few points in "
             "the cells, or a body that is not held";
    model.state->set_trial(x);
    const std::string fault = model.system->fault_of_domains();
    if (!fault.empty())
      return fault;
    return model.system->worst_penetration_over_limit(x) > 1 ?
             "a point would end behind a boundary" :
             "";
  }



  template <int dim>
  bool
  StepDriver<dim>::hold_empty_parts(const NewtonReport &report)
  {
    if (sums.holds_empty_parts || empty_stiffness > 0 ||
        !model.linear_solver->solves_directly())
      return false;
    MechanicsSystem<dim> &system = *model.system;
    LA::Vector            x;
    system.initial_guess(x);
    system.assemble(x, true);
    system.check_that_it_is_held(false);
    if (!system.stiffen_empty_parts(automatic_empty_stiffness))
      {
        system.stiffen_empty_parts(0.);
        return false;
      }
    sums.holds_empty_parts = true;
    std::ostringstream text;
    text << report.message
         << ": probably too few points touch some nodes; from here on empty "
            "parts of cells have "
         << automatic_empty_stiffness
         << " of the material's stiffness (Method / Empty stiffness)";
    for (RunObserver<dim> *observer : observers)
      observer->note(text.str());
    return true;
  }



  template <int dim>
  void
  StepDriver<dim>::check_that_points_stay(const LA::Vector &x)
  {
    State<dim>                &state  = *model.state;
    const BackgroundMesh<dim> &mesh   = *model.mesh;
    const PointSet<dim>       &points = *model.points;
    const TimeControl         &time   = time_control;
    if (state.mesh_after_step() != MeshAfterStep::reset)
      return;
    state.set_trial(x);
    const auto  increments = state.point_increments();
    const auto  box = GridTools::compute_bounding_box(mesh.triangulation());
    std::string message;
    for (const auto &in_cell : points.cells())
      for (unsigned int p = in_cell.first; p < in_cell.last && message.empty();
           ++p)
        {
          const Point<dim> x_new = points.position(p) + increments[p];
          // Where that is in the mesh before it moves.
          const Point<dim> X =
            model.mesh_motion.map(x_new, time.trial_time(), time.time());
          if (box.point_inside(X) &&
              (mesh.box_grid() || in_cell.cell->point_inside(X) ||
               GridTools::find_active_cell_around_point(mesh.search_cache(),
                                                        X,
                                                        in_cell.cell)
                   .first.state() == IteratorState::valid ||
               points.place_for(X)))
            continue;
          std::ostringstream text;
          text << "point " << points.id(p) << " of body '"
               << model.body_names[points.body(p)] << "' leaves the mesh at ("
               << std::setprecision(10) << x_new << ") in step "
               << time.n_accepted() + 1 << ", t = " << time.trial_time()
               << "; the results end with the last accepted step, t = "
               << time.time();
          message = text.str();
        }
    for (const std::string &text :
         Utilities::MPI::all_gather(communicator, message))
      if (!text.empty())
        throw ComputationError(text);
  }



  template class StepDriver<2>;
  template class StepDriver<3>;
} // namespace moraine
