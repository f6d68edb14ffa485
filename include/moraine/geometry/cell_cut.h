// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_cell_cut_h
#define moraine_geometry_cell_cut_h

#include <moraine/geometry/surface.h>

#include <algorithm>
#include <cmath>

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
  cell_size(const CellVertices<dim> &cell)
  {
    double size = 0.;
    for (const auto &vertex : cell)
      size = std::max(size, vertex.distance(cell[0]));
    return size;
  }

  /** Largest absolute coordinate. */
  template <int dim>
  double
  coordinate_magnitude(const dealii::Point<dim> &x)
  {
    double magnitude = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      magnitude = std::max(magnitude, std::abs(x[d]));
    return magnitude;
  }

} // namespace moraine

#endif
