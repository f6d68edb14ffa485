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
  /** All of space: the body is the mesh. */
  template <int dim>
  ShapePointer<dim>
  make_space();

  /** What is behind a plane; the normal need not have unit length. */
  template <int dim>
  ShapePointer<dim>
  make_half_space(const dealii::Point<dim>     &point,
                  const dealii::Tensor<1, dim> &outward_normal);

  /**
   * The box with these opposite corners, lower < upper. Its sides are called
   * left, right (x), bottom, top (y), or front, back (y), bottom, top (z).
   */
  template <int dim>
  ShapePointer<dim>
  make_box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper);

  /**
   * What is between the planes through both ends of an axis and across it, as
   * far as @p box goes. The planes are called bottom and top.
   */
  ShapePointer<3>
  make_slab(const dealii::Point<3>       &start,
            const dealii::Point<3>       &end,
            const dealii::BoundingBox<3> &box);

  /**
   * A simple polygon, convex or not, in the x-y plane; in 3D the prism over it
   * between two values of z. The vertices in either sense of rotation, at least
   * three, without crossing edges (see first_crossing() in polygon.h). The rim
   * has the edges, counted from 1 in the order given; in 3D bottom and top.
   */
  template <int dim>
  ShapePointer<dim>
  make_polygon(const std::vector<dealii::Point<2>> &vertices,
               const std::pair<double, double>     &heights = {0., 1.});

  /**
   * Disc (2D) or sphere (3D), or what is within @p radius of the endless line
   * through @p centre along @p axis if that is not zero. Its part of a polytope
   * is exact: in 2D and for cylinders by triangles and circular segments of the
   * polygons, or of the faces seen along the axis (the height over them is
   * integrated, by the divergence theorem); for spheres, per face and edge, the
   * part within the sphere of the cone from its centre. Throws InputError for a
   * radius that is not positive.
   */
  template <int dim>
  std::shared_ptr<const SmoothShape<dim>>
  make_ball(const dealii::Point<dim>     &centre,
            const double                  radius,
            const dealii::Tensor<1, dim> &axis = {});

  /**
   * Solid or hollow circular cylinder. Its rim has the parts side, or outer and
   * inner, and bottom and top, where the axis starts and ends. Throws
   * InputError for an axis without length.
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
   * @p place: where the text stands, for messages. @p length: scale of
   * differences where no cell is at hand; 0: the coordinates' size.
   *
   * Throws InputError if the text cannot be understood; later where it has no
   * finite value, and for a boundary with so many details in a cell that
   * dividing it would take too long.
   */
  template <int dim>
  std::shared_ptr<const SmoothShape<dim>>
  make_expression(const std::string &text,
                  const std::string &place,
                  const double       length = 0.);

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
} // namespace moraine

#endif
