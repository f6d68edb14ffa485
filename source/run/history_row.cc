// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/history_row.h>

#include <moraine/assembly/water_term.h>

#include <deal.II/base/mpi.h>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    std::vector<NamedValue>
    values_of(const Works &works)
    {
      const auto work = [&works](const WorkKind kind) {
        return works.of_forces[static_cast<unsigned int>(kind)];
      };
      const std::string unit = "force length";
      return {{"strain energy", unit, works.stored},
              {"plastic dissipation", unit, works.dissipated},
              {"external work", unit, work(WorkKind::external)},
              {"work of boundaries", unit, work(WorkKind::boundaries)},
              {"absorbed energy", unit, -work(WorkKind::absorbed)},
              {"damping energy", unit, -work(WorkKind::damping)},
              {"energy lost in transfer", unit, works.lost_in_transfer},
              {"kinetic energy of nodes", unit, works.kinetic},
              {"numerical damping", unit, works.numerical_damping()},
              {"energy out of balance", unit, works.out_of_balance()}};
    }



    template <int dim>
    std::vector<NamedValue>
    values_of(const MotionSums<dim> &sums)
    {
      std::vector<NamedValue> values;
      for (unsigned int d = 0; d < dim; ++d)
        values.push_back({std::string("momentum_") + "xyz"[d],
                          "mass length/time",
                          sums.momentum[d]});
      for (unsigned int d = 0; d < (dim == 2 ? 1 : 3); ++d)
        values.push_back(
          {std::string("angular_momentum_") + (dim == 2 ? 'z' : "xyz"[d]),
           "mass length^2/time",
           sums.angular_momentum[d]});
      values.push_back({"kinetic energy", "force length", sums.kinetic_energy});
      return values;
    }



    /** Of all bodies that are there. Collective. */
    template <int dim>
    double
    mass_of(const Model<dim> &model)
    {
      double mass = 0;
      for (unsigned int p = 0; p < model.points->n_local(); ++p)
        mass += model.materials[model.points->body(p)]->density() *
                model.state->initial_volume(p);
      return Utilities::MPI::sum(mass, model.space->communicator());
    }



    /** What a condition reports; zeros if it does not act. */
    template <int dim>
    BoundaryReport<dim>
    report_of(const std::string                      &name,
              const std::vector<BoundaryReport<dim>> &reports)
    {
      for (const auto &report : reports)
        if (report.name == name)
          return report;
      return {name, {}, 0., 0., 0., 0.};
    }



    /** Columns of a vector. */
    template <int dim>
    void
    add_vector(const std::string       &before,
               const std::string       &after,
               const std::string       &unit,
               const Tensor<1, dim>    &vector,
               std::vector<NamedValue> &row)
    {
      for (unsigned int d = 0; d < dim; ++d)
        row.push_back({before + "xyz"[d] + after, unit, vector[d]});
    }



    /** Columns of a surface that bodies touch. */
    template <int dim>
    void
    add_contact(const BoundaryReport<dim> &report,
                const bool                 turns,
                std::vector<NamedValue>   &row)
    {
      const ContactReport contact = report.contact.value_or(ContactReport());
      const std::string   of      = " of " + report.name;
      const std::string   area    = dim == 2 ? "length" : "length^2";
      if (turns)
        row.push_back({"moment" + of, "force length", report.moment});
      row.push_back({"contact area" + of, area, contact.area});
      row.push_back({"slipping area" + of, area, contact.slipping_area});
      row.push_back({"penetration" + of, "length", report.penetration});
      row.push_back({"slip" + of, "length", contact.slip});
      row.push_back(
        {"work of friction" + of, "force length", contact.work_of_friction});
    }



    /** Columns of conditions that turn. Those of absorbing boundaries, which do
     * not, follow in @p reports. */
    template <int dim>
    void
    add_moments(const Model<dim>                       &model,
                const std::vector<BoundaryReport<dim>> &reports,
                std::vector<NamedValue>                &row)
    {
      const auto &boundaries = model.boundaries;
      for (unsigned int b = 0;
           b < boundaries.size() + model.grid_conditions.size();
           ++b)
        {
          const RigidMotion<dim> &motion =
            b < boundaries.size() ?
              boundaries[b].rigid_motion() :
              model.grid_conditions[b - boundaries.size()].motion;
          if (!motion.turns())
            continue;
          row.push_back({"moment of " + reports[b].name,
                         "force length",
                         reports[b].moment});
          row.push_back({"force magnitude of " + reports[b].name,
                         "force",
                         reports[b].force_magnitude});
        }
    }
  } // namespace



  template <int dim>
  std::vector<NamedValue>
  history_row(const Scene<dim>                       &scene,
              const Model<dim>                       &model,
              const NamedTranslations<dim>           &translations,
              const TimeControl                      &time,
              const std::vector<BoundaryReport<dim>> &acting)
  {
    std::vector<NamedValue> row;
    const bool              in_seconds =
      scene.is_dynamic() && !scene.output.units.time.empty();
    row.push_back({"t", in_seconds ? "time" : "-", time.time()});
    if (scene.stages.back().second.time.follows_path())
      row.push_back({"path_length", "length", time.path_length()});
    std::vector<BoundaryReport<dim>> reports;
    for (const auto &boundary : model.boundaries)
      reports.push_back(report_of(boundary.name(), acting));
    for (const auto &condition : model.grid_conditions)
      reports.push_back(report_of(condition.name, acting));
    for (const auto &boundary : model.absorbing_boundaries)
      if (!scene.absorbs_later(boundary.name()))
        reports.push_back(report_of(boundary.name(), acting));
    for (const auto &boundary : model.contact_boundaries)
      reports.push_back(report_of(boundary.name(), acting));
    if (scene.changes_bodies())
      row.push_back({"mass", "mass", mass_of(model)});
    for (const auto &report : reports)
      add_vector(
        "reaction_", " of " + report.name, "force", report.reaction, row);
    for (const auto &[name, translation] : translations)
      add_vector("u_", " of " + name, "length", translation(time.time()), row);
    if (model.loads.water)
      add_vector("force_",
                 " of water",
                 "force",
                 force_of_outer_water(*model.loads.water,
                                      time.time(),
                                      *model.state),
                 row);
    add_moments(model, reports, row);
    for (unsigned int b = 0; b < model.boundaries.size(); ++b)
      {
        row.push_back(
          {"violation of " + reports[b].name, "length", reports[b].violation});
        row.push_back({"penetration of " + reports[b].name,
                       "length",
                       reports[b].penetration});
      }
    for (const auto &boundary : model.contact_boundaries)
      add_contact(report_of(boundary.name(), acting),
                  boundary.rigid_motion().turns(),
                  row);
    for (const auto &value : model.probes->values(*model.points))
      row.push_back(value);
    if (model.motion)
      {
        for (const NamedValue &value : values_of(model.motion->sums()))
          row.push_back(value);
        // A stage without inertia counts none.
        const bool counts = model.system->step_context().motion != nullptr;
        for (const NamedValue &value :
             values_of(counts ? model.motion->works() : Works()))
          row.push_back(value);
      }
    return row;
  }



#define INSTANTIATE(dim) template decltype(history_row<dim>) history_row<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
