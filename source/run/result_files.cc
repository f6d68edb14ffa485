// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/result_files.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/output/mesh_vtu.h>
#include <moraine/output/on_root.h>
#include <moraine/output/point_vtu.h>
#include <moraine/output/stress_rows.h>
#include <moraine/run/condition_results.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <optional>

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
    , translations(translations_of_conditions(scene, model))
    , t_written(scene.start_time())
    , t_accepted(scene.start_time())
  {}



  template <int dim>
  void
  ResultFiles<dim>::prepare_series()
  {
    const auto add = [this](const std::string &series) {
      on_root(communicator, [&]() {
        std::filesystem::create_directory(directory.file(series));
      });
      lists.emplace(series,
                    PvdHistory(directory.file(series + ".pvd"), communicator));
    };
    add("points");
    add("mesh");
    if (scene.output.mesh && !model.boundaries.empty())
      add("boundaries");
    if (scene.output.mesh && !model.contact_boundaries.empty())
      add("contact");
    if (scene.output.points && model.basis->has_domains())
      add("domains");
    if (scene.output.points && model.loads.water)
      add("water");
  }



  template <int dim>
  void
  ResultFiles<dim>::add_file(
    const std::string                            &series,
    const double                                  t,
    const std::function<void(const VtuTarget &)> &write_vtu_file)
  {
    const auto name = OutputDirectory::vtu_name(series, n_vtu_written);
    write_vtu_file(
      {directory.file(name), t, n_vtu_written, scene.output.units});
    lists.at(series).add(t, name);
  }



  template <int dim>
  void
  ResultFiles<dim>::run_begins()
  {
    prepare_series();
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
    for (const auto &[series, list] : lists)
      list.write(archive);
  }



  template <int dim>
  void
  ResultFiles<dim>::read(const Archive &archive)
  {
    prepare_series();
    n_vtu_written = archive.integer("output/n_vtu_written");
    directory.remove_vtu_from(n_vtu_written);
    // It tells of an end that is none.
    on_root(communicator, [this]() {
      std::filesystem::remove(directory.file("summary.json"));
    });
    t_written  = archive.number("output/t_written");
    t_accepted = archive.number("output/t_accepted");
    history.read(archive);
    for (auto &[series, list] : lists)
      if (archive.contains("output/" + series + ".pvd/time"))
        list.read(archive);
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
        add_file("mesh", t, [&](const VtuTarget &target) {
          std::optional<SmoothedStress<dim>> effective;
          if (has_excess_pressure<dim>(model.points->fields()))
            effective.emplace(*model.points, true);
          write_mesh_vtu<dim>(*model.space,
                              fields,
                              SmoothedStress<dim>(*model.points),
                              target,
                              effective ? &*effective : nullptr);
        });
        if (!model.boundaries.empty())
          add_file("boundaries", t, [&](const VtuTarget &target) {
            write_boundary_vtu(model, acting, target);
          });
        if (!model.contact_boundaries.empty())
          add_file("contact", t, [&](const VtuTarget &target) {
            write_contact_vtu(model, target);
          });
      }
    ++n_vtu_written;
  }



  template <int dim>
  void
  ResultFiles<dim>::write_points(const double t)
  {
    t_written = t;
    if (!scene.output.points)
      return;
    add_file("points", t, [&](const VtuTarget &target) {
      write_point_vtu(*model.points, target);
    });
    if (lists.count("domains") > 0)
      add_file("domains", t, [&](const VtuTarget &target) {
        write_domain_vtu(*model.basis, *model.points, target);
      });
    if (lists.count("water") > 0)
      add_file("water", t, [&](const VtuTarget &target) {
        write_water_vtu(model, target);
      });
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
