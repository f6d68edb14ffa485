// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/console_report.h>

#include <moraine/core/version.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/catalogue.h>
#include <moraine/output/on_root.h>
#include <moraine/run/resume.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

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



    std::string
    name_of(const Finding &finding)
    {
      return finding.id +
             (finding.object.empty() ? "" : " (" + finding.object + ")");
    }



    std::string
    line_of(const Finding &finding)
    {
      const bool warns =
        diagnostic(finding.id, "").severity == Severity::warning;
      return fmt::format("  {:12}{}: {}\n",
                         warns ? "warning" : "hint",
                         name_of(finding),
                         finding.text);
    }



    template <int dim>
    std::string
    line_of(const AcceptedStep<dim> &step, const bool residuals)
    {
      const NewtonReport &newton = step.newton;
      std::string         line =
        fmt::format("  step {:4}  t = {:<10.6g}  iterations {}",
                    step.time.n_accepted(),
                    step.time.time(),
                    newton.iterations);
      if (newton.linear_iterations > 0)
        line += fmt::format(" (linear {})", newton.linear_iterations);
      line +=
        fmt::format("  residual {:.1e}",
                    newton.residuals.empty() ? 0. : newton.residuals.back());
      if (newton.observed_order > 0)
        line += fmt::format("  order {:.2f}", newton.observed_order);
      if (!newton.message.empty())
        line += "\n      " + newton.message;
      if (residuals)
        line += fmt::format("\n      residuals {:.2e}",
                            fmt::join(newton.residuals, " "));
      return line;
    }



    void
    print_counts(const Summary   &summary,
                 const RunCounts &counts,
                 Console         &console)
    {
      console << fmt::format(
        "\n  {} rejected steps, {}{} Newton iterations, {}{:.4g} MiB at most\n",
        summary.rejected_steps,
        summary.n_pseudo_transient > 0 ?
          std::to_string(summary.n_pseudo_transient) + " pseudo-transient, " :
          "",
        summary.newton_iterations,
        counts.linear_solver.empty() ? "" : counts.linear_solver + ", ",
        summary.sizes.peak_memory_mib);
      if (const auto &ghost_term = summary.quality.ghost_term)
        console << fmt::format(
          "  ghost term: at most {:.2g} % of the forces and "
          "{:.2g} % of the work of a step\n",
          100 * ghost_term->of_forces,
          100 * ghost_term->of_work);
    }



    void
    print_results(const Summary &summary, Console &console)
    {
      const auto line = [&console](const std::string         &what,
                                   const std::vector<double> &values) {
        console << fmt::format("  {:24} {:12.5g}\n",
                               what,
                               fmt::join(values, " "));
      };
      const auto share = [&console](const std::string           &what,
                                    const std::optional<double> &value,
                                    const std::string           &remark) {
        if (value)
          console << fmt::format("  {:24} {:>12}{}\n",
                                 what,
                                 per_cent(*value),
                                 remark);
      };
      console << fmt::format("\n  results at t = {:.6g}\n", summary.time);
      for (const auto &[name, force] : summary.last.reactions)
        line("force of " + name, force);
      for (const auto &[name, value] : summary.last.probes)
        line(name, {value});
      line("largest displacement", {summary.quality.largest_displacement});
      share("plastic share of bodies", summary.quality.plastic_share, "");
      share("error of stress",
            summary.quality.stress_error,
            " (estimate, energy norm)");
    }



    void
    print_timings(const Summary  &summary,
                  const SavedRun *saved,
                  Console        &console)
    {
      // The clock of a run that goes on begins anew.
      const std::string since =
        saved ? "since step " + std::to_string(saved->label.step) : "";
      console << fmt::format("\n  {:24}{:>10}{:>8}\n",
                             since.empty() ? "part" : "part, " + since,
                             "seconds",
                             "share");
      double rest = summary.wall_seconds;
      for (const auto &[name, seconds] : summary.timings)
        rest -= seconds;
      auto parts = summary.timings;
      parts.emplace_back("not covered", rest);
      for (const auto &[name, seconds] : parts)
        console << fmt::format("  {:24}{:10.3f}{:7.1f} %\n",
                               name,
                               seconds,
                               100 * seconds /
                                 std::max(summary.wall_seconds, 1e-12));
      console << fmt::format("  {:24}{:10.3f}\n",
                             since.empty() ? "whole run" : "all " + since,
                             summary.wall_seconds);
    }



    void
    print_errors(const Summary &summary, Console &console)
    {
      console << "\n  error against the exact solution\n";
      for (const auto &[name, value] : summary.errors)
        console << (value ?
                      fmt::format("  {:24}{:12.3e}\n", name, *value) :
                      fmt::format("  {:24}   (exact value is zero)\n", name));
    }



    void
    print_energy(const Summary &summary, Console &console)
    {
      console << "\n  energy at the end      force length\n";
      for (const auto &[name, value] : summary.energy)
        {
          std::string words = name;
          std::replace(words.begin(), words.end(), '_', ' ');
          console << (name == "balance_error" ?
                        fmt::format("  out of balance by      {:.2g} of the "
                                    "largest\n",
                                    value) :
                        fmt::format("  {:22} {:.4g}\n", words, value));
        }
    }



    void
    print_warnings(const Summary &summary, Console &console)
    {
      for (const Finding &finding : summary.found.warnings)
        console << line_of(finding);
      if (summary.status != "ok")
        console << "  ended early: " << summary.message << '\n';
      const auto count = [](const std::size_t n, const std::string &what) {
        return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
      };
      console << fmt::format("  {}{} in {:.3g} s",
                             summary.status == "ok" ? "done: " : "",
                             count(summary.steps, "step"),
                             summary.wall_seconds);
      std::vector<std::string> names;
      for (const Finding &finding : summary.found.warnings)
        names.push_back(name_of(finding));
      if (!names.empty())
        console << ", " << count(names.size(), "warning") << ": "
                << list_of(names) << "; see 'moraine explain ID'";
      console.stream() << std::endl;
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
    if (!scene.output.title.empty())
      console << scene.output.title << '\n';
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
    console << fmt::format("  {:12}{}{}{} from t = {:.8g} to {:.8g}",
                           name.empty() ? "steps" : "stage",
                           name.empty() ? "" : name + ", ",
                           time.n_steps,
                           name.empty()      ? "" :
                           time.n_steps == 1 ? " step" :
                                               " steps",
                           time.start_time,
                           time.end_time);
    if (time.follows_path())
      console << fmt::format(", along the path by {:.8g} each",
                             time.arc_length);
    if (time.integrator.dynamic())
      console << fmt::format(", {}, Courant number {:.3g}",
                             time.integrator.integrator,
                             courant_number(time));
    if (k > 0)
      console << change_of_bodies(stage, scene.stages[k - 1].second);
    if (!stage.absorbing.empty())
      console << ", absorbing " << list_of(stage.absorbing);
    if (!stage.drained.empty())
      console << ", drained " << list_of(stage.drained);
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
            << (scene.method.averages_volume() ?
                  ", volumetric strain: cell means" :
                  "")
            << (model.state->averages_all_strain() ? " with shear" : "") << '\n'
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
      console << fmt::format("  body        {}, volume {:.8g}\n",
                             model.body_names[b],
                             model.bodies[b].volume);
  }



  template <int dim>
  void
  ConsoleReport<dim>::describe_conditions()
  {
    for (const Effect &effect : model.system->effects())
      if (!effect.kind.empty())
        console << fmt::format("  {:12}{}\n", effect.kind, effect.text);
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
    note(fmt::format("goes on after step {}, t = {:.6g}, on {} process(es)",
                     time.n_accepted(),
                     time.time(),
                     Utilities::MPI::n_mpi_processes(
                       model.space->communicator())));
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
      in_detail([&]() {
        note(fmt::format("no way on from t = {:.8g}; came to rest at an "
                         "equilibrium {:.8g} away",
                         step.t_start,
                         *step.pseudo_transient));
      });
    console << line_of(step, scene.output.residuals) << std::endl;
    in_detail([this]() {
      for (const std::string &text : model.probes->changes())
        note(text);
    });
  }



  template <int dim>
  void
  ConsoleReport<dim>::newton_iteration(const NewtonIteration &iteration,
                                       const TimeControl     &time)
  {
    if (options.verbosity != Verbosity::verbose)
      {
        console.progress(
          fmt::format("  step {}  t = {:.6g}  iteration {}  residual {:.1e}{}",
                      time.n_accepted() + 1,
                      time.trial_time(),
                      iteration.number,
                      iteration.residual,
                      time_left(time)));
        return;
      }
    console << fmt::format("      iteration {}  residual {:.1e}",
                           iteration.number,
                           iteration.residual);
    if (iteration.linear_iterations > 0)
      console << "  linear " << iteration.linear_iterations;
    if (iteration.length < 1)
      console << fmt::format("  length {:.1g}", iteration.length);
    console.stream() << std::endl;
  }



  template <int dim>
  std::string
  ConsoleReport<dim>::time_left(const TimeControl &time) const
  {
    const double done =
      (time.coordinate() - begun) / (time.last_coordinate() - begun);
    if (!(done > 0))
      return "";
    const double seconds = since_start.wall_time() * (1 - done) / done;
    return seconds < 100 ?
             fmt::format("  about {:.0f} s left", seconds) :
           seconds < 6000 ?
             fmt::format("  about {:.0f} min left", seconds / 60) :
             fmt::format("  about {:.0f} h left", seconds / 3600);
  }



  template <int dim>
  void
  ConsoleReport<dim>::step_rejected(const double t, const std::string &reason)
  {
    console << fmt::format("  step to t = {:.8g} rejected: {}", t, reason)
            << std::endl;
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
    console << line_of(finding);
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
      print_timings(summary, options.saved, console);
      print_counts(summary, counts, console);
      if (!summary.energy.empty())
        print_energy(summary, console);
    });
    print_results(summary, console);
    if (!summary.errors.empty())
      print_errors(summary, console);
    console.set_quiet(false);
    print_warnings(summary, console);
  }



  template class ConsoleReport<2>;
  template class ConsoleReport<3>;
} // namespace moraine
