// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_polygon_h
#define moraine_geometry_polygon_h

#include <deal.II/base/point.h>

#include <utility>
#include <vector>

namespace moraine
{
  /** The third component of the cross product. */
  inline double
  cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }

  /** The vertices of a closed polygon in order. */
  using Polygon = std::vector<dealii::Point<2>>;

  /** Signed area, positive if counter-clockwise. */
  double
  polygon_area(const Polygon &polygon);

  /**
   * The numbers, from 0, of two edges (edge i goes from vertex i to the next)
   * of a closed polygon that meet elsewhere than in a common end, or fold back
   * on each other; a repeated vertex is given as twice its own number. Two
   * equal numbers of n, the number of vertices, mean a simple polygon.
   */
  std::pair<unsigned int, unsigned int>
  first_crossing(const Polygon &polygon);

  /** What makes up a counter-clockwise simple polygon: itself or triangles. */
  std::vector<Polygon>
  convex_parts(Polygon polygon);

  /** A plane's own coordinates; first x second = normal, of unit length. */
  struct PlaneFrame
  {
    PlaneFrame(const dealii::Point<3>     &origin,
               const dealii::Tensor<1, 3> &normal);

    dealii::Point<2>
    to_plane(const dealii::Point<3> &x) const
    {
      return {(x - origin) * first, (x - origin) * second};
    }

    dealii::Point<3>
    to_space(const dealii::Point<2> &p) const
    {
      return origin + p[0] * first + p[1] * second;
    }

    dealii::Point<3>     origin;
    dealii::Tensor<1, 3> first, second;
  };
} // namespace moraine

#endif
