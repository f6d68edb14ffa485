// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/console_report.h>

#include <moraine/core/version.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/catalogue.h>
#include <moraine/output/on_root.h>
#include <moraine/run/resume.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    std::string
    words_for(const MeshAfterStep after_step)
    {
      switch (after_step)
        {
          case MeshAfterStep::reset:
            return "reset after each step";
          case MeshAfterStep::keep:
            return "kept";
          default:
            return "follows the material";
        }
    }



    template <int dim>
    void
    print_step(const AcceptedStep<dim> &step,
               const bool               residuals,
               std::ostream            &out)
    {
      std::ostringstream line;
      line << "  step " << std::setw(4) << step.time.n_accepted()
           << "  t = " << std::setw(10) << std::left << std::setprecision(6)
           << step.time.time() << std::right << "  iterations "
           << step.newton.iterations;
      if (step.newton.linear_iterations > 0)
        line << " (linear " << step.newton.linear_iterations << ")";
      line << "  residual " << std::scientific << std::setprecision(1)
           << (step.newton.residuals.empty() ? 0. :
                                               step.newton.residuals.back());
      if (step.newton.observed_order > 0)
        line << "  order " << std::fixed << std::setprecision(2)
             << step.newton.observed_order;
      if (!step.newton.message.empty())
        line << "\n      " << step.newton.message;
      if (residuals)
        {
          line << std::scientific << std::setprecision(2)
               << "\n      residuals";
          for (const double residual : step.newton.residuals)
            line << ' ' << residual;
        }
      out << line.str() << std::endl;
    }
  } // namespace



  template <int dim>
  ConsoleReport<dim>::ConsoleReport(const Scene<dim> &scene,
                                    const Model<dim> &model,
                                    const RunOptions &options,
                                    Console          &console)
    : scene(scene)
    , model(model)
    , options(options)
    , console(console)
    , begun(scene.start_time())
  {}



  template <int dim>
  void
  ConsoleReport<dim>::introduce()
  {
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(model.space->communicator());
    console << "Moraine " << version << ", " << dim << "D, " << n_ranks
            << (n_ranks == 1 ? " process\n" : " processes\n");
    if (!scene.title.empty())
      console << scene.title << '\n';
  }



  template <int dim>
  void
  ConsoleReport<dim>::describe()
  {
    introduce();
    describe_method();
    describe_bodies();
    describe_conditions();
    for (unsigned int k = 0; k < scene.stages.size(); ++k)
      describe_stage(k);
    console << "" << std::flush;
  }



  template <int dim>
  void
  ConsoleReport<dim>::describe_stage(const unsigned int k)
  {
    const auto &[name, stage]  = scene.stages[k];
    const TimeParameters &time = stage.time;
    console << (name.empty() ? "  steps       " :
                               "  stage       " + name + ", ")
            << std::defaultfloat << time.n_steps
            << (name.empty()      ? "" :
                time.n_steps == 1 ? " step" :
                                    " steps")
            << " from t = " << time.start_time << " to " << time.end_time;
    if (time.follows_path())
      console << ", along the path by " << time.arc_length << " each";
    if (time.integrator.dynamic())
      console << ", " << time.integrator.integrator << ", Courant number "
              << std::setprecision(3) << courant_number(time)
              << std::setprecision(8);
    if (k > 0)
      console << change_of_bodies(stage, scene.stages[k - 1].second);
    if (!stage.absorbing.empty())
      console << ", absorbing " << list_of(stage.absorbing);
    console << '\n';
    if (name.empty())
      return;
    std::string acting;
    const auto  add = [&](const std::string              &kind,
                         const bool                      there_are,
                         const std::vector<std::string> &names) {
      if (there_are)
        acting += (acting.empty() ? "" : "; ") + kind + ": " +
                  (names.empty() ? "none" : list_of(names));
    };
    add("bodies", true, stage.bodies);
    add("boundaries", !scene.boundaries.empty(), stage.boundaries);
    add("grid conditions",
        !scene.grid_conditions.empty(),
        stage.grid_conditions);
    add("loads", !scene.loads.empty(), stage.loads);
    console << "              " << acting << '\n';
  }



  template <int dim>
  double
  ConsoleReport<dim>::courant_number(const TimeParameters &time) const
  {
    double speed = 0;
    for (const auto &material : model.materials)
      {
        const LameConstants C = material->elastic_stiffness();
        speed =
          std::max(speed,
                   std::sqrt((C.lambda + 2 * C.mu) / material->density()));
      }
    const double size =
      time.largest_step * (time.end_time - time.start_time) / time.n_steps;
    return speed * size / model.mesh->cell_size();
  }



  template <int dim>
  void
  ConsoleReport<dim>::describe_method()
  {
    console << "  method      " << scene.method.method << ", Q"
            << scene.method.degree << ", mesh "
            << words_for(model.state->mesh_after_step())
            << (scene.method.volumetric() == VolumetricStrain::cell_mean ?
                  ", volumetric strain: cell means" :
                  "")
            << '\n'
            << "  mesh        "
            << model.mesh->triangulation().n_global_active_cells() << " cells, "
            << model.space->n_active_cells() << " active, "
            << model.space->n_dofs() << " unknowns\n";
  }



  template <int dim>
  void
  ConsoleReport<dim>::describe_bodies()
  {
    const MPI_Comm communicator = model.space->communicator();
    console << "  points      " << model.points->n_global() << ", "
            << model.points->bytes_per_point() << " bytes each";
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        const auto shares =
          Utilities::MPI::min_max_avg(model.points->n_local(), communicator);
        console << ", " << shares.min << " to " << shares.max
                << " on a process";
      }
    console << '\n';
    for (unsigned int b = 0; b < model.body_names.size(); ++b)
      console << "  body        " << model.body_names[b] << ", volume "
              << std::setprecision(8) << model.body_volumes[b] << '\n';
  }



  template <int dim>
  void
  ConsoleReport<dim>::describe_conditions()
  {
    for (const Effect &effect : model.system->effects())
      if (!effect.kind.empty())
        console << "  " << std::setw(12) << std::left << effect.kind
                << std::right << effect.text << '\n';
  }



  template <int dim>
  void
  ConsoleReport<dim>::run_begins()
  {
    if (options.write_output)
      console << "  results in  " << options.output_directory << '\n'
              << std::endl;
    since_start.restart();
  }



  template <int dim>
  void
  ConsoleReport<dim>::run_resumes(const TimeControl &time)
  {
    begun = time.coordinate();
    std::ostringstream text;
    text << "goes on after step " << time.n_accepted()
         << ", t = " << std::setprecision(6) << time.time() << ", on "
         << Utilities::MPI::n_mpi_processes(model.space->communicator())
         << " process(es)";
    note(text.str());
    since_start.restart();
  }



  template <int dim>
  void
  ConsoleReport<dim>::write(Archive &archive) const
  {
    const unsigned int size =
      Utilities::MPI::broadcast(model.space->communicator(),
                                static_cast<unsigned int>(console.log_size()));
    archive.write("console/bytes_of_log", size);
  }



  template <int dim>
  void
  ConsoleReport<dim>::read(const Archive &archive)
  {
    on_root(model.space->communicator(), [&]() {
      console.continue_log(
        (std::filesystem::path(options.output_directory) / "log.txt").string(),
        archive.integer("console/bytes_of_log"));
    });
  }



  template <int dim>
  void
  ConsoleReport<dim>::step_accepted(const AcceptedStep<dim> &step)
  {
    if (step.pseudo_transient)
      {
        std::ostringstream text;
        text << std::setprecision(8) << "no way on from t = " << step.t_start
             << "; came to rest at an equilibrium " << *step.pseudo_transient
             << " away";
        in_detail([&]() { note(text.str()); });
      }
    print_step(step, scene.output.residuals, console.stream());
    in_detail([this]() {
      for (const std::string &text : model.probes->news())
        note(text);
    });
  }



  template <int dim>
  void
  ConsoleReport<dim>::newton_iteration(const NewtonIteration &iteration,
                                       const TimeControl     &time)
  {
    std::ostringstream line;
    line << std::scientific << std::setprecision(1);
    if (options.verbosity == Verbosity::verbose)
      {
        line << "      iteration " << iteration.number << "  residual "
             << iteration.residual;
        if (iteration.linear_iterations > 0)
          line << "  linear " << iteration.linear_iterations;
        if (iteration.length < 1)
          line << "  length " << std::defaultfloat << iteration.length;
        console << line.str() << std::endl;
        return;
      }
    line << "  step " << time.n_accepted() + 1 << "  t = " << std::defaultfloat
         << std::setprecision(6) << time.trial_time() << "  iteration "
         << iteration.number << "  residual " << std::scientific
         << std::setprecision(1) << iteration.residual << time_left(time);
    console.progress(line.str());
  }



  template <int dim>
  std::string
  ConsoleReport<dim>::time_left(const TimeControl &time) const
  {
    const double done =
      (time.coordinate() - begun) / (time.last_coordinate() - begun);
    if (!(done > 0))
      return "";
    const double       seconds = since_start.wall_time() * (1 - done) / done;
    std::ostringstream text;
    text << "  about " << std::fixed << std::setprecision(0);
    if (seconds < 100)
      text << seconds << " s";
    else if (seconds < 6000)
      text << seconds / 60 << " min";
    else
      text << seconds / 3600 << " h";
    return text.str() + " left";
  }



  template <int dim>
  void
  ConsoleReport<dim>::step_rejected(const double t, const std::string &reason)
  {
    console << "  step to t = " << t << " rejected: " << reason << std::endl;
  }



  template <int dim>
  void
  ConsoleReport<dim>::note(const std::string &text)
  {
    console << "  note: " << text << std::endl;
  }



  template <int dim>
  void
  ConsoleReport<dim>::in_detail(const std::function<void()> &print)
  {
    if (options.verbosity != Verbosity::verbose)
      console.set_quiet(true);
    print();
    console.set_quiet(options.verbosity == Verbosity::quiet);
  }



  template <int dim>
  void
  ConsoleReport<dim>::print(const Finding &finding)
  {
    console << "  " << std::setw(12) << std::left
            << (diagnostic(finding.id, "").severity == Severity::warning ?
                  "warning" :
                  "hint")
            << std::right << finding.id
            << (finding.object.empty() ? "" : " (" + finding.object + ")")
            << ": " << finding.text << '\n';
  }



  template <int dim>
  void
  ConsoleReport<dim>::finding(const Finding &finding)
  {
    in_detail([&]() { print(finding); });
  }



  template <int dim>
  void
  ConsoleReport<dim>::run_ends(const Summary &summary, const RunCounts &counts)
  {
    in_detail([&]() {
      print_timings(summary);
      print_counts(summary, counts);
      if (!summary.energy.empty())
        print_energy(summary);
    });
    print_results(summary);
    if (!summary.errors.empty())
      print_errors(summary);
    console.set_quiet(false);
    print_warnings(summary);
  }



  template <int dim>
  void
  ConsoleReport<dim>::print_counts(const Summary   &summary,
                                   const RunCounts &counts)
  {
    console << "\n  " << summary.rejected_steps << " rejected steps, "
            << (summary.n_pseudo_transient > 0 ?
                  std::to_string(summary.n_pseudo_transient) +
                    " pseudo-transient, " :
                  "")
            << summary.newton_iterations << " Newton iterations, "
            << (counts.linear_solver.empty() ? "" : counts.linear_solver + ", ")
            << std::setprecision(4) << summary.sizes.peak_memory_mib
            << " MiB at most\n";
    if (summary.quality.ghost_term)
      console << "  ghost term: at most " << std::setprecision(2)
              << 100 * summary.quality.ghost_term->of_forces
              << " % of the forces and "
              << 100 * summary.quality.ghost_term->of_work
              << " % of the work of a step\n";
  }



  template <int dim>
  void
  ConsoleReport<dim>::print_results(const Summary &summary)
  {
    const auto line = [this](const std::string &what) -> std::ostream & {
      return console << "  " << std::setw(24) << std::left << what
                     << std::right << std::setprecision(5);
    };
    console << "\n  results at t = " << std::setprecision(6) << summary.time
            << '\n';
    for (const auto &[name, force] : summary.last.reactions)
      {
        line("force of " + name);
        for (const double component : force)
          console << ' ' << std::setw(12) << component;
        console << '\n';
      }
    for (const auto &[name, value] : summary.last.probes)
      line(name) << ' ' << std::setw(12) << value << '\n';
    line("largest displacement")
      << ' ' << std::setw(12) << summary.quality.largest_displacement << '\n';
    if (summary.quality.plastic_share)
      line("plastic share of bodies")
        << ' ' << std::setw(12) << per_cent(*summary.quality.plastic_share)
        << '\n';
    if (summary.quality.stress_error)
      line("error of stress")
        << ' ' << std::setw(12) << per_cent(*summary.quality.stress_error)
        << " (estimate, energy norm)\n";
  }



  template <int dim>
  void
  ConsoleReport<dim>::print_warnings(const Summary &summary)
  {
    for (const Finding &finding : summary.found.warnings)
      print(finding);
    if (summary.status != "ok")
      console << "  ended early: " << summary.message << '\n';
    console << "  " << (summary.status == "ok" ? "done: " : "")
            << summary.steps << (summary.steps == 1 ? " step" : " steps")
            << " in " << std::setprecision(3) << summary.wall_seconds << " s";
    if (!summary.found.warnings.empty())
      {
        console << ", " << summary.found.warnings.size()
                << (summary.found.warnings.size() == 1 ? " warning: " :
                                                   " warnings: ");
        std::vector<std::string> names;
        for (const Finding &finding : summary.found.warnings)
          names.push_back(finding.id + (finding.object.empty() ?
                                          "" :
                                          " (" + finding.object + ")"));
        console << list_of(names) << "; see 'moraine explain ID'";
      }
    console.stream() << std::endl;
  }



  template <int dim>
  void
  ConsoleReport<dim>::print_timings(const Summary &summary)
  {
    // The clock of a run that goes on begins anew.
    const std::string since =
      options.saved ?
        "since step " + std::to_string(options.saved->label.step) :
        "";
    console << "\n  " << std::left << std::setw(24)
            << (since.empty() ? "part" : "part, " + since) << std::right
            << std::setw(10) << "seconds" << std::setw(8) << "share" << '\n';
    double rest = summary.wall_seconds;
    for (const auto &[name, seconds] : summary.timings)
      rest -= seconds;
    auto parts = summary.timings;
    parts.emplace_back("not covered", rest);
    for (const auto &[name, seconds] : parts)
      console << "  " << std::left << std::setw(24) << name << std::right
              << std::fixed << std::setprecision(3) << std::setw(10) << seconds
              << std::setprecision(1) << std::setw(7)
              << 100 * seconds / std::max(summary.wall_seconds, 1e-12)
              << " %\n";
    console << "  " << std::left << std::setw(24)
            << (since.empty() ? "whole run" : "all " + since) << std::right
            << std::setprecision(3) << std::setw(10) << summary.wall_seconds
            << std::defaultfloat << "\n";
  }



  template <int dim>
  void
  ConsoleReport<dim>::print_errors(const Summary &summary)
  {
    console << "\n  error against the exact solution\n";
    for (const auto &[name, value] : summary.errors)
      {
        console << "  " << std::left << std::setw(24) << name << std::right;
        if (value)
          console << std::scientific << std::setprecision(3) << std::setw(12)
                  << *value << std::defaultfloat << '\n';
        else
          console << "   (exact value is zero)\n";
      }
  }



  template <int dim>
  void
  ConsoleReport<dim>::print_energy(const Summary &summary)
  {
    console << "\n  energy at the end      force length\n"
            << std::setprecision(4);
    for (const auto &[name, value] : summary.energy)
      {
        std::string words = name;
        std::replace(words.begin(), words.end(), '_', ' ');
        if (name == "balance_error")
          console << "  out of balance by      " << std::setprecision(2)
                  << value << " of the largest\n";
        else
          console << "  " << std::left << std::setw(22) << words << std::right
                  << ' ' << value << '\n';
      }
  }



  template class ConsoleReport<2>;
  template class ConsoleReport<3>;
} // namespace moraine
