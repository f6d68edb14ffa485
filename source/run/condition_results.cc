// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/condition_results.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/words.h>

#include <deal.II/grid/grid_tools.h>

#include <memory>

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
        const Placement<dim> &before = boundary.pose_at_start();
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



#define INSTANTIATE(dim)                                                      \
  template decltype(translations_of_conditions<dim>)                          \
                                             translations_of_conditions<dim>; \
  template decltype(write_boundary_vtu<dim>) write_boundary_vtu<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
