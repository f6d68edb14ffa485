// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/result_files.h>

#include <moraine/core/exceptions.h>
#include <moraine/output/domain_vtu.h>
#include <moraine/output/mesh_vtu.h>
#include <moraine/output/on_root.h>
#include <moraine/output/point_vtu.h>
#include <moraine/run/condition_results.h>

#include <deal.II/base/mpi.h>

#include <filesystem>

namespace moraine
{
  using namespace dealii;

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
    , history(directory.file("history.csv"), communicator, scene.output.units)
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
    history.add_row(
      history_row(scene, model, translations, step.time, step.reports));
    acting.clear();
    for (const auto &report : step.reports)
      acting.push_back(report.name);
    if (scene.output.times.due(step.time))
      write_vtu(t_accepted, step.increments);
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
                            scene.output.units);
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
      model, acting, directory.file(name), t, n_vtu_written, scene.output.units);
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
      *model.points, directory.file(name), t, n_vtu_written, scene.output.units);
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
                     scene.output.units);
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
