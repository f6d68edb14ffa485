// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of Simulation that steps.

#include <moraine/run/simulation.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/interrupt.h>
#include <moraine/output/grid_evaluation.h>
#include <moraine/output/on_root.h>
#include <moraine/run/command_line.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <filesystem>
#include <iomanip>

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
  Summary
  Simulation<dim>::run(const RunOptions &options, const InputFile &input)
  {
    describe();
    if (options.write_output)
      {
        directory.emplace(options.output_directory,
                          options.overwrite,
                          communicator);
        directory->write_parameter_files(input.text(), scene.parameters());
        on_root(communicator,
                [&]() { console.open_log(directory->file("log.txt")); });
        history.emplace(directory->file("history.csv"), communicator);
        points_pvd.emplace(directory->file("points.pvd"), communicator);
        mesh_pvd.emplace(directory->file("mesh.pvd"), communicator);
        if (scene.output.points && basis->has_domains())
          {
            on_root(communicator, [&]() {
              std::filesystem::create_directory(directory->file("domains"));
            });
            domains_pvd.emplace(directory->file("domains.pvd"), communicator);
          }
        last_increments.assign(space->n_nodes(), Tensor<1, dim>());
        write_vtu(scene.time.start_time);
        console << "  results in  " << options.output_directory << '\n'
                << std::endl;
      }

    TimeControl time(scene.time);
    std::string status = "ok", message;
    try
      {
        while (!time.finished())
          {
            if (interrupted(communicator))
              {
                status  = "interrupted";
                message = "stopped by the user after the last accepted step";
                break;
              }
            advance(time);
          }
      }
    catch (const InputError &error)
      {
        const InputError located(input.located(error.what()));
        end_if_alone(wrong_input, located.what());
        keep_summary_of_failure(time, located.what());
        throw located;
      }
    catch (const ComputationError &error)
      {
        end_if_alone(not_converged, error.what());
        status  = "not converged";
        message = error.what();
      }
    catch (const std::exception &error)
      {
        end_if_alone(internal_error, error.what());
        throw;
      }

    if (directory && t_written < time.time())
      write_points(time.time());
    Summary summary = make_summary(time);
    summary.status  = status;
    summary.message = message;
    if (directory)
      summary.write(directory->file("summary.json"), communicator);
    print_closing(summary);
    on_root(communicator, [&]() { console.close_log(); });
    return summary;
  }



  template <int dim>
  void
  Simulation<dim>::advance(TimeControl &time)
  {
    if (!first_step)
      system->begin_step(time.time(), [this]() { linear_solver->clear(); });
    Newton     newton(scene.newton);
    LA::Vector x;
    for (;;)
      {
        time.next();
        system->set_target(time.trial_time());
        system->initial_guess(x);
        if (!first_step && system->coupling_changed())
          {
            system->assemble(x, true);
            system->check_that_it_is_held(false);
            system->start_over();
          }
        NewtonReport report = newton.solve(*system, *linear_solver, x);
        count(report);
        if (report.status == NewtonStatus::linear_solver_failed &&
            hold_empty_parts(report))
          continue;
        const bool jumps =
          !report.converged() && !time.can_cut() &&
          report.status != NewtonStatus::linear_solver_failed &&
          scene.newton.limit_points == "jump";
        if (jumps)
          report = jump(newton, report, x);
        condition_number = std::max(condition_number, report.condition_number);
        const std::string reason = reason_to_reject(report, x);
        if (reason.empty())
          {
            if (mesh_motion.moves())
              mesh->check_motion([&](const Point<dim> &X) {
                return mesh_motion.map(X, time.time(), time.trial_time());
              });
            check_that_points_stay(time, x);
            if (jumps)
              note_jump(time);
            time.accept(report.iterations);
            print_step(time, report);
            break;
          }
        console << "  step to t = " << time.trial_time()
                << " rejected: " << reason << std::endl;
        if (!time.reject(reason))
          throw ComputationError(
            time.message() +
            (scene.newton.limit_points == "stop" &&
                 (report.status == NewtonStatus::diverged ||
                  report.status == NewtonStatus::too_many_iterations) ?
               " If a path of equilibria ends here, 'Limit points = jump' in "
               "section 'Solver' looks for one beyond." :
               ""));
      }
    note_domains();
    first_step = false;
    probes->accept_step(
      grid_evaluation<dim>(*space, state->nodal_increments()));
    last_increments = state->nodal_increments();
    reports         = system->accept(x);
    write_results(time, scene.output.times.due(time));
  }



  template <int dim>
  void
  Simulation<dim>::count(const NewtonReport &report)
  {
    newton_iterations += report.iterations;
    linear_iterations += report.linear_iterations;
    solver_name = report.linear_solver;
  }



  template <int dim>
  NewtonReport
  Simulation<dim>::jump(Newton             &newton,
                        const NewtonReport &failed,
                        LA::Vector         &x)
  {
    NewtonReport report = newton.jump(*system, *linear_solver, x);
    count(report);
    if (!report.converged())
      report.message = failed.message + "; no jump: " + report.message;
    return report;
  }



  template <int dim>
  std::string
  Simulation<dim>::reason_to_reject(const NewtonReport &report,
                                    const LA::Vector   &x)
  {
    if (report.status == NewtonStatus::linear_solver_failed &&
        scene.method.empty_stiffness == 0 && !holds_empty_parts)
      return report.message +
             " (nodes that too few points touch can be the cause; "
             "'Empty stiffness = 1e-6' in section 'Method' holds them)";
    if (!report.converged())
      return report.message.empty() ? to_string(report.status) : report.message;
    if (holds_empty_parts &&
        system->share_of_empty_parts() > largest_empty_share)
      return "what points leave empty would carry the load: too few points in "
             "the cells, or a body that is not held";
    state->set_trial(x);
    const std::string fault = system->fault_of_domains();
    if (!fault.empty())
      return fault;
    return system->worst_penetration_over_limit(x) > 1 ?
             "a point would end behind a boundary" :
             "";
  }



  template <int dim>
  bool
  Simulation<dim>::hold_empty_parts(const NewtonReport &report)
  {
    if (holds_empty_parts || scene.method.empty_stiffness > 0 ||
        report.linear_solver.rfind("direct", 0) != 0)
      return false;
    LA::Vector x;
    system->initial_guess(x);
    system->assemble(x, true);
    system->check_that_it_is_held(false);
    if (!system->stiffen_empty_parts(automatic_empty_stiffness))
      {
        system->stiffen_empty_parts(0.);
        return false;
      }
    holds_empty_parts = true;
    effects.push_back("stiffness of empty parts");
    console << "  note: " << report.message
            << ": probably too few points touch some nodes; from here on empty "
               "parts of cells have "
            << automatic_empty_stiffness
            << " of the material's stiffness (Method / Empty stiffness)"
            << std::endl;
    return true;
  }



  template <int dim>
  void
  Simulation<dim>::check_that_points_stay(const TimeControl &time,
                                          const LA::Vector  &x)
  {
    if (state->mesh_after_step() != MeshAfterStep::reset)
      return;
    state->set_trial(x);
    const auto  increments = state->point_increments();
    const auto  box = GridTools::compute_bounding_box(mesh->triangulation());
    std::string message;
    for (const auto &in_cell : points->cells())
      for (unsigned int p = in_cell.first; p < in_cell.last && message.empty();
           ++p)
        {
          const Point<dim> x_new = points->position(p) + increments[p];
          // Where that is in the mesh before it moves.
          const Point<dim> X =
            mesh_motion.map(x_new, time.trial_time(), time.time());
          if (box.point_inside(X) &&
              (mesh->box_grid() || in_cell.cell->point_inside(X) ||
               GridTools::find_active_cell_around_point(mesh->search_cache(),
                                                        X,
                                                        in_cell.cell)
                   .first.state() == IteratorState::valid ||
               points->place_for(X)))
            continue;
          std::ostringstream text;
          text << "point " << points->id(p) << " of body '"
               << body_names[points->body(p)] << "' leaves the mesh at ("
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



#define INSTANTIATE(dim) \
  template Summary Simulation<dim>::run(const RunOptions &, const InputFile &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
