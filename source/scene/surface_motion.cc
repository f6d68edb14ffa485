// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/surface_motion.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/words.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  VectorFunction<dim>
  vector_function(const std::string &text, const std::string &place)
  {
    if (text.empty())
      return [](const Point<dim> &, const double) { return Tensor<1, dim>(); };
    const auto expression = std::make_shared<Expression<dim>>(text, place, dim);
    return [expression](const Point<dim> &x, const double t) {
      return expression->vector_value(x, t);
    };
  }



  template <int dim>
  double
  first_time_of(const std::string &name, const Scene<dim> &scene)
  {
    for (const auto &[stage_name, stage] : scene.stages)
      if (contains(stage.boundaries, name))
        return stage.time.start_time;
    return scene.start_time();
  }



  template <int dim>
  bool
  varies(const BoundaryParameters<dim> &parameters)
  {
    return has_name(parameters.displacement, {"x", "y", "z"});
  }



  template <int dim>
  RigidMotion<dim>
  motion_of_surface(const std::string             &name,
                    const BoundaryParameters<dim> &parameters,
                    const Scene<dim>              &scene)
  {
    const std::string section = "Boundaries/" + name;
    const auto        given   = vector_function<dim>(parameters.displacement,
                                            place(section, "Displacement"));
    if (varies(parameters) && parameters.constraint == "contact")
      reject(section,
             "Displacement",
             parameters.displacement,
             "expressions in t: the surface is rigid");
    if (varies(parameters) && scene.method.after_step() != MeshAfterStep::keep)
      reject(section,
             "Displacement",
             parameters.displacement,
             "expressions in t; in x, y, z with 'Mesh after step = keep'");
    std::function<Tensor<1, dim>(const double)> of_surface;
    if (!varies(parameters) && !parameters.displacement.empty())
      of_surface = [given, first = first_time_of(name, scene)](const double t) {
        return given(Point<dim>(), t) - given(Point<dim>(), first);
      };
    return parameters.motion.make_motion(section, of_surface);
  }



#define INSTANTIATE(dim)                                          \
  template decltype(vector_function<dim>)   vector_function<dim>; \
  template decltype(first_time_of<dim>)     first_time_of<dim>;   \
  template decltype(varies<dim>)            varies<dim>;          \
  template decltype(motion_of_surface<dim>) motion_of_surface<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
