// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_curved_parts_h
#define moraine_geometry_curved_parts_h

#include <moraine/geometry/shape.h>

#include <functional>
#include <vector>

namespace moraine
{
  /** Positive inside, zero on the boundary. */
  template <int dim>
  using LevelFunction = std::function<double(const dealii::Point<dim> &)>;

  /** Central differences over 2 @p step in each direction. */
  template <int dim>
  dealii::Tensor<1, dim>
  central_gradient(const LevelFunction<dim> &level,
                   const dealii::Point<dim> &x,
                   const double              step)
  {
    dealii::Tensor<1, dim> slope;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const dealii::Tensor<1, dim> shift =
          step * dealii::Point<dim>::unit_vector(d);
        slope[d] = (level(x + shift) - level(x - shift)) / (2. * step);
      }
    return slope;
  }

  /** Where the linear part of a function at @p x vanishes: a step of Newton's
   * method towards its zero. */
  template <int dim>
  dealii::Point<dim>
  linear_zero(const dealii::Point<dim>     &x,
              const double                  value,
              const dealii::Tensor<1, dim> &gradient)
  {
    return x - value / gradient.norm_square() * gradient;
  }

  /**
   * Append the pieces of @p cell in which @p level is positive, times @p sign:
   * the approximation of a curved boundary by polytopes. If @p is_distance,
   * |level| is never more than the distance to the boundary; otherwise what is
   * decided without cutting rests on values at the vertices.
   *
   * A polytope that the boundary may cut is halved until the boundary in it
   * differs from a plane by less than a small fraction of its size, or has been
   * halved often enough to resolve edges of an expression to 1e-3 (2D), 2e-2
   * (3D) of the cell. It is then clipped by the tangent plane, shifted by the
   * mean distance to the boundary over the cut face, so that the volume is
   * right to second order in the curvature.
   */
  template <int dim>
  void
  add_curved_pieces(const LevelFunction<dim>  &level,
                    const bool                 is_distance,
                    const ConvexPolytope<dim> &cell,
                    const double               sign,
                    SignedPieces<dim>         &pieces);

  /** Quick answer that rests on values at the vertices and the middle. */
  template <int dim>
  Overlap
  overlap_by_values(const LevelFunction<dim>  &level,
                    const ConvexPolytope<dim> &cell);

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
   * Volume and first moment about @p reference of the part of @p cell in a disc
   * (2D), a sphere or, if @p axis is not zero but of unit length, an endless
   * cylinder; exact.
   */
  template <int dim>
  VolumeMoments<dim>
  moments_in_round(const ConvexPolytope<dim>    &cell,
                   const dealii::Point<dim>     &centre,
                   const dealii::Tensor<1, dim> &axis,
                   const double                  radius,
                   const dealii::Point<dim>     &reference);
} // namespace moraine

#endif
