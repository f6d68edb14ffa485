// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/condition_checks.h>

#include <moraine/boundary/condition_agreement.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/words.h>
#include <moraine/run/held_off_bodies.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The change of a displacement acts: what it is at the start would be lost
     * without a word.
     * @param largest component where the part acts
     * @param first whether it acts from the start of the scene, where it has no
     * past */
    template <int dim>
    void
    check_displacement_at_start(const std::string        &section,
                                const std::string        &found,
                                const double              largest,
                                const bool                first,
                                const Model<dim>         &model,
                                std::vector<std::string> &notes)
    {
      const double round_off =
        1e-9 * model.mesh->triangulation().begin_active()->diameter();
      const double all =
        Utilities::MPI::max(largest, model.space->communicator());
      if (all <= round_off)
        return;
      if (first)
        reject(section,
               "Displacement",
               found,
               "one that is 0 at the start, as only its change over time acts; "
               "-0.01*t reaches -0.01 at t = 1");
      std::ostringstream text;
      text << section.substr(section.find('/') + 1) << ": its 'Displacement' "
           << "has " << std::setprecision(4) << all << " as it begins to act, "
           << "and only its change from then on moves what it holds";
      notes.push_back(text.str());
    }



    template <typename Parameters>
    const Parameters &
    parameters_of(const std::string                                     &name,
                  const std::vector<std::pair<std::string, Parameters>> &all)
    {
      return std::find_if(all.begin(),
                          all.end(),
                          [&](const auto &one) { return one.first == name; })
        ->second;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  idle_conditions(const StageParameters &stage, const Model<dim> &model)
  {
    const std::vector<GridCondition<dim>> active =
      acting_conditions(model.grid_conditions, stage);
    std::vector<unsigned int> n(active.size(), 0);
    for (const auto &entry :
         find_prescribed_nodes(active, *model.space, stage.time.start_time)
           .entries)
      ++n[entry.condition];
    Utilities::MPI::sum(n, model.space->communicator(), n);
    std::vector<std::string> notes;
    for (unsigned int c = 0; c < active.size(); ++c)
      if (n[c] == 0)
        notes.push_back(active[c].name +
                        ": holds no node of a body at the start");
    return notes;
  }



  template <int dim>
  void
  check_prescribed_motion(const StageParameters    &stage,
                          const bool                first,
                          Model<dim>               &model,
                          std::vector<std::string> &notes)
  {
    const TimeParameters &time = stage.time;
    const double size = (time.end_time - time.start_time) / time.n_steps;
    for (unsigned int step = 0; step <= time.n_steps; ++step)
      model.system->check_values(time.start_time + step * size);
    const std::vector<GridCondition<dim>> active =
      acting_conditions(model.grid_conditions, stage);
    check_agreement(active,
                    *model.space,
                    time.start_time,
                    time.end_time,
                    time.n_steps,
                    model.state->mesh_after_step() ==
                      MeshAfterStep::follow_material);
    for (const std::string &note : idle_conditions(stage, model))
      notes.push_back(note);
    if (first)
      tell_of_held_off_bodies(active, model, time.start_time, notes);
    for (const auto &boundary : model.boundaries)
      for (const auto &in_cell : model.points->cells())
        boundary.is_far(model.points->position(in_cell.first), 0.);
  }



  template <int dim>
  void
  check_displacements_at_start(const Scene<dim>         &scene,
                               const StageParameters    &stage,
                               const StageParameters    *before,
                               const Model<dim>         &model,
                               std::vector<std::string> &notes)
  {
    const double t = stage.time.start_time;
    for (const auto &condition :
         acting_conditions(model.grid_conditions, stage))
      {
        if (before && contains(before->grid_conditions, condition.name))
          continue;
        double largest = 0;
        for (const auto &entry :
             find_prescribed_nodes<dim>({condition}, *model.space, t).entries)
          {
            const Point<dim> X = model.space->built_position(entry.node);
            largest =
              std::max(largest,
                       std::abs(condition.displacement(X, t)[entry.component]));
          }
        check_displacement_at_start(
          "Grid conditions/" + condition.name,
          parameters_of(condition.name, scene.grid_conditions).displacement,
          largest,
          !before,
          model,
          notes);
      }
    for (const auto &boundary : model.boundaries)
      {
        const std::string &name = boundary.name();
        if (!contains(stage.boundaries, name) ||
            (before && contains(before->boundaries, name)))
          continue;
        const std::string &text =
          parameters_of(name, scene.boundaries).displacement;
        if (text.empty())
          continue;
        const std::string     section = "Boundaries/" + name;
        const Expression<dim> u(text, place(section, "Displacement"), dim);
        double                largest = 0;
        for (const auto &point : boundary.points())
          largest = std::max(largest, u.vector_value(point.x, t).norm());
        check_displacement_at_start(
          section, text, largest, !before, model, notes);
      }
  }



#define INSTANTIATE(dim)                                                     \
  template std::vector<std::string> idle_conditions(const StageParameters &, \
                                                    const Model<dim> &);     \
  template void check_prescribed_motion(const StageParameters &,             \
                                        const bool,                          \
                                        Model<dim> &,                        \
                                        std::vector<std::string> &);         \
  template void check_displacements_at_start(const Scene<dim> &,             \
                                             const StageParameters &,        \
                                             const StageParameters *,        \
                                             const Model<dim> &,             \
                                             std::vector<std::string> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
