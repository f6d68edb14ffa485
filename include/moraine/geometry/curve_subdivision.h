// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_curve_subdivision_h
#define moraine_geometry_curve_subdivision_h

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
                   const double              step);

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
} // namespace moraine

#endif
