// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/straight_shapes.h>

#include <moraine/geometry/polygon.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim>
    lift(const Tensor<1, 2> &a)
    {
      Point<dim> lifted;
      lifted[0] = a[0];
      lifted[1] = a[1];
      return lifted;
    }

  } // namespace



  template <int dim>
  ConvexShape<dim>::ConvexShape(const std::vector<HalfSpace> &sides,
                                const BoundingBox<dim>       &bounding_box)
    : sides(sides)
    , bounds(bounding_box)
  {}



  template <int dim>
  ConvexShape<dim>
  ConvexShape<dim>::box(const Point<dim> &lower, const Point<dim> &upper)
  {
    std::vector<HalfSpace> sides;
    for (unsigned int d = 0; d < dim; ++d)
      {
        sides.push_back({lower, -Point<dim>::unit_vector(d)});
        sides.push_back({upper, Point<dim>::unit_vector(d)});
      }
    return {sides, BoundingBox<dim>(std::make_pair(lower, upper))};
  }



  template <int dim>
  ConvexShape<dim>
  ConvexShape<dim>::space()
  {
    return {{}, infinite_box<dim>()};
  }



  template <int dim>
  ConvexShape<dim>
  ConvexShape<dim>::half_space(const Point<dim>     &point,
                               const Tensor<1, dim> &outward_normal)
  {
    return {{{point, outward_normal / outward_normal.norm()}},
            infinite_box<dim>()};
  }



  template <int dim>
  double
  ConvexShape<dim>::level(const Point<dim> &p) const
  {
    double value = std::numeric_limits<double>::infinity();
    for (const auto &side : sides)
      value = std::min(value, side.outward * (side.point - p));
    return value;
  }



  template <int dim>
  BoundingBox<dim>
  ConvexShape<dim>::bounding_box() const
  {
    return bounds;
  }



  template <int dim>
  Overlap
  ConvexShape<dim>::overlap(const ConvexPolytope<dim> &cell) const
  {
    Overlap answer = Overlap::all;
    for (const auto &side : sides)
      {
        double lowest  = std::numeric_limits<double>::infinity();
        double highest = -lowest;
        for (const auto &x : cell.vertices())
          {
            const double depth = side.outward * (side.point - x);
            lowest             = std::min(lowest, depth);
            highest            = std::max(highest, depth);
          }
        if (highest <= cell.tolerance())
          return Overlap::none;
        if (lowest < -cell.tolerance())
          answer = Overlap::part;
      }
    return answer;
  }



  template <int dim>
  bool
  ConvexShape<dim>::is_straight() const
  {
    return true;
  }



  template <int dim>
  void
  ConvexShape<dim>::add_pieces_of_part(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    ConvexPolytope<dim> part = cell;
    for (const auto &side : sides)
      if (!part.empty())
        part.clip(side.point, -side.outward);
    if (!part.empty())
      pieces.push_back({sign, part});
  }



  template <int dim>
  PolygonShape<dim>::PolygonShape(const std::vector<Point<2>>     &vertices,
                                  const std::pair<double, double> &extent)
    : vertices(vertices)
    , extent(extent)
  {
    if (polygon_area(vertices) < 0.)
      std::reverse(this->vertices.begin(), this->vertices.end());
  }



  template <int dim>
  double
  PolygonShape<dim>::level(const Point<dim> &p) const
  {
    const Point<2> x(p[0], p[1]);
    double         square = std::numeric_limits<double>::infinity();
    bool           inside = false;
    for (unsigned int i = 0; i < vertices.size(); ++i)
      {
        const Point<2>    &a    = vertices[i];
        const Point<2>    &b    = vertices[(i + 1) % vertices.size()];
        const Tensor<1, 2> edge = b - a;
        const double       t =
          std::min(1., std::max(0., (x - a) * edge / edge.norm_square()));
        square = std::min(square, (a + t * edge - x).norm_square());
        // a ray to the right crosses this edge
        if ((a[1] > x[1]) != (b[1] > x[1]) &&
            (cross(edge, x - a) > 0.) == (b[1] > a[1]))
          inside = !inside;
      }
    const double value = inside ? std::sqrt(square) : -std::sqrt(square);
    if constexpr (dim == 3)
      return std::min({value, p[2] - extent.first, extent.second - p[2]});
    else
      return value;
  }



  template <int dim>
  BoundingBox<dim>
  PolygonShape<dim>::bounding_box() const
  {
    Point<dim> lower = lift<dim>(vertices[0]), upper = lower;
    for (const auto &x : vertices)
      for (unsigned int d = 0; d < 2; ++d)
        {
          lower[d] = std::min(lower[d], x[d]);
          upper[d] = std::max(upper[d], x[d]);
        }
    if constexpr (dim == 3)
      {
        lower[2] = extent.first;
        upper[2] = extent.second;
      }
    return BoundingBox<dim>(std::make_pair(lower, upper));
  }



  template <int dim>
  bool
  PolygonShape<dim>::is_straight() const
  {
    return true;
  }



  template <int dim>
  void
  PolygonShape<dim>::add_pieces_of_part(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    ConvexPolytope<dim> slice = cell;
    if constexpr (dim == 3)
      {
        const Tensor<1, dim> up = Point<dim>::unit_vector(2);
        slice.clip(Point<dim>(extent.first * up), up);
        if (!slice.empty())
          slice.clip(Point<dim>(extent.second * up), -up);
      }
    for (unsigned int i = 1; i + 1 < vertices.size(); ++i)
      {
        const std::array<Point<2>, 3> corner{
          {vertices[0], vertices[i], vertices[i + 1]}};
        const double area = cross(corner[1] - corner[0], corner[2] - corner[0]);
        const double turn = area > 0. ? 1. : -1.;
        ConvexPolytope<dim> part = slice;
        for (unsigned int k = 0; k < 3 && area != 0. && !part.empty(); ++k)
          {
            // the same end for the two triangles that share an edge
            const unsigned int j      = (k + 1) % 3;
            const Tensor<1, 2> edge   = turn * (corner[j] - corner[k]);
            const Point<2>    &anchor = k == 2 ? corner[0] : corner[k];
            part.clip(lift<dim>(anchor),
                      lift<dim>(Point<2>(-edge[1], edge[0])));
          }
        if (area != 0. && !part.empty())
          pieces.push_back({sign * turn, part});
      }
  }



  template class ConvexShape<2>;
  template class ConvexShape<3>;
  template class PolygonShape<2>;
  template class PolygonShape<3>;
} // namespace moraine
