// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/straight_shapes.h>

#include <moraine/geometry/polygon.h>
#include <moraine/geometry/straight_surfaces.h>

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
  ConvexShape<dim>::ConvexShape(const std::vector<HalfSpace>   &sides,
                                const BoundingBox<dim>         &bounding_box,
                                const std::vector<std::string> &names)
    : sides(sides)
    , bounds(bounding_box)
    , names(names)
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
    return {sides,
            BoundingBox<dim>(std::make_pair(lower, upper)),
            dim == 2 ?
              std::vector<std::string>{"left", "right", "bottom", "top"} :
              std::vector<std::string>{
                "left", "right", "front", "back", "bottom", "top"}};
  }

  template <int dim>
  ConvexShape<dim>
  ConvexShape<dim>::space()
  {
    return ConvexShape<dim>(std::vector<HalfSpace>());
  }

  template <int dim>
  ConvexShape<dim>
  ConvexShape<dim>::half_space(const Point<dim>     &point,
                               const Tensor<1, dim> &outward_normal)
  {
    return ConvexShape<dim>(
      std::vector<HalfSpace>{{point, outward_normal / outward_normal.norm()}});
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
  std::vector<std::string>
  ConvexShape<dim>::parts() const
  {
    return names;
  }

  template <int dim>
  std::vector<Point<dim>>
  ConvexShape<dim>::corners_of(const unsigned int side) const
  {
    // a larger box, so that its own sides are not the shape's
    const auto          corners = bounds.get_boundary_points();
    const auto          widen   = corners.second - corners.first;
    ConvexPolytope<dim> part(corners.first - widen, corners.second + widen);
    for (unsigned int i = 0; i < sides.size(); ++i)
      if (i != side)
        part.clip(sides[i].point, -sides[i].outward);
    typename ConvexPolytope<dim>::PointList cut;
    part.clip(sides[side].point, -sides[side].outward, &cut);
    if constexpr (dim == 2)
      if (cross(cut[1] - cut[0], sides[side].outward) > 0.)
        std::swap(cut[0], cut[1]);
    return {cut.begin(), cut.end()};
  }

  template <int dim>
  void
  ConvexShape<dim>::add_faces(const std::string          &part,
                              const bool                  body_inside,
                              const Extent<dim>          &extent,
                              typename Shape<dim>::Faces &faces) const
  {
    using Plane = PlaneSurface<dim>;
    for (unsigned int i = 0; i < sides.size(); ++i)
      if (part.empty() || names[i] == part)
        {
          if (is_finite(bounds))
            {
              faces.push_back(
                std::make_shared<Plane>(corners_of(i), !body_inside, extent));
              continue;
            }
          Extent<dim> limited = extent;
          for (unsigned int j = 0; j < sides.size(); ++j)
            if (j != i)
              limited.limits.push_back(
                {std::make_shared<ConvexShape<dim>>(
                   half_space(sides[j].point, sides[j].outward)),
                 true,
                 Extent<dim>::Along::inner});
          faces.push_back(std::make_shared<Plane>(
            Plane::plane(sides[i].point,
                         (body_inside ? 1. : -1.) * sides[i].outward,
                         limited)));
        }
  }

  template <int dim>
  PolygonShape<dim>::PolygonShape(const std::vector<Point<2>>     &vertices,
                                  const std::pair<double, double> &heights)
    : vertices(vertices)
    , heights(heights)
    , reversed(polygon_area(vertices) < 0.)
  {
    if (reversed)
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
      return std::min({value, p[2] - heights.first, heights.second - p[2]});
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
        lower[2] = heights.first;
        upper[2] = heights.second;
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
        slice.clip(Point<dim>(heights.first * up), up);
        if (!slice.empty())
          slice.clip(Point<dim>(heights.second * up), -up);
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

  template <int dim>
  std::vector<std::string>
  PolygonShape<dim>::parts() const
  {
    std::vector<std::string> names;
    for (unsigned int i = 1; i <= vertices.size(); ++i)
      names.push_back(std::to_string(i));
    if (dim == 3)
      names.insert(names.end(), {"bottom", "top"});
    return names;
  }

  template <int dim>
  void
  PolygonShape<dim>::add_faces(const std::string          &part,
                               const bool                  body_inside,
                               const Extent<dim>          &extent,
                               typename Shape<dim>::Faces &faces) const
  {
    const auto add = [&](const std::vector<Point<dim>> &corners) {
      faces.push_back(
        std::make_shared<PlaneSurface<dim>>(corners, !body_inside, extent));
    };
    const unsigned int n = vertices.size();
    if constexpr (dim == 2)
      if (part.empty())
        {
          auto line = vertices;
          line.push_back(vertices[0]);
          return add(line);
        }
    for (unsigned int i = 0; i < n; ++i)
      if (part.empty() || part == std::to_string(i + 1))
        {
          // the edge from vertex i in the order given
          const unsigned int a = reversed ? (2 * n - 2 - i) % n : i;
          const Point<2>    &x = vertices[a], &y = vertices[(a + 1) % n];
          if constexpr (dim == 2)
            add({x, y});
          else
            add({{x[0], x[1], heights.first},
                 {y[0], y[1], heights.first},
                 {y[0], y[1], heights.second},
                 {x[0], x[1], heights.second}});
        }
    if constexpr (dim == 3)
      for (const bool top : {false, true})
        if (part.empty() || part == (top ? "top" : "bottom"))
          {
            std::vector<Point<3>> outline;
            for (const auto &x : vertices)
              outline.emplace_back(x[0],
                                   x[1],
                                   top ? heights.second : heights.first);
            if (!top)
              std::reverse(outline.begin(), outline.end());
            add(outline);
          }
  }

  template class ConvexShape<2>;
  template class ConvexShape<3>;
  template class PolygonShape<2>;
  template class PolygonShape<3>;
} // namespace moraine
