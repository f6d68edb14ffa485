// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_surfaces_h
#define moraine_geometry_surfaces_h

#include <moraine/geometry/shape.h>

#include <vector>

namespace moraine
{
  /** All behind a plane. */
  template <int dim>
  struct HalfSpace
  {
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> outward; ///< of unit length
  };

  /**
   * The plane (2D: the straight line) through @p point with @p normal, of any
   * length, pointing out of the body, as far as it is in all of @p ends, whose
   * planes are across it. Throws InputError if the normal is zero.
   */
  template <int dim>
  SurfacePointer<dim>
  make_plane(const dealii::Point<dim>          &point,
             const dealii::Tensor<1, dim>      &normal,
             const Extent<dim>                 &extent = {},
             const std::vector<HalfSpace<dim>> &ends   = {});

  /**
   * The flat face with these corners; @p flip puts the body on the other side.
   *
   * In 2D one or more straight segments with the body on the LEFT when walking
   * along the points in their order. A last point equal to the first closes the
   * line. Beyond the open ends, φ goes on as the distance to the straight line
   * of the end segment, outside the extent. Throws InputError for fewer than
   * two points or two equal neighbours.
   *
   * In 3D a plane simple polygon. Seen from outside the body its vertices run
   * counter-clockwise (their right-hand normal points out of the body). Throws
   * InputError for fewer than three vertices, no area, vertices off the plane
   * by more than 1e-9 of its size, or edges that cross.
   */
  template <int dim>
  SurfacePointer<dim>
  make_flat_face(const std::vector<dealii::Point<dim>> &corners,
                 const bool                             flip   = false,
                 const Extent<dim>                     &extent = {});

  /**
   * The boundary φ = 0 of a smooth shape, the body in the shape or around it,
   * cut by dealii::NonMatching::QuadratureGenerator in the reference space of
   * the cell (φ composed with the cell's multilinear map). The number of points
   * sets its accuracy; it is not exact. Cells across the end of its extent are
   * cut exactly if that is straight and follows the cell's axes, else halved
   * four times and their points chosen one by one.
   */
  template <int dim>
  SurfacePointer<dim>
  make_smooth_face(const std::shared_ptr<const SmoothShape<dim>> &shape,
                   const bool                                     body_inside,
                   const Extent<dim>                             &extent = {});

  /**
   * The rim of a disc, or an arc of it counter-clockwise from the start to the
   * end angle (degrees from the x axis). Pieces are cut exactly by the cell's
   * straight edges and use Gauss points in the angle, on stretches of at most
   * 45 degrees. Throws InputError for a radius that is not positive, or an arc
   * of zero or more than 360 degrees.
   */
  SurfacePointer<2>
  make_arc(const dealii::Point<2> &centre,
           const double            radius,
           const bool              body_inside,
           const double            start_angle = 0.,
           const double            end_angle   = 360.,
           const Extent<2>        &extent      = {});
} // namespace moraine

#endif
