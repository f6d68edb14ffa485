// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shapes_h
#define moraine_geometry_shapes_h

#include <moraine/geometry/shape.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** All behind a plane. */
  template <int dim>
  struct HalfSpace
  {
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> outward; ///< of unit length

    /** Distance from the plane, positive behind it. */
    double
    depth(const dealii::Point<dim> &x) const
    {
      return outward * (point - x);
    }
  };

  /** The convex body behind all @p planes; it must lie in @p box. @p names of
   * the planes may be left out if there is only one. */
  template <int dim>
  ShapePointer<dim>
  make_convex(const std::vector<HalfSpace<dim>> &planes,
              const dealii::BoundingBox<dim>    &box   = unlimited_box<dim>(),
              const std::vector<std::string>    &names = {});

  /** All of space: the body is the mesh. */
  template <int dim>
  ShapePointer<dim>
  make_space()
  {
    return make_convex<dim>({});
  }

  /** The half-space behind a plane; the normal need not have unit length. */
  template <int dim>
  ShapePointer<dim>
  make_half_space(const dealii::Point<dim>     &point,
                  const dealii::Tensor<1, dim> &outward_normal)
  {
    return make_convex<dim>({{point, outward_normal / outward_normal.norm()}});
  }

  /** The box with these opposite corners, lower < upper. Its sides are called
   * left, right (x), bottom, top (y), or front, back (y), bottom, top (z). */
  template <int dim>
  ShapePointer<dim>
  make_box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper);

  /**
   * A simple polygon, convex or not, in the x-y plane; in 3D the prism over it
   * between two values of z. The vertices in either sense of rotation, at least
   * three, without crossing edges (see first_crossing()). The rim
   * has the edges, counted from 1 in the order given; in 3D bottom and top.
   */
  template <int dim>
  ShapePointer<dim>
  make_polygon(const std::vector<dealii::Point<2>> &vertices,
               const std::pair<double, double>     &heights = {0., 1.});

  /**
   * Disc (2D) or sphere (3D). Its part of a polytope is exact: in 2D by
   * triangles and circular segments of the polygon; in 3D, per face and edge,
   * the part within the sphere of the cone from its centre. Throws InputError
   * for a radius that is not positive.
   */
  template <int dim>
  std::shared_ptr<const SmoothShape<dim>>
  make_ball(const dealii::Point<dim> &centre, const double radius);

  /**
   * Solid or hollow circular cylinder. Its rim has the parts side, or outer and
   * inner, and bottom and top, where the axis starts and ends. Its part of a
   * polytope is exact, as for a disc by the faces seen along the axis (the
   * height over them is integrated, by the divergence theorem). Throws
   * InputError for an axis without length or a radius that is not positive.
   */
  ShapePointer<3>
  make_cylinder(const dealii::Point<3> &start,
                const dealii::Point<3> &end,
                const double            radius,
                const double            inner_radius = 0.);

  /**
   * Where an expression in x, y and z is positive. What is smaller than a
   * sub-cell between its vertices is not seen. The gradient is by central
   * differences (errors about 1e-9 relative to φ's variation over a cell).
   * @p place: where the text stands, for messages.
   *
   * Throws InputError if the text cannot be understood; later where it has no
   * finite value, and for a boundary with so many details in a cell that
   * dividing it would take too long.
   */
  template <int dim>
  std::shared_ptr<const SmoothShape<dim>>
  make_expression(const std::string &text, const std::string &place);

  /** A shape after a rigid motion. */
  template <int dim>
  ShapePointer<dim>
  make_moved(const ShapePointer<dim> &shape, const Placement<dim> &motion);

  /**
   * What two shapes a and b make: their union (a + b - ab), their
   * intersection ab (the pieces of the straighter one, clipped by the other),
   * their difference (a - ab), or a hollowed out by b, which lies inside a
   * (a - b: ring, tube; needs no intersection).
   */
  enum class Operation
  {
    unite,
    intersect,
    subtract,
    hollow_out
  };

  /**
   * A combination of two shapes. The rims of the operands are the parts of its
   * rim, with the names given. Parts of theirs are called name/part, or part if
   * they have no name.
   */
  template <int dim>
  ShapePointer<dim>
  combine(const Operation                   operation,
          const ShapePointer<dim>          &a,
          const ShapePointer<dim>          &b,
          const std::array<std::string, 2> &names = {});

  /** The plane (2D: the straight line) that bounds a half space, as far as it
   * is in all of @p ends, whose planes are across it. */
  template <int dim>
  SurfacePointer<dim>
  make_plane(const HalfSpace<dim>              &body,
             const Extent<dim>                 &extent,
             const std::vector<HalfSpace<dim>> &ends);

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
