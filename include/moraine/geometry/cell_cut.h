// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_cell_cut_h
#define moraine_geometry_cell_cut_h

#include <moraine/geometry/surface.h>
#include <moraine/geometry/polygon.h>

namespace moraine
{
  /**
   * Where a plane (2D: a line) cuts one cell, given the plane's signed distance
   * at the vertices (positive on the body's side): chords of two points in 2D,
   * closed polygons in 3D, usually one.
   *
   * Every decision rests on data two neighbours share: the sign at a vertex and
   * the crossing point of an edge, computed in an order of its ends that does
   * not depend on the cell. So neighbours agree to the last bit, and
   * the pieces of a mesh fit without gap or overlap. Vertices nearer to the
   * plane than 2⁻⁴⁴ of the coordinates' size (at least @p magnitude) are on it
   * and count as outside the body; hence a plane through a face cuts the cell
   * on the body's side only.
   */
  template <int dim>
  std::vector<std::vector<dealii::Point<dim>>>
  cut_cell(const CellVertices<dim>              &cell,
           const std::array<double, (1 << dim)> &distance,
           const double                          magnitude);

  /** Whether a cell comes near a box at all; quick and on the safe side. */
  template <int dim>
  bool
  may_touch(const CellVertices<dim> &cell, const dealii::BoundingBox<dim> &box);

  /** The largest distance of a vertex from the first one. */
  template <int dim>
  double
  cell_size(const CellVertices<dim> &cell);

  /** Largest absolute coordinate. */
  template <int dim>
  double
  coordinate_magnitude(const dealii::Point<dim> &x);

  /**
   * Gauss points on a chord between two abscissae of the line
   * origin + s direction.
   */
  template <int dim>
  void
  add_segment_points(const dealii::Point<dim>       &origin,
                     const dealii::Tensor<1, dim>   &direction,
                     const Stretch                  &stretch,
                     const dealii::Tensor<1, dim>   &normal,
                     const unsigned int              n_gauss,
                     std::vector<SurfacePoint<dim>> &out);

  /** A plane's own coordinates in 3D; first × second = normal. */
  struct PlaneFrame
  {
    PlaneFrame(const dealii::Point<3>     &origin,
               const dealii::Tensor<1, 3> &normal);

    dealii::Point<2>
    to_plane(const dealii::Point<3> &x) const;

    Polygon
    to_plane(const std::vector<dealii::Point<3>> &points) const;

    dealii::Point<3>
    to_space(const dealii::Point<2> &p) const;

    dealii::Point<3>     origin;
    dealii::Tensor<1, 3> normal, first, second;
  };

  /**
   * Quadrature of a polygon in the plane of @p frame, exact for polynomials of
   * degree 2 n_gauss − 1 whatever its shape; weights are positive if it is
   * convex. Tensor product Gauss on parallelograms, Witherden–Vincent rules
   * (n_gauss ≤ 7) on the triangles of a fan otherwise. @p normal is what the
   * points carry.
   */
  void
  add_polygon_points(const Polygon                &polygon,
                     const PlaneFrame             &frame,
                     const dealii::Tensor<1, 3>   &normal,
                     const unsigned int            n_gauss,
                     std::vector<SurfacePoint<3>> &out);
} // namespace moraine

#endif
