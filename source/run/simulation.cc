// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/simulation.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/memory.h>
#include <moraine/core/version.h>
#include <moraine/output/on_root.h>
#include <moraine/run/command_line.h>
#include <moraine/run/console_report.h>
#include <moraine/run/result_files.h>
#include <moraine/run/step_driver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Wall time of a run, as a whole and by part of the program. */
    struct RunTimes
    {
      Timer              whole;
      std::ostringstream unused;
      TimerOutput parts{unused, TimerOutput::never, TimerOutput::wall_times};
    };



    /** Names of what acts in a scene. */
    template <int dim>
    std::vector<std::string>
    effects_of(const Scene<dim> &scene, const Model<dim> &model)
    {
      std::vector<std::string> effects{"internal force"};
      if (scene.method.empty_stiffness > 0)
        effects.push_back("stiffness of empty parts");
      for (const auto &[name, boundary] : scene.boundaries)
        effects.push_back("implicit boundary " + name + " (" +
                          boundary.enforcement.enforcement + ")");
      for (const auto &condition : model.grid_conditions)
        effects.push_back("grid condition " + condition.name);
      for (const auto &[name, load] : scene.loads)
        effects.push_back(load.type + " " + name);
      return effects;
    }



    template <int dim>
    void
    add_results(const Scene<dim>      &scene,
                const Model<dim>      &model,
                const StepDriver<dim> &driver,
                Summary               &summary)
    {
      const ExactSolution<dim> exact = scene.exact.solution();
      if (exact.displacement || exact.stress)
        summary.errors =
          error_norms(*model.points,
                      exact,
                      driver.time().time(),
                      model.state->mesh_after_step() != MeshAfterStep::keep);
      for (const auto &value : model.probes->values(*model.points))
        summary.probes.emplace_back(value.name, value.value);
      for (const auto &report : driver.reports())
        {
          std::vector<double> reaction(dim);
          for (unsigned int d = 0; d < dim; ++d)
            reaction[d] = report.reaction[d];
          summary.reactions.emplace_back(report.name, reaction);
        }
    }



    template <int dim>
    void
    add_timings(const Model<dim> &model,
                const RunTimes   &times,
                const RunCounts  &counts,
                Summary          &summary)
    {
      summary.wall_seconds = times.whole.wall_time();
      for (const auto &[name, seconds] :
           times.parts.get_summary_data(TimerOutput::total_wall_time))
        summary.timings.emplace_back(name, seconds);
      const LinearSolver &solver = *model.linear_solver;
      summary.timings.emplace_back("solver set up", solver.set_up_seconds());
      summary.timings.emplace_back("solve", solver.solve_seconds());
      if (counts.condition_number)
        summary.timings.emplace_back("condition number",
                                     solver.condition_seconds());
    }



    /** What is known after the last accepted step. Collective. */
    template <int dim>
    Summary
    make_summary(const Scene<dim>      &scene,
                 const Model<dim>      &model,
                 const StepDriver<dim> &driver,
                 const RunTimes        &times)
    {
      const MPI_Comm   communicator = model.space->communicator();
      const RunCounts &counts       = driver.counts();
      Summary          summary;
      summary.version   = version;
      summary.dimension = dim;
      summary.ranks     = Utilities::MPI::n_mpi_processes(communicator);
      summary.cells     = model.mesh->triangulation().n_global_active_cells();
      summary.active_cells      = model.space->n_active_cells();
      summary.unknowns          = model.space->n_dofs();
      summary.points            = model.points->n_global();
      summary.steps             = driver.time().n_accepted();
      summary.rejected_steps    = driver.time().n_rejected();
      summary.jumps             = counts.jumps;
      summary.newton_iterations = counts.newton_iterations;
      summary.linear_iterations = counts.linear_iterations;
      summary.condition_number  = counts.condition_number;
      summary.bytes_per_point   = model.points->bytes_per_point();
      summary.peak_memory_mib   = memory_in_use(communicator).peak_mib;
      summary.effects           = effects_of(scene, model);
      if (counts.holds_empty_parts)
        summary.effects.push_back("stiffness of empty parts");
      add_timings(model, times, counts, summary);
      add_results(scene, model, driver, summary);
      return summary;
    }



    /**
     * Step to the end and tell the observers how it ended.
     * @return the summary, unless the run fails by a mistake in the input.
     */
    template <int dim>
    Summary
    run_steps(const Scene<dim>                      &scene,
              const InputFile                       &input,
              const Model<dim>                      &model,
              StepDriver<dim>                       &driver,
              const std::vector<RunObserver<dim> *> &observers,
              const RunTimes                        &times)
    {
      const auto fail = [&](const ExitCode code, const std::string &what) {
        end_if_alone(code, what);
        Summary summary = make_summary(scene, model, driver, times);
        summary.status  = "failed";
        summary.message = what;
        for (RunObserver<dim> *observer : observers)
          observer->run_fails(summary);
      };
      std::string status = "ok", message;
      try
        {
          if (!driver.run())
            {
              status  = "interrupted";
              message = "stopped by the user after the last accepted step";
            }
        }
      catch (const InputError &error)
        {
          const InputError located(input.located(error.what()));
          fail(wrong_input, located.what());
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
          fail(internal_error, error.what());
          throw;
        }
      Summary summary = make_summary(scene, model, driver, times);
      summary.status  = status;
      summary.message = message;
      for (RunObserver<dim> *observer : observers)
        observer->run_ends(summary, driver.counts());
      return summary;
    }
  } // namespace



  template <int dim>
  Summary
  simulate(Scene<dim>       &scene,
           const InputFile  &input,
           const RunOptions &options,
           const MPI_Comm   &communicator,
           Console          &console)
  {
    RunTimes           times;
    Model<dim>         model(scene, communicator, times.parts);
    ConsoleReport<dim> report(scene,
                              model,
                              options.write_output ? options.output_directory :
                                                     "",
                              console);
    report.describe(begin_first_step(scene, model));

    std::optional<OutputDirectory>  directory;
    std::optional<ResultFiles<dim>> files;
    std::vector<RunObserver<dim> *> observers;
    if (options.write_output)
      {
        directory.emplace(options.output_directory,
                          options.overwrite,
                          communicator);
        directory->write_parameter_files(input.text(), scene.parameters());
        on_root(communicator,
                [&]() { console.open_log(directory->file("log.txt")); });
        files.emplace(scene, model, *directory, times.parts);
        observers.push_back(&*files);
      }
    observers.push_back(&report);
    StepDriver<dim> driver(scene, model, observers);
    const Summary   summary =
      run_steps(scene, input, model, driver, observers, times);
    on_root(communicator, [&]() { console.close_log(); });
    return summary;
  }



  template <int dim>
  void
  describe(const Scene<dim> &scene,
           const MPI_Comm   &communicator,
           Console          &console)
  {
    RunTimes   times;
    Model<dim> model(scene, communicator, times.parts);
    ConsoleReport<dim>(scene, model, "", console)
      .describe(begin_first_step(scene, model));
  }



#define INSTANTIATE(dim)                        \
  template Summary simulate(Scene<dim> &,       \
                            const InputFile &,  \
                            const RunOptions &, \
                            const MPI_Comm &,   \
                            Console &);         \
  template void    describe(const Scene<dim> &, const MPI_Comm &, Console &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
