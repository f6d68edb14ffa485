// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/start_checks.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/boundary/condition_agreement.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** That bodies are in front of a surface of contact, which they may touch
     * later; an overlap of a tenth of a cell is a fit. What is more than two
     * cells behind it, while something is in front, is on the other side of a
     * wall. */
    template <int dim>
    void
    check_overlap(const ContactBoundary<dim> &boundary, const double h)
    {
      const double fit = 0.1 * h, other_side = 2 * h;
      std::vector<std::pair<double, unsigned int>> behind; // with the place
      bool                                         any_in_front = false;
      for (unsigned int k = 0; k < boundary.places_of_rim().places().size();
           ++k)
        if (const auto distance = boundary.distance_at_start(k))
          {
            if (*distance < -fit)
              behind.emplace_back(-*distance, k);
            else
              any_in_front = true;
          }
      std::pair<double, unsigned int> deepest(0., 0);
      for (const auto &of : behind)
        if (!any_in_front || of.first < other_side)
          deepest = std::max(deepest, of);
      if (deepest.first == 0.)
        return;
      std::ostringstream text;
      text << "section 'Boundaries/" << boundary.name()
           << "': found a body behind the surface by " << deepest.first
           << " at (" << boundary.position(deepest.second)
           << "), allowed: a tenth of a cell; 'Flip' turns the surface";
      throw InputError(text.str());
    }



    /** That boundaries which act are on material. */
    template <int dim>
    void
    check_places_of_boundaries(const StageParameters &stage,
                               const Model<dim>      &model)
    {
      const MPI_Comm communicator = model.space->communicator();
      for (const auto &boundary : model.boundaries)
        if (contains(stage.boundaries, boundary.name()) &&
            !contains(stage.absorbing, boundary.name()) &&
            boundary.n_points(communicator) == 0)
          throw InputError("section 'Boundaries/" + boundary.name() +
                           "': found a surface that touches no body, allowed: "
                           "a surface on or in a body, which is behind it: "
                           "points the other way round, or 'Flip', turn it");
      for (const auto &boundary : model.contact_boundaries)
        if (contains(stage.boundaries, boundary.name()) && boundary.begins())
          check_overlap(boundary, model.mesh->cell_size());
      for (const auto &boundary : model.absorbing_boundaries)
        if (boundary.has_cells() && boundary.n_on_material() == 0)
          throw InputError(
            "section '" +
            (boundary.is_on_side() ? std::string("Grid conditions/") :
                                     std::string("Boundaries/")) +
            boundary.name() + "': found a " +
            (boundary.is_on_side() ? "side" : "surface") +
            " that touches no body, allowed: one on or in a body");
    }



    /** Whether a body that is there has been drawn around @p x. */
    template <int dim>
    bool
    in_a_body(const Point<dim> &x, const Model<dim> &model)
    {
      for (unsigned int b = 0; b < model.bodies.size(); ++b)
        if (model.present[b] && model.bodies[b].shape->contains(x))
          return true;
      return false;
    }



    /** The body must lie on the inner side of a surface. */
    template <int dim>
    void
    check_sides_of_boundaries(const StageParameters &stage,
                              const Model<dim>      &model)
    {
      if (any_of(model.bodies, [](const auto &body) { return !body.shape; }))
        return;
      for (const auto &boundary : model.boundaries)
        {
          if (!contains(stage.boundaries, boundary.name()) ||
              contains(stage.absorbing, boundary.name()))
            continue;
          std::vector<double> area(2, 0.); // inside, behind
          for (const auto &point : boundary.points())
            {
              // Levels of expressions are estimates.
              Point<dim>     x = point.x;
              Tensor<1, dim> normal;
              for (unsigned int k = 0; k < 3; ++k)
                {
                  const NearestPoint<dim> nearest =
                    boundary.surface_at_start().nearest(x);
                  normal = nearest.normal;
                  x += nearest.level * normal;
                }
              const Tensor<1, dim> step = 1e-3 * point.h * normal;
              area[0] += in_a_body(x - step, model) ? point.JxW : 0.;
              area[1] += in_a_body(x + step, model) ? point.JxW : 0.;
            }
          Utilities::MPI::sum(area, model.space->communicator(), area);
          if (area[0] == 0 && area[1] > 0)
            throw InputError(
              "section 'Boundaries/" + boundary.name() +
              "': found the body behind the surface, allowed: a surface whose "
              "normal points out of the body (in 2D the body is on the left of a "
              "line's points, in 3D those of a patch run counter-clockwise seen "
              "from outside of it; reverse them, or use 'Flip')");
        }
    }



    /** Values at the ends of steps, and conditions that agree. */
    template <int dim>
    void
    check_prescribed_motion(const StageParameters &stage, Model<dim> &model)
    {
      const TimeParameters &time = stage.time;
      const double size = (time.end_time - time.start_time) / time.n_steps;
      for (unsigned int step = 0; step <= time.n_steps; ++step)
        model.system->check_values(time.start_time + step * size);
      check_agreement(acting_conditions(model.grid_conditions, stage),
                      *model.space,
                      time.start_time,
                      time.end_time,
                      time.n_steps,
                      model.state->mesh_after_step() ==
                        MeshAfterStep::follow_material);
      for (const auto &boundary : model.boundaries)
        for (const auto &in_cell : model.points->cells())
          boundary.surface_at_end().level(
            model.points->position(in_cell.first));
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



    /** Only the change of a displacement acts: one that is not 0 as the scene
     * begins would be lost. */
    template <int dim>
    void
    check_displacement(const std::string &section,
                       const std::string &found,
                       const double       largest,
                       const Model<dim>  &model)
    {
      const double round_off =
        1e-9 * model.mesh->triangulation().begin_active()->diameter();
      if (Utilities::MPI::max(largest, model.space->communicator()) > round_off)
        reject(section,
               "Displacement",
               found,
               "one that is 0 at the start, as only its change over time acts; "
               "-0.01*t reaches -0.01 at t = 1");
    }



    template <int dim>
    void
    check_displacements(const Scene<dim>      &scene,
                        const StageParameters &stage,
                        const Model<dim>      &model)
    {
      const double t = stage.time.start_time;
      for (const auto &condition :
           acting_conditions(model.grid_conditions, stage))
        {
          double largest = 0;
          for (const auto &entry :
               find_prescribed_nodes<dim>({condition}, *model.space, t).entries)
            largest = std::max(largest,
                               std::abs(condition.displacement(
                                 model.space->built_position(entry.node),
                                 t)[entry.component]));
          check_displacement(
            "Grid conditions/" + condition.name,
            parameters_of(condition.name, scene.grid_conditions).displacement,
            largest,
            model);
        }
      for (const auto &boundary : model.boundaries)
        {
          const std::string &name = boundary.name();
          const std::string &text =
            parameters_of(name, scene.boundaries).displacement;
          if (!contains(stage.boundaries, name) || text.empty())
            continue;
          const std::string     section = "Boundaries/" + name;
          const Expression<dim> u(text, place(section, "Displacement"), dim);
          double                largest = 0;
          for (const auto &point : boundary.points())
            largest = std::max(largest, u.vector_value(point.x, t).norm());
          check_displacement(section, text, largest, model);
        }
    }



    template <int dim>
    void
    check_loads(const Model<dim> &model)
    {
      for (const auto &force : model.loads.body_forces)
        for (unsigned int b = 0; b < model.bodies.size(); ++b)
          if (force.times_density && force.acts_on[b] &&
              !(model.materials[b]->density() > 0))
            throw InputError(
              "section 'Loads/" + force.name + "': found gravity on body '" +
              model.bodies[b].name +
              "', whose material has no 'Density', allowed: bodies with a "
              "density > 0");
    }
  } // namespace



  template <int dim>
  void
  check_start(const Scene<dim>      &scene,
              const StageParameters &stage,
              const bool             first,
              Model<dim>            &model)
  {
    check_places_of_boundaries(stage, model);
    check_prescribed_motion(stage, model);
    if (first)
      {
        check_sides_of_boundaries(stage, model);
        check_displacements(scene, stage, model);
      }
    check_loads(model);
  }



#define INSTANTIATE(dim) template decltype(check_start<dim>) check_start<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
