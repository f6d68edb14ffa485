// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_round_moments_h
#define moraine_geometry_round_moments_h

#include <moraine/geometry/convex_polytope.h>

namespace moraine
{
  /** An edge's part in a disc, and the way from its end to the next one's start
   * as the angle [rad] at the centre; of an arc that lies in the polygon. */
  template <int dim>
  struct DiscChord
  {
    dealii::Point<dim> enter, leave;
    double             angle_after;
  };

  /**
   * The rim of a polygon within a disc, as seen in the first two coordinates:
   * all chords in order, or an empty one before the whole circle. Polygons that
   * share an edge agree on its chord, even where the circle grazes it.
   */
  template <int dim>
  std::vector<DiscChord<dim>>
  chords_in_disc(const typename ConvexPolytope<dim>::PointList &polygon,
                 const dealii::Point<2>                        &centre,
                 const double                                   radius);

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
