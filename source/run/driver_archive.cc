// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of StepDriver that goes on from an archive.

#include <moraine/run/step_driver.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    void
    write_counts(const RunCounts &counts, Archive &archive)
    {
      archive.write("run/newton_iterations", counts.newton_iterations);
      archive.write("run/linear_iterations", counts.linear_iterations);
      archive.write("run/pseudo_transient", counts.n_pseudo_transient);
      std::vector<double> condition;
      if (counts.condition_number)
        condition.push_back(*counts.condition_number);
      archive.write("run/condition_number", condition);
      archive.write_text("run/linear_solver", counts.linear_solver);
      archive.write("run/tried_stiffness_of_empty_parts",
                    counts.n_fictitious_stiffness);
      if (counts.ghost_term)
        archive.write("run/largest_shares_of_ghost_term",
                      std::vector<double>{counts.ghost_term->of_forces,
                                          counts.ghost_term->of_work});
    }



    RunCounts
    read_counts(const Archive &archive)
    {
      RunCounts counts;
      counts.newton_iterations  = archive.integer("run/newton_iterations");
      counts.linear_iterations  = archive.integer("run/linear_iterations");
      counts.n_pseudo_transient = archive.integer("run/pseudo_transient");
      const auto &condition     = archive.numbers("run/condition_number");
      if (!condition.empty())
        counts.condition_number = condition[0];
      counts.linear_solver = archive.text("run/linear_solver");
      counts.n_fictitious_stiffness =
        archive.integer("run/tried_stiffness_of_empty_parts");
      const std::string ghost_shares = "run/largest_shares_of_ghost_term";
      if (archive.contains(ghost_shares))
        {
          const auto &shares = archive.numbers(ghost_shares);
          counts.ghost_term  = {shares[0], shares[1]};
        }
      return counts;
    }



    template <int dim>
    void
    write_reports(const std::vector<BoundaryReport<dim>> &reports,
                  Archive                                &archive)
    {
      std::vector<std::string> names;
      std::vector<double>      reactions, lengths, moments, forces;
      for (const auto &report : reports)
        {
          names.push_back(report.name);
          reactions.insert(reactions.end(),
                           report.reaction.begin_raw(),
                           report.reaction.end_raw());
          lengths.insert(lengths.end(), {report.violation, report.penetration});
          moments.push_back(report.moment);
          forces.push_back(report.force_magnitude);
        }
      archive.write_lines("reports/name", names);
      archive.write("reports/reaction", reactions, dim, "force");
      archive.write("reports/violation_and_penetration", lengths, 2, "length");
      archive.write("reports/moment", moments, 1, "force length");
      archive.write("reports/force_magnitude", forces, 1, "force");
    }



    template <int dim>
    std::vector<BoundaryReport<dim>>
    read_reports(const Archive &archive)
    {
      const auto &reactions = archive.numbers("reports/reaction", dim);
      const auto &lengths =
        archive.numbers("reports/violation_and_penetration", 2);
      const auto &moments = archive.numbers("reports/moment");
      const auto &forces  = archive.numbers("reports/force_magnitude");
      std::vector<BoundaryReport<dim>> reports;
      for (const std::string &name : archive.lines("reports/name"))
        {
          const unsigned int k = reports.size();
          Tensor<1, dim>     reaction;
          std::copy_n(reactions.begin() + dim * k, dim, reaction.begin_raw());
          reports.push_back({name,
                             reaction,
                             lengths[2 * k],
                             lengths[2 * k + 1],
                             moments[k],
                             forces[k]});
        }
      return reports;
    }
  } // namespace



  template <int dim>
  void
  StepDriver<dim>::write_progress(Archive &archive) const
  {
    archive.write("run/stage", stage);
    archive.write("run/empty_parts_have_stiffness", support ? 1u : 0u);
    archive.write("run/stiffness_of_empty_parts", accepted_fraction);
    write_counts(sums, archive);
    write_reports(last_reports, archive);
    archive.write("run/motion_of_last_step",
                  std::vector<double>{motion.of_nodes, motion.of_points},
                  2,
                  "length");
    diagnostics.ledger.write(archive);
    model.linear_solver->write(archive);
  }



  template <int dim>
  void
  StepDriver<dim>::find_stencils(const Archive &archive)
  {
    model.points->read(archive);
    model.state->points_changed();
    model.state->begin_step();
  }



  template <int dim>
  void
  StepDriver<dim>::read(const Archive &archive)
  {
    first_step = false;
    stage      = archive.integer("run/stage");
    if (stage > 0)
      model.set_stage(scene, stage);
    // Where no step finds stencils anew, they are of the points in the order in
    // which these were kept, and nodes that move are there before their moves.
    if (model.state->mesh_after_step() != MeshAfterStep::reset)
      find_stencils(archive);
    lasting.read(archive);
    accepted_fraction = archive.number("run/stiffness_of_empty_parts");
    if (archive.integer("run/empty_parts_have_stiffness") != 0)
      {
        auto term =
          std::make_unique<FictitiousStiffness<dim>>(accepted_fraction);
        support = term.get();
        model.system->add(std::move(term));
      }
    if (fading.acts_at(time_control.time()))
      add_fading_forces();
    sums                = read_counts(archive);
    last_reports        = read_reports<dim>(archive);
    const auto &motions = archive.numbers("run/motion_of_last_step", 2);
    motion.of_nodes     = motions[0];
    motion.of_points    = motions[1];
    diagnostics.ledger.read(archive);
    model.linear_solver->read(archive);
  }



#define INSTANTIATE(dim)                                          \
  template void StepDriver<dim>::write_progress(Archive &) const; \
  template void StepDriver<dim>::find_stencils(const Archive &);  \
  template void StepDriver<dim>::read(const Archive &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
