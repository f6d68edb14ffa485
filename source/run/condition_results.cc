// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/condition_results.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <memory>
#include <optional>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Whether @p displacement is the same everywhere in the mesh, at @p start
     * and at @p end; not if it is no number there. */
    template <int dim, typename Displacement>
    bool
    is_uniform(const Displacement        &displacement,
               const BackgroundMesh<dim> &mesh,
               const double               start,
               const double               end)
    {
      const auto box = GridTools::compute_bounding_box(mesh.triangulation());
      try
        {
          for (const double t : {start, end})
            for (unsigned int d = 0; d < dim; ++d)
              {
                Point<dim> x = box.center();
                x[d] += (0.31 + 0.07 * d) * box.side_length(d);
                if (displacement(x, t) != displacement(box.center(), t))
                  return false;
              }
        }
      catch (const InputError &)
        {
          return false;
        }
      return true;
    }



    /** When the condition @p name begins to act. */
    template <int dim>
    double
    start_of(const std::string &name, const Scene<dim> &scene)
    {
      for (const auto &[stage_name, stage] : scene.stages)
        if (contains(stage.boundaries, name) ||
            contains(stage.grid_conditions, name))
          return stage.time.start_time;
      return scene.start_time();
    }



    /** What @p parameters prescribe, if it is one translation. */
    template <int dim, typename Parameters>
    void
    add_translation(const Scene<dim>       &scene,
                    const Model<dim>       &model,
                    const std::string      &section,
                    const std::string      &name,
                    const Parameters       &parameters,
                    NamedTranslations<dim> &translations)
    {
      const auto &motion = parameters.motion;
      if (parameters.constraint == "absorbing" ||
          (motion.translation.empty() && parameters.displacement.empty()))
        return;
      const std::string                path = section + "/" + name;
      std::shared_ptr<Expression<dim>> expression;
      if (!parameters.displacement.empty())
        expression =
          std::make_shared<Expression<dim>>(parameters.displacement,
                                            place(path, "Displacement"),
                                            dim);
      const auto displacement = [expression](const Point<dim> &x,
                                             const double      t) {
        return expression ? expression->vector_value(x, t) : Tensor<1, dim>();
      };
      const double start = start_of(name, scene);
      if (!is_uniform(displacement,
                      *model.mesh,
                      start,
                      scene.stages.back().second.time.end_time))
        return;
      Point<dim> centre;
      for (unsigned int d = 0; d < motion.rotation_centre.size(); ++d)
        centre[d] = motion.rotation_centre[d];
      const auto at = [=, rigid = motion.make_motion(path)](const double t) {
        return (rigid.pose(t).map(centre) - centre) + displacement(centre, t);
      };
      translations.emplace_back(name, [at, start](const double t) {
        return t > start ? at(t) - at(start) : Tensor<1, dim>();
      });
    }



    /** Of the phreatic line above or below @p x, if there is one in the box. */
    template <int dim>
    std::optional<double>
    height_of_line(const Water<dim>       &water,
                   const Point<dim>       &x,
                   const BoundingBox<dim> &box,
                   const double            t)
    {
      if (const auto level = water.level(x, t))
        return level;
      constexpr unsigned int n_steps = 200;
      const auto             wet     = [&](const double height) {
        Point<dim> at = x;
        at[dim - 1]   = height;
        return water.uncut_pressure(at, t) > 0;
      };
      const double step  = box.side_length(dim - 1) / n_steps;
      double       upper = box.upper_bound(dim - 1);
      for (unsigned int k = 0; k < n_steps; ++k, upper -= step)
        if (!wet(upper) && wet(upper - step))
          {
            double lower = upper - step;
            for (unsigned int halving = 0; halving < 40; ++halving)
              {
                const double middle           = 0.5 * (lower + upper);
                (wet(middle) ? lower : upper) = middle;
              }
            return upper;
          }
      return {};
    }
  } // namespace



  template <int dim>
  NamedTranslations<dim>
  translations_of_conditions(const Scene<dim> &scene, const Model<dim> &model)
  {
    NamedTranslations<dim> translations;
    for (const auto &[name, parameters] : scene.boundaries)
      add_translation(
        scene, model, "Boundaries", name, parameters, translations);
    for (const auto &[name, parameters] : scene.grid_conditions)
      add_translation(
        scene, model, "Grid conditions", name, parameters, translations);
    return translations;
  }



  template <int dim>
  void
  write_boundary_vtu(const Model<dim>               &model,
                     const std::vector<std::string> &acting,
                     const VtuTarget                &target)
  {
    VtuFile<0, dim> file(target);
    file.add_vector("normal", "-");
    file.add_scalar("size", dim == 2 ? "length" : "length^2");
    file.add_scalar("boundary", "-");
    // At small strain surfaces stay where they are.
    const bool stay = model.state->mesh_after_step() == MeshAfterStep::keep;
    std::vector<typename VtuFile<0, dim>::Patch> patches;
    for (unsigned int b = 0; b < model.boundaries.size(); ++b)
      {
        const ImplicitBoundary<dim> &boundary = model.boundaries[b];
        if (!contains(acting, boundary.name()))
          continue;
        const Placement<dim> &before = boundary.surface_at_start().pose();
        const Placement<dim>  now =
          stay ? before : boundary.rigid_motion().pose(target.time);
        for (const BoundaryPoint<dim> &point : boundary.points())
          if (point.holds)
            {
              const Tensor<1, dim> normal =
                now.rotate(before.inverse().rotate(point.normal));
              patches.emplace_back();
              patches.back().vertices[0] = now.map(before.inverse(point.x));
              patches.back().data.reinit(file.n_rows(), 1);
              for (unsigned int d = 0; d < dim; ++d)
                patches.back().data(d, 0) = normal[d];
              patches.back().data(dim, 0)     = point.JxW;
              patches.back().data(dim + 1, 0) = b;
            }
      }
    file.write(model.space->communicator(),
               patches.size(),
               [&patches](const unsigned int i) { return patches[i]; });
  }



  template <int dim>
  void
  write_contact_vtu(const Model<dim> &model, const VtuTarget &target)
  {
    const MPI_Comm  communicator = model.space->communicator();
    VtuFile<0, dim> file(target);
    file.add_vector("traction", "stress");
    file.add_vector("normal", "-");
    for (const char *name : {"gap", "slip"})
      file.add_scalar(name, "length");
    file.add_scalar("size", dim == 2 ? "length" : "length^2");
    for (const char *name : {"status", "boundary"})
      file.add_scalar(name, "-");
    std::vector<typename VtuFile<0, dim>::Patch> patches;
    // All ranks know all places.
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      for (unsigned int b = 0; b < model.contact_boundaries.size(); ++b)
        {
          const ContactBoundary<dim> &boundary = model.contact_boundaries[b];
          const auto &places = boundary.places_of_rim().places();
          for (unsigned int k = 0; k < places.size(); ++k)
            {
              const ContactPlace<dim> &carried = boundary.at_place(k);
              patches.emplace_back();
              patches.back().vertices[0] = boundary.position(k);
              auto &data                 = patches.back().data;
              data.reinit(file.n_rows(), 1);
              for (unsigned int d = 0; d < dim; ++d)
                {
                  data(d, 0)       = carried.traction[d];
                  data(dim + d, 0) = places[k].normal[d];
                }
              const std::array<double, 5> rest = {{boundary.distance(k),
                                                   carried.slip,
                                                   places[k].weight,
                                                   carried.status,
                                                   double(b)}};
              for (unsigned int i = 0; i < rest.size(); ++i)
                data(2 * dim + i, 0) = rest[i];
            }
        }
    file.write(communicator, patches.size(), [&patches](const unsigned int i) {
      return patches[i];
    });
  }



  template <int dim>
  void
  write_water_vtu(const Model<dim> &model, const VtuTarget &target)
  {
    constexpr unsigned int n_columns = 200;
    VtuFile<0, dim>        file(target);
    file.add_scalar("kind", "-");
    std::vector<typename VtuFile<0, dim>::Patch> patches;
    const auto add = [&](Point<dim> x, const double height, const double kind) {
      x[dim - 1] = height;
      patches.emplace_back();
      patches.back().vertices[0] = x;
      patches.back().data.reinit(1, 1);
      patches.back().data(0, 0) = kind;
    };
    const MPI_Comm communicator = model.space->communicator();
    const auto     box =
      GridTools::compute_bounding_box(model.mesh->triangulation());
    if (model.loads.water->water &&
        Utilities::MPI::this_mpi_process(communicator) == 0)
      for (unsigned int k = 0; k <= n_columns; ++k)
        {
          Point<dim> x = box.center();
          x[0] =
            box.lower_bound(0) + double(k) / n_columns * box.side_length(0);
          try
            {
              const Water<dim> &water = *model.loads.water->water;
              if (const auto line = height_of_line(water, x, box, target.time))
                add(x, *line, 0.);
              if (const auto level = water.free_level(x, target.time))
                add(x, *level, 1.);
            }
          catch (const InputError &)
            {} // beside the bodies it need not have values
        }
    file.write(communicator, patches.size(), [&patches](const unsigned int i) {
      return patches[i];
    });
  }



#define INSTANTIATE(dim)                                                      \
  template decltype(translations_of_conditions<dim>)                          \
                                             translations_of_conditions<dim>; \
  template decltype(write_boundary_vtu<dim>) write_boundary_vtu<dim>;         \
  template decltype(write_contact_vtu<dim>)  write_contact_vtu<dim>;          \
  template decltype(write_water_vtu<dim>)    write_water_vtu<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
