// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of Simulation that tells what it does, on the console and in files.

#include <moraine/run/simulation.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/memory.h>
#include <moraine/core/version.h>
#include <moraine/output/domain_vtu.h>
#include <moraine/output/mesh_vtu.h>
#include <moraine/output/point_vtu.h>

#include <deal.II/base/mpi.h>

#include <iomanip>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  Simulation<dim>::describe()
  {
    begin_first_step();
    console << "Moraine " << version << ", " << dim << "D, "
            << Utilities::MPI::n_mpi_processes(communicator)
            << (Utilities::MPI::n_mpi_processes(communicator) == 1 ?
                  " process\n" :
                  " processes\n");
    if (!scene.title.empty())
      console << scene.title << '\n';
    console << "  method      " << scene.method.method << ", Q"
            << scene.method.degree << ", mesh "
            << (state->mesh_after_step() == MeshAfterStep::reset ?
                  "reset after each step" :
                state->mesh_after_step() == MeshAfterStep::keep ?
                  "kept" :
                  "follows the material")
            << '\n'
            << "  mesh        " << mesh->triangulation().n_global_active_cells()
            << " cells, " << space->n_active_cells() << " active, "
            << space->n_dofs() << " unknowns\n"
            << "  points      " << points->n_global() << ", "
            << points->bytes_per_point() << " bytes each";
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        const auto shares =
          Utilities::MPI::min_max_avg(points->n_local(), communicator);
        console << ", " << shares.min << " to " << shares.max
                << " on a process";
      }
    console << '\n';
    for (unsigned int b = 0; b < body_names.size(); ++b)
      console << "  body        " << body_names[b] << ", volume "
              << std::setprecision(8) << body_volumes[b] << '\n';
    const auto n_points = system->n_boundary_points();
    effects.push_back("internal force");
    if (scene.method.empty_stiffness > 0)
      {
        console << "  empty parts of cells have "
                << scene.method.empty_stiffness
                << " of the material's stiffness\n";
        effects.push_back("stiffness of empty parts");
      }
    for (unsigned int b = 0; b < boundaries.size(); ++b)
      {
        const std::string &how =
          scene.boundaries[b].second.enforcement.enforcement;
        console << "  boundary    " << boundaries[b].name() << ", "
                << scene.boundaries[b].second.constraint << ", " << how << ", "
                << n_points[b] << " quadrature points\n";
        effects.push_back("implicit boundary " + boundaries[b].name() + " (" +
                          how + ")");
      }
    const auto n_nodes = system->n_prescribed_nodes();
    for (unsigned int c = 0; c < grid_conditions.size(); ++c)
      {
        console << "  grid        " << grid_conditions[c].name << ", holds "
                << n_nodes[c] << " nodes\n";
        effects.push_back("grid condition " + grid_conditions[c].name);
      }
    for (const std::string &note : notes)
      console << "  note        " << note << '\n';
    for (const auto &[name, load] : scene.loads)
      {
        console << "  load        " << name << ", " << load.type << '\n';
        effects.push_back(load.type + " " + name);
      }
    console << "  steps       " << scene.time.n_steps
            << " from t = " << scene.time.start_time << " to "
            << scene.time.end_time << std::endl;
  }



  template <int dim>
  void
  Simulation<dim>::note_jump(const TimeControl &time)
  {
    ++n_jumps;
    double distance = 0;
    for (const auto &u : state->nodal_increments())
      distance = std::max(distance, u.norm());
    console << "  note: no way on from t = " << time.time()
            << "; came to rest at an equilibrium "
            << Utilities::MPI::max(distance, communicator) << " away"
            << std::endl;
  }



  template <int dim>
  void
  Simulation<dim>::note_domains()
  {
    const auto n_far =
      Utilities::MPI::sum(basis->n_far_domains(), communicator);
    if (n_far > 0 && !has_far_domains)
      console << "  note: " << n_far
              << " domains reach beyond the cells around their point; of more "
                 "cells than that they see only those of their corners"
              << (scene.method.method == "CPDI1" ?
                    " (Method / Split domains = true halves them)" :
                    "")
              << std::endl;
    has_far_domains   = has_far_domains || n_far > 0;
    const auto n_back = Utilities::MPI::sum(points->n_put_back(), communicator);
    if (n_back > n_put_back)
      console << "  note: " << n_back - n_put_back
              << " points that ended outside the mesh were put back onto its "
                 "edge"
              << std::endl;
    n_put_back = n_back;
  }



  template <int dim>
  void
  Simulation<dim>::write_results(const TimeControl &time, const bool due)
  {
    if (!directory)
      return;
    TimerOutput::Scope      scope(timer, "output");
    std::vector<NamedValue> row;
    row.push_back({"t", "-", time.time()});
    for (const auto &report : reports)
      for (unsigned int d = 0; d < dim; ++d)
        row.push_back(
          {std::string("reaction_") + "xyz"[d] + " of " + report.name,
           "force",
           report.reaction[d]});
    for (unsigned int b = 0; b < reports.size(); ++b)
      {
        const RigidMotion<dim> &motion =
          b < boundaries.size() ? boundaries[b].rigid_motion() :
                                  grid_conditions[b - boundaries.size()].motion;
        if (!motion.turns())
          continue;
        row.push_back(
          {"moment of " + reports[b].name, "force length", reports[b].moment});
        row.push_back({"force magnitude of " + reports[b].name,
                       "force",
                       reports[b].force_magnitude});
      }
    for (unsigned int b = 0; b < boundaries.size(); ++b)
      {
        row.push_back(
          {"violation of " + reports[b].name, "length", reports[b].violation});
        row.push_back({"penetration of " + reports[b].name,
                       "length",
                       reports[b].penetration});
      }
    for (const auto &value : probes->values(*points))
      row.push_back(value);
    history->add_row(row);
    if (due)
      write_vtu(time.time());
  }



  template <int dim>
  void
  Simulation<dim>::write_vtu(const double t)
  {
    write_points(t);
    if (scene.output.mesh)
      {
        const std::string name =
          OutputDirectory::vtu_name("mesh", n_vtu_written);
        write_mesh_vtu<dim>(*space,
                            {{"step_displacement", "length", last_increments}},
                            directory->file(name),
                            t,
                            n_vtu_written);
        mesh_pvd->add(t, name);
      }
    ++n_vtu_written;
  }



  template <int dim>
  void
  Simulation<dim>::write_points(const double t)
  {
    t_written = t;
    if (!scene.output.points)
      return;
    const std::string name = OutputDirectory::vtu_name("points", n_vtu_written);
    write_point_vtu(*points, directory->file(name), t, n_vtu_written);
    points_pvd->add(t, name);
    if (!domains_pvd)
      return;
    const std::string domains =
      OutputDirectory::vtu_name("domains", n_vtu_written);
    write_domain_vtu(
      *basis, *points, directory->file(domains), t, n_vtu_written);
    domains_pvd->add(t, domains);
  }



  template <int dim>
  void
  Simulation<dim>::print_step(const TimeControl  &time,
                              const NewtonReport &report)
  {
    std::ostringstream line;
    line << "  step " << std::setw(4) << time.n_accepted()
         << "  t = " << std::setw(10) << std::left << std::setprecision(6)
         << time.time() << std::right << "  iterations " << report.iterations;
    if (report.linear_iterations > 0)
      line << " (linear " << report.linear_iterations << ")";
    line << "  residual " << std::scientific << std::setprecision(1)
         << (report.residuals.empty() ? 0. : report.residuals.back());
    if (report.observed_order > 0)
      line << "  order " << std::fixed << std::setprecision(2)
           << report.observed_order;
    if (scene.output.residuals)
      {
        line << std::scientific << std::setprecision(2) << "\n      residuals";
        for (const double residual : report.residuals)
          line << ' ' << residual;
      }
    console << line.str() << std::endl;
  }



  template <int dim>
  Summary
  Simulation<dim>::make_summary(const TimeControl &time)
  {
    Summary summary;
    summary.version           = version;
    summary.dimension         = dim;
    summary.ranks             = Utilities::MPI::n_mpi_processes(communicator);
    summary.cells             = mesh->triangulation().n_global_active_cells();
    summary.active_cells      = space->n_active_cells();
    summary.unknowns          = space->n_dofs();
    summary.points            = points->n_global();
    summary.steps             = time.n_accepted();
    summary.rejected_steps    = time.n_rejected();
    summary.jumps             = n_jumps;
    summary.newton_iterations = newton_iterations;
    summary.linear_iterations = linear_iterations;
    summary.condition_number  = condition_number;
    summary.bytes_per_point   = points->bytes_per_point();
    summary.peak_memory_mib   = memory_in_use(communicator).peak_mib;
    summary.wall_seconds      = wall_time.wall_time();
    summary.effects           = effects;
    for (const auto &[name, seconds] :
         timer.get_summary_data(TimerOutput::total_wall_time))
      summary.timings.emplace_back(name, seconds);
    summary.timings.emplace_back("solver set up",
                                 linear_solver->set_up_seconds());
    summary.timings.emplace_back("solve", linear_solver->solve_seconds());
    if (condition_number)
      summary.timings.emplace_back("condition number",
                                   linear_solver->condition_seconds());
    const ExactSolution<dim> exact = scene.exact.solution();
    if (exact.displacement || exact.stress)
      summary.errors =
        error_norms(*points,
                    exact,
                    time.time(),
                    state->mesh_after_step() != MeshAfterStep::keep);
    for (const auto &value : probes->values(*points))
      summary.probes.emplace_back(value.name, value.value);
    for (const auto &report : reports)
      {
        std::vector<double> reaction(dim);
        for (unsigned int d = 0; d < dim; ++d)
          reaction[d] = report.reaction[d];
        summary.reactions.emplace_back(report.name, reaction);
      }
    return summary;
  }



  template <int dim>
  void
  Simulation<dim>::keep_summary_of_failure(const TimeControl &time,
                                           const std::string &what)
  {
    if (!directory)
      return;
    try
      {
        Summary summary = make_summary(time);
        summary.status  = "failed";
        summary.message = what;
        summary.write(directory->file("summary.json"), communicator);
      }
    catch (const InputError &)
      {
        // The first error is the one to report.
      }
  }



  template <int dim>
  void
  Simulation<dim>::print_closing(const Summary &summary)
  {
    console << '\n' << "  part                       seconds   share\n";
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
    console << "  " << std::left << std::setw(24) << "whole run" << std::right
            << std::setprecision(3) << std::setw(10) << summary.wall_seconds
            << std::defaultfloat << "\n";
    if (!summary.errors.empty())
      {
        console << "\n  error against the exact solution\n";
        for (const auto &[name, value] : summary.errors)
          {
            console << "  " << std::left << std::setw(24) << name << std::right;
            if (value)
              console << std::scientific << std::setprecision(3)
                      << std::setw(12) << *value << std::defaultfloat << '\n';
            else
              console << "   (exact value is zero)\n";
          }
      }
    console << "\n  " << summary.steps << " steps, " << summary.rejected_steps
            << " rejected, "
            << (n_jumps > 0 ? std::to_string(n_jumps) + " jumps, " : "")
            << summary.newton_iterations << " Newton iterations, "
            << (solver_name.empty() ? "" : solver_name + ", ")
            << std::setprecision(4) << summary.peak_memory_mib
            << " MiB at most\n";
    if (summary.status != "ok")
      console << "  ended early: " << summary.message << '\n';
    console << "" << std::flush;
  }



#define INSTANTIATE(dim)                                                          \
  template void    Simulation<dim>::note_jump(const TimeControl &);               \
  template void    Simulation<dim>::describe();                                   \
  template void    Simulation<dim>::note_domains();                               \
  template void    Simulation<dim>::write_results(const TimeControl &,            \
                                               const bool);                    \
  template void    Simulation<dim>::write_vtu(const double);                      \
  template void    Simulation<dim>::write_points(const double);                   \
  template void    Simulation<dim>::print_step(const TimeControl &,               \
                                            const NewtonReport &);             \
  template Summary Simulation<dim>::make_summary(const TimeControl &);            \
  template void    Simulation<dim>::keep_summary_of_failure(const TimeControl &,  \
                                                         const std::string &); \
  template void    Simulation<dim>::print_closing(const Summary &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
