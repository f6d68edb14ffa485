// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/result_files.h>

#include <moraine/core/exceptions.h>
#include <moraine/output/domain_vtu.h>
#include <moraine/output/mesh_vtu.h>
#include <moraine/output/on_root.h>
#include <moraine/output/point_vtu.h>

#include <deal.II/base/mpi.h>

#include <filesystem>

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
  } // namespace



  template <int dim>
  ResultFiles<dim>::ResultFiles(const Scene<dim>      &scene,
                                const Model<dim>      &model,
                                const OutputDirectory &directory,
                                TimerOutput           &timer)
    : scene(scene)
    , model(model)
    , directory(directory)
    , timer(timer)
    , communicator(model.space->communicator())
    , history(directory.file("history.csv"), communicator, scene.units)
    , points_pvd(directory.file("points.pvd"), communicator)
    , mesh_pvd(directory.file("mesh.pvd"), communicator)
    , boundaries_pvd(directory.file("boundaries.pvd"), communicator)
    , translations(translations_of_conditions(scene, model))
    , t_written(scene.start_time())
    , t_accepted(scene.start_time())
  {}



  template <int dim>
  void
  ResultFiles<dim>::prepare_domains()
  {
    if (scene.output.points && model.basis->has_domains())
      {
        on_root(communicator, [this]() {
          std::filesystem::create_directory(directory.file("domains"));
        });
        domains_pvd.emplace(directory.file("domains.pvd"), communicator);
      }
  }



  template <int dim>
  void
  ResultFiles<dim>::run_begins()
  {
    prepare_domains();
    if (scene.output.times.at_start())
      write_vtu(t_written, Increments(model.space->n_nodes()));
  }



  template <int dim>
  void
  ResultFiles<dim>::write(Archive &archive) const
  {
    archive.write("output/n_vtu_written", n_vtu_written);
    archive.write("output/t_written", t_written, "time");
    archive.write("output/t_accepted", t_accepted, "time");
    history.write(archive);
    points_pvd.write(archive);
    mesh_pvd.write(archive);
    if (!model.boundaries.empty())
      boundaries_pvd.write(archive);
    if (domains_pvd)
      domains_pvd->write(archive);
  }



  template <int dim>
  void
  ResultFiles<dim>::read(const Archive &archive)
  {
    prepare_domains();
    n_vtu_written = archive.integer("output/n_vtu_written");
    directory.remove_vtu_from(n_vtu_written);
    // It tells of an end that is none.
    on_root(communicator, [this]() {
      std::filesystem::remove(directory.file("summary.json"));
    });
    t_written  = archive.number("output/t_written");
    t_accepted = archive.number("output/t_accepted");
    history.read(archive);
    points_pvd.read(archive);
    mesh_pvd.read(archive);
    if (archive.contains("output/boundaries.pvd/time"))
      boundaries_pvd.read(archive);
    if (domains_pvd && archive.contains("output/domains.pvd/time"))
      domains_pvd->read(archive);
  }



  template <int dim>
  void
  ResultFiles<dim>::step_accepted(const AcceptedStep<dim> &step)
  {
    TimerOutput::Scope scope(timer, "output");
    // ParaView wants times that grow.
    t_accepted = step.time.coordinate();
    history.add_row(row_of(step));
    acting.clear();
    for (const auto &report : step.reports)
      acting.push_back(report.name);
    if (scene.output.times.due(step.time))
      write_vtu(t_accepted, step.increments);
  }



  template <int dim>
  void
  ResultFiles<dim>::add_motions(const double             t,
                                std::vector<NamedValue> &row) const
  {
    for (const auto &[name, translation] : translations)
      {
        const Tensor<1, dim> u = translation(t);
        for (unsigned int d = 0; d < dim; ++d)
          row.push_back(
            {std::string("u_") + "xyz"[d] + " of " + name, "length", u[d]});
      }
  }



  template <int dim>
  void
  ResultFiles<dim>::add_moments(const std::vector<BoundaryReport<dim>> &reports,
                                std::vector<NamedValue> &row) const
  {
    // Those of absorbing boundaries, which do not turn, follow.
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
        row.push_back(
          {"moment of " + reports[b].name, "force length", reports[b].moment});
        row.push_back({"force magnitude of " + reports[b].name,
                       "force",
                       reports[b].force_magnitude});
      }
  }



  template <int dim>
  std::vector<NamedValue>
  ResultFiles<dim>::row_of(const AcceptedStep<dim> &step) const
  {
    std::vector<NamedValue> row;
    const bool seconds = scene.is_dynamic() && !scene.units.time.empty();
    row.push_back({"t", seconds ? "time" : "-", step.time.time()});
    if (scene.stages.back().second.time.follows_path())
      row.push_back({"path_length", "length", step.time.path_length()});
    // What does not act in a stage has columns, too, of zeros.
    std::vector<BoundaryReport<dim>> reports;
    const auto                       add = [&](const std::string &name) {
      for (const auto &report : step.reports)
        if (report.name == name)
          return reports.push_back(report);
      reports.push_back({name, {}, 0., 0., 0., 0.});
    };
    for (const auto &boundary : model.boundaries)
      add(boundary.name());
    for (const auto &condition : model.grid_conditions)
      add(condition.name);
    for (const auto &boundary : model.absorbing_boundaries)
      if (!scene.absorbs_later(boundary.name()))
        add(boundary.name());
    if (scene.changes_bodies())
      row.push_back({"mass", "mass", mass_of(model)});
    for (const auto &report : reports)
      for (unsigned int d = 0; d < dim; ++d)
        row.push_back(
          {std::string("reaction_") + "xyz"[d] + " of " + report.name,
           "force",
           report.reaction[d]});
    add_motions(step.time.time(), row);
    add_moments(reports, row);
    for (unsigned int b = 0; b < model.boundaries.size(); ++b)
      {
        row.push_back(
          {"violation of " + reports[b].name, "length", reports[b].violation});
        row.push_back({"penetration of " + reports[b].name,
                       "length",
                       reports[b].penetration});
      }
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



  template <int dim>
  void
  ResultFiles<dim>::write_vtu(const double t, const Increments &increments)
  {
    write_points(t);
    if (scene.output.mesh)
      {
        const std::string name =
          OutputDirectory::vtu_name("mesh", n_vtu_written);
        std::vector<NodeField<dim>> fields = {
          {"step_displacement", "length", increments}};
        // Before the first step with inertia all nodes are at rest.
        const Increments none(increments.size());
        const auto       add = [&](const std::string &field,
                             const std::string &unit,
                             const Increments  &values) {
          fields.push_back(
            {field, unit, values.size() == none.size() ? values : none});
        };
        if (model.motion && !model.motion->points_carry())
          {
            add("velocity", "length/time", model.motion->velocities());
            add("acceleration", "length/time^2", model.motion->accelerations());
          }
        write_mesh_vtu<dim>(*model.space,
                            fields,
                            SmoothedStress<dim>(*model.points),
                            directory.file(name),
                            t,
                            n_vtu_written,
                            scene.units);
        mesh_pvd.add(t, name);
        write_boundaries(t);
      }
    ++n_vtu_written;
  }



  template <int dim>
  void
  ResultFiles<dim>::write_boundaries(const double t)
  {
    if (model.boundaries.empty())
      return;
    on_root(communicator, [this]() {
      std::filesystem::create_directory(directory.file("boundaries"));
    });
    const std::string name =
      OutputDirectory::vtu_name("boundaries", n_vtu_written);
    write_boundary_vtu(
      model, acting, directory.file(name), t, n_vtu_written, scene.units);
    boundaries_pvd.add(t, name);
  }



  template <int dim>
  void
  ResultFiles<dim>::write_points(const double t)
  {
    t_written = t;
    if (!scene.output.points)
      return;
    const std::string name = OutputDirectory::vtu_name("points", n_vtu_written);
    write_point_vtu(
      *model.points, directory.file(name), t, n_vtu_written, scene.units);
    points_pvd.add(t, name);
    if (!domains_pvd)
      return;
    const std::string domains =
      OutputDirectory::vtu_name("domains", n_vtu_written);
    write_domain_vtu(*model.basis,
                     *model.points,
                     directory.file(domains),
                     t,
                     n_vtu_written,
                     scene.units);
    domains_pvd->add(t, domains);
  }



  template <int dim>
  void
  ResultFiles<dim>::run_ends(const Summary &summary, const RunCounts &)
  {
    if (n_vtu_written == 0 || t_written < t_accepted)
      write_points(t_accepted);
    summary.write(directory.file("summary.json"), communicator);
  }



  template <int dim>
  void
  ResultFiles<dim>::run_fails(const Summary &summary)
  {
    try
      {
        summary.write(directory.file("summary.json"), communicator);
      }
    catch (const InputError &)
      {
        // The first error is the one to report.
      }
  }



  template class ResultFiles<2>;
  template class ResultFiles<3>;
} // namespace moraine
