// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/simulation.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/exit.h>
#include <moraine/core/memory.h>
#include <moraine/core/version.h>
#include <moraine/output/on_root.h>
#include <moraine/diagnostics/catalogue.h>
#include <moraine/diagnostics/stress.h>
#include <moraine/material/material_test.h>
#include <moraine/run/checkpoints.h>
#include <moraine/run/console_report.h>
#include <moraine/scene/located.h>
#include <moraine/run/history_row.h>
#include <moraine/run/result_files.h>
#include <moraine/run/resume.h>
#include <moraine/run/stage_start.h>
#include <moraine/run/step_driver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <cmath>
#include <memory>
#include <optional>
#include <set>
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



    /** Parts of the energy by name. */
    Summary::List<double>
    energy_of(const Works &works)
    {
      const auto  &W       = works.of_forces;
      const double largest = works.largest();
      return {{"kinetic", works.kinetic},
              {"kinetic_at_start", works.kinetic_at_start},
              {"strain", works.stored},
              {"strain_at_start", works.stored_at_start},
              {"plastic_dissipation", works.dissipated},
              {"damping", -W[unsigned(WorkKind::damping)]},
              {"external_work", W[unsigned(WorkKind::external)]},
              {"work_of_boundaries", W[unsigned(WorkKind::boundaries)]},
              {"absorbed", -W[unsigned(WorkKind::absorbed)]},
              {"lost_in_transfer", works.lost_in_transfer},
              {"numerical_damping", works.numerical_damping()},
              {"balance_error",
               largest > 0 ? std::abs(works.out_of_balance()) / largest : 0.}};
    }



    /** The largest displacement of points, and the share of the volume that has
     * yielded. */
    template <int dim>
    void
    add_motion(const Model<dim> &model, Summary &summary)
    {
      const PointSet<dim> &points       = *model.points;
      const MPI_Comm       communicator = model.space->communicator();
      const auto           u            = points.displacement_field();
      double               largest      = 0;
      std::vector<double>  volumes(2, 0.); // all, yielded
      const auto           plastic =
        points.fields().find(FieldName<dim, double>{"plastic_strain", "-"});
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          largest = std::max(largest, u(points.values(p)).norm());
          volumes[0] += points.volume(p);
          if (plastic.exists() && plastic(points.values(p)) > 0)
            volumes[1] += points.volume(p);
        }
      summary.quality.largest_displacement =
        Utilities::MPI::max(largest, communicator);
      Utilities::MPI::sum(volumes, communicator, volumes);
      if (plastic.exists())
        summary.quality.plastic_share = volumes[1] / volumes[0];
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
      summary.quality.stress_error = stress_error(driver.facts());
      add_motion(model, summary);
      if (model.system->step_context().motion)
        summary.energy = energy_of(model.motion->works());
      for (const auto &value : model.probes->values(*model.points))
        summary.last.probes.emplace_back(value.name, value.value);
      for (const auto &report : driver.reports())
        {
          std::vector<double> reaction(dim);
          for (unsigned int d = 0; d < dim; ++d)
            reaction[d] = report.reaction[d];
          summary.last.reactions.emplace_back(report.name, reaction);
        }
      for (const auto &value :
           history_row(scene,
                       model,
                       translations_of_conditions(scene, model),
                       driver.time(),
                       driver.reports()))
        summary.last.history.emplace_back(value.name, value.value);
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
      summary.version         = version;
      summary.sizes.units     = scene.output.units;
      summary.sizes.dimension = dim;
      summary.sizes.ranks     = Utilities::MPI::n_mpi_processes(communicator);
      summary.sizes.cells = model.mesh->triangulation().n_global_active_cells();
      summary.sizes.active_cells      = model.space->n_active_cells();
      summary.sizes.unknowns          = model.space->n_dofs();
      summary.sizes.points            = model.points->n_global();
      summary.time                    = driver.time().time();
      summary.steps                   = driver.time().n_accepted();
      summary.rejected_steps          = driver.time().n_rejected();
      summary.n_pseudo_transient      = counts.n_pseudo_transient;
      summary.newton_iterations       = counts.newton_iterations;
      summary.linear.iterations       = counts.linear_iterations;
      summary.linear.condition_number = counts.condition_number;
      summary.quality.ghost_term      = counts.ghost_term;
      summary.sizes.bytes_per_point   = model.points->bytes_per_point();
      summary.sizes.peak_memory_mib   = memory_in_use(communicator).peak_mib;
      summary.linear.solvers          = model.linear_solver->choices();
      for (const Effect &effect : model.system->effects())
        summary.effects.push_back(effect.name);
      add_timings(model, times, counts, summary);
      add_results(scene, model, driver, summary);
      return summary;
    }



    /** What checkpoints of a run say of it but for their time. */
    template <int dim>
    CheckpointLabel
    label_of(const InputFile  &input,
             Scene<dim>       &scene,
             const RunOptions &options,
             const MPI_Comm   &communicator)
    {
      CheckpointLabel label;
      label.version  = version;
      label.revision = revision;
      label.scene = options.saved ? options.saved->label.scene : input.name();
      label.dimension = dim;
      label.ranks     = Utilities::MPI::n_mpi_processes(communicator);
      std::ostringstream parameters;
      scene.parameters().print_parameters(
        parameters,
        ParameterHandler::Text | ParameterHandler::KeepDeclarationOrder);
      label.parameters = parameters.str();
      return label;
    }



    /** Where a run writes, and what it leaves there if it fails early. */
    struct RunFolder
    {
      RunFolder(const RunOptions &options, const MPI_Comm &communicator)
        : options(options)
        , communicator(communicator)
      {}

      /** Remove what an earlier run left, unless this one goes on with it. */
      void
      prepare()
      {
        if (options.saved)
          directory.emplace(options.output_directory, communicator);
        else if (options.write_output)
          directory.emplace(options.output_directory,
                            options.overwrite,
                            communicator);
      }

      void
      keep_input(const InputFile        &input,
                 const ParameterHandler &parameters,
                 Console                &console) const
      {
        if (!directory || options.saved)
          return;
        directory->write_parameter_files(input.text(), parameters);
        on_root(communicator,
                [&]() { console.open_log(directory->file("log.txt")); });
      }

      /** Before the first step; ends the program if not all ranks fail. */
      void
      leave_failure(const ExitCode     code,
                    const std::string &what,
                    const unsigned int dim)
      {
        end_if_alone(code, what);
        if (options.saved)
          return;
        try
          {
            if (!directory && options.write_output && options.overwrite &&
                OutputDirectory::holds_results(options.output_directory,
                                               communicator))
              prepare();
            if (!directory)
              return;
            Summary summary;
            summary.status          = "failed";
            summary.message         = what;
            summary.version         = version;
            summary.sizes.dimension = dim;
            summary.sizes.ranks = Utilities::MPI::n_mpi_processes(communicator);
            summary.write(directory->file("summary.json"), communicator);
          }
        catch (const InputError &)
          {
            // The first error is the one to report.
          }
      }

      const RunOptions               options;
      const MPI_Comm                 communicator;
      std::optional<OutputDirectory> directory;
    };



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
              const RunTimes                        &times,
              Checkpoints<dim>                      *checkpoints)
    {
      const auto in_stage = [&](const std::string &what) {
        const std::string &name  = scene.stages[driver.time().stage()].first;
        const std::string  stage = "stage '" + name + "'";
        const bool         says_so =
          name.empty() || what.find(stage) != std::string::npos;
        return says_so ? what : stage + ": " + what;
      };
      const auto fail = [&](const ExitCode code, const std::string &what) {
        end_if_alone(code, what);
        driver.undo();
        Summary summary = make_summary(scene, model, driver, times);
        summary.status  = "failed";
        summary.message = what;
        for (RunObserver<dim> *observer : observers)
          observer->run_fails(summary);
      };
      std::string status         = "ok", message;
      bool        no_equilibrium = false;
      try
        {
          const auto after_step = [&]() {
            if (checkpoints)
              checkpoints->after_step(driver);
          };
          if (!with_memory([&]() { return driver.run(after_step); }))
            {
              status  = "interrupted";
              message = "stopped by the user after the last accepted step";
              if (checkpoints && checkpoints->write(driver))
                message += "; 'moraine resume' goes on from there";
            }
        }
      catch (const InputError &error)
        {
          const InputError with_place(located(input, error));
          fail(wrong_input, with_place.what());
          throw with_place;
        }
      catch (const ComputationError &error)
        {
          status  = "not converged";
          message = in_stage(error.what());
          end_if_alone(not_converged, message);
          driver.undo();
          no_equilibrium = dynamic_cast<const NoEquilibrium *>(&error);
          if (checkpoints && checkpoints->are_asked_for() &&
              driver.can_go_on() && checkpoints->write(driver))
            message +=
              " ('moraine resume' goes on from the last accepted step)";
        }
      catch (const std::exception &error)
        {
          fail(internal_error, in_stage(error.what()));
          throw;
        }
      Summary summary        = make_summary(scene, model, driver, times);
      summary.status         = status;
      summary.message        = message;
      summary.no_equilibrium = no_equilibrium;
      if (summary.steps > 0)
        driver.ask_at_end(summary.quality.stress_error);
      for (const Finding &finding : driver.findings())
        (diagnostic(finding.id, "").severity == Severity::warning ?
           summary.found.warnings :
           summary.found.hints)
          .push_back(finding);
      for (RunObserver<dim> *observer : observers)
        observer->run_ends(summary, driver.counts());
      return summary;
    }
  } // namespace



  template <int dim>
  Summary
  simulate(const InputFile     &input,
           const RunOptions    &options,
           const MPI_Comm      &communicator,
           Console             &console,
           const AfterRun<dim> &after_run)
  {
    RunTimes                            times;
    RunFolder                           folder(options, communicator);
    std::unique_ptr<Scene<dim>>         scene;
    std::unique_ptr<Model<dim>>         model;
    std::optional<Diagnostics<dim>>     diagnostics;
    std::unique_ptr<ConsoleReport<dim>> report;
    std::optional<ResultFiles<dim>>     files;
    std::unique_ptr<StepDriver<dim>>    driver;
    std::vector<RunObserver<dim> *>     observers;
    CheckpointLabel                     label;
    std::string                         of_program;
    try
      {
        with_memory([&]() {
          scene = std::make_unique<Scene<dim>>(input);
          label = label_of(input, *scene, options, communicator);
          if (options.saved)
            of_program =
              check_changes(*options.saved, *scene, input, label.parameters);
          folder.prepare();
          folder.keep_input(input, scene->parameters(), console);
          model =
            std::make_unique<Model<dim>>(*scene, communicator, times.parts);
          report = std::make_unique<ConsoleReport<dim>>(*scene,
                                                        *model,
                                                        options,
                                                        console);
          diagnostics.emplace(model->objects(*scene));
          diagnostics->listener = [&](const Finding &finding) {
            report->finding(finding);
          };
          if (options.saved)
            report->introduce();
          else
            {
              begin_first_step(*scene, *model, *diagnostics);
              report->describe();
            }
          std::set<std::string> made;
          for (const auto &material : model->materials)
            if (const std::string how = material->how_made();
                !how.empty() && made.insert(how).second)
              report->note("compiled: " + how);
          if (folder.directory)
            observers.push_back(
              &files.emplace(*scene, *model, *folder.directory, times.parts));
          observers.push_back(report.get());
          driver = std::make_unique<StepDriver<dim>>(*scene,
                                                     *model,
                                                     *diagnostics,
                                                     observers);
          if (options.saved)
            {
              driver->read(options.saved->state);
              options.saved->state = Archive();
              folder.directory->write_parameters(scene->parameters());
              if (!of_program.empty())
                report->note(of_program);
            }
        });
      }
    catch (const InputError &error)
      {
        const InputError with_place(located(input, error));
        folder.leave_failure(wrong_input, with_place.what(), dim);
        throw with_place;
      }
    catch (const ComputationError &error)
      {
        folder.leave_failure(not_converged, error.what(), dim);
        throw;
      }
    catch (const std::exception &error)
      {
        folder.leave_failure(internal_error, error.what(), dim);
        throw;
      }

    std::optional<Checkpoints<dim>> checkpoints;
    if (folder.directory)
      checkpoints.emplace(CheckpointTimes::from_text(
                            scene->output.times.checkpoint_every),
                          options.output_directory,
                          label,
                          *model,
                          *report,
                          times.parts);
    if (options.saved)
      checkpoints->go_on(*options.saved);
    const Summary summary = run_steps(*scene,
                                      input,
                                      *model,
                                      *driver,
                                      observers,
                                      times,
                                      checkpoints ? &*checkpoints : nullptr);
    on_root(communicator, [&]() { console.close_log(); });
    if (after_run && summary.status == "ok")
      after_run(*model);
    return summary;
  }



  template <int dim>
  bool
  describe(const InputFile &input,
           const MPI_Comm  &communicator,
           Console         &console)
  {
    RunTimes           times;
    const Scene<dim>   scene(input);
    Model<dim>         model(scene, communicator, times.parts);
    RunOptions         options;
    ConsoleReport<dim> report(scene, model, options, console);
    Diagnostics<dim>   diagnostics(model.objects(scene));
    begin_first_step(scene, model, diagnostics);
    report.describe();
    for (const Finding &finding : diagnostics.ledger.findings())
      report.print(finding);
    std::set<std::string> faults; // each once, not for all bodies of a material
    for (unsigned int b = 0; b < model.materials.size(); ++b)
      if (!model.materials[b]->is_isotropic())
        for (const std::string &fault : faults_of(model.materials[b]))
          if (faults.insert(fault).second)
            console << "  law of body '" << model.body_names[b]
                    << "': " << fault << '\n';
    if (scene.stages.size() > 1)
      console << "  later stages are checked as they begin\n";
    return !diagnostics.ledger.findings().empty() || !faults.empty();
  }



#define INSTANTIATE(dim)                          \
  template decltype(simulate<dim>) simulate<dim>; \
  template decltype(describe<dim>) describe<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
