// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/drawn_bodies.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  bool
  are_drawn(const std::vector<Body<dim>> &bodies)
  {
    return std::all_of(bodies.begin(), bodies.end(), [](const auto &body) {
      return body.shape != nullptr;
    });
  }



  template <int dim>
  bool
  in_a_body(const Point<dim> &x, const Model<dim> &model)
  {
    for (unsigned int b = 0; b < model.bodies.size(); ++b)
      if (model.present[b] && model.bodies[b].shape->contains(x))
        return true;
    return false;
  }



  template <int dim>
  SurfacePoint<dim>
  foot_of(const BoundaryPoint<dim>    &place,
          const ImplicitBoundary<dim> &boundary)
  {
    SurfacePoint<dim> foot = {place.x, place.normal, place.JxW};
    // Levels of expressions are estimates.
    for (unsigned int k = 0; k < 3; ++k)
      {
        const NearestPoint<dim> nearest = boundary.nearest_at_start(foot.x);
        foot.x += nearest.level * nearest.normal;
        foot.normal = nearest.normal;
      }
    return foot;
  }



#define INSTANTIATE(dim)                                                        \
  template bool              are_drawn(const std::vector<Body<dim>> &);         \
  template bool              in_a_body(const Point<dim> &, const Model<dim> &); \
  template SurfacePoint<dim> foot_of(const BoundaryPoint<dim> &,                \
                                     const ImplicitBoundary<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
