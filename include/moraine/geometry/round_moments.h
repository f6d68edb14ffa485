// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_round_moments_h
#define moraine_geometry_round_moments_h

#include <moraine/geometry/convex_polytope.h>

namespace moraine
{
  /**
   * Volume and first moment about @p reference of the part of @p cell in a
   * disc (2D) or sphere (3D); exact.
   */
  template <int dim>
  VolumeMoments<dim>
  moments_in_ball(const ConvexPolytope<dim> &cell,
                  const dealii::Point<dim>  &centre,
                  const double               radius,
                  const dealii::Point<dim>  &reference);

  /**
   * The same of the part in an endless cylinder about the line through
   * @p start along the unit vector @p axis; exact.
   */
  VolumeMoments<3>
  moments_in_cylinder(const ConvexPolytope<3>    &cell,
                      const dealii::Point<3>     &start,
                      const dealii::Tensor<1, 3> &axis,
                      const double                radius,
                      const dealii::Point<3>     &reference);
} // namespace moraine

#endif
