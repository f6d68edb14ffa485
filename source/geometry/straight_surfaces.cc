// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/straight_surfaces.h>
#include <moraine/core/exceptions.h>
#include <moraine/geometry/curve_subdivision.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    largest_magnitude(const std::vector<Point<dim>> &points)
    {
      double magnitude = 0.;
      for (const auto &p : points)
        magnitude = std::max(magnitude, coordinate_magnitude<dim>(p));
      return magnitude;
    }

    template <int dim>
    Tensor<1, dim>
    unit_normal_of_plane(const Tensor<1, dim> &normal)
    {
      if (!(normal.norm() > 0.))
        throw InputError("the normal of a plane must not be zero");
      return normal / normal.norm();
    }
  } // namespace

  Polyline::Polyline(const BoundingBox<2> &box,
                     const double          magnitude,
                     const Extent<2>      &extent)
    : box(box)
    , magnitude(magnitude)
    , extent(extent)
  {}

  Polyline::Polyline(const std::vector<Point<2>> &points,
                     const bool                   flip,
                     const Extent<2>             &extent)
    : Polyline(BoundingBox<2>(points), largest_magnitude<2>(points), extent)
  {
    closed = points.size() > 2 && points.front() == points.back();
    if (points.size() < 2)
      throw InputError("a line needs at least two points, found " +
                       std::to_string(points.size()));
    for (unsigned int i = 1; i < points.size(); ++i)
      {
        Segment segment;
        segment.start     = points[i - 1];
        segment.direction = points[i] - points[i - 1];
        segment.from      = 0.;
        segment.to        = segment.direction.norm();
        if (segment.to <= 1e-12 * magnitude)
          throw InputError("points " + std::to_string(i) + " and " +
                           std::to_string(i + 1) +
                           " of a line are the same place");
        segment.direction /= segment.to;
        segment.normal[0] = segment.direction[1];
        segment.normal[1] = -segment.direction[0];
        if (flip)
          segment.normal *= -1.;
        segments.push_back(segment);
      }
  }

  Polyline
  Polyline::plane(const Point<2>     &point,
                  const Tensor<1, 2> &normal,
                  const Extent<2>    &extent)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Polyline line(unlimited_box<2>(), coordinate_magnitude<2>(point), extent);
    const Tensor<1, 2> n = unit_normal_of_plane<2>(normal);
    line.segments.push_back(
      {point, Point<2>(-n[1], n[0]), n, -infinity, infinity});
    return line;
  }

  NearestPoint<2>
  Polyline::nearest(const Point<2> &x) const
  {
    unsigned int best     = 0;
    double       distance = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < segments.size(); ++i)
      {
        const auto  &s = segments[i];
        const double abscissa =
          std::clamp((x - s.start) * s.direction, s.from, s.to);
        const double d = x.distance(s.start + abscissa * s.direction);
        if (d < distance)
          {
            distance = d;
            best     = i;
          }
      }
    const auto        &s         = segments[best];
    const unsigned int n         = segments.size();
    const double       abscissa  = (x - s.start) * s.direction;
    const double       tolerance = 1e-10 * (s.to - s.from);
    NearestPoint<2>    point{-((x - s.start) * s.normal), s.normal, true};
    if (abscissa < s.from - tolerance || abscissa > s.to + tolerance)
      {
        const bool at_start = abscissa < s.from;
        if (!closed && best == (at_start ? 0 : n - 1))
          point.in_extent = false;
        else
          {
            // at a corner the mean normal tells inside from outside
            const auto &other = segments[(best + (at_start ? n - 1 : 1)) % n];
            const Point<2> corner =
              s.start + (at_start ? s.from : s.to) * s.direction;
            point.normal = s.normal + other.normal;
            if (point.normal.norm() <= 1e-10)
              point.normal = (at_start ? -1. : 1.) * s.direction;
            point.normal /= point.normal.norm();
            point.level = -std::copysign(distance, (x - corner) * point.normal);
          }
      }
    point.in_extent =
      point.in_extent &&
      extent.contains(x + point.level * point.normal, point.normal);
    return point;
  }

  void
  Polyline::pieces(const CellVertices<2>        &cell,
                   const unsigned int            n_gauss,
                   std::vector<SurfacePoint<2>> &out) const
  {
    if (!may_touch<2>(cell, box))
      return;
    const double size = cell_size<2>(cell);
    for (const auto &s : segments)
      {
        std::array<double, 4> distance;
        for (unsigned int v = 0; v < cell.size(); ++v)
          distance[v] = -((cell[v] - s.start) * s.normal);
        for (const auto &chord : cut_cell<2>(cell, distance, magnitude))
          {
            const double a = (chord[0] - s.start) * s.direction,
                         b = (chord[1] - s.start) * s.direction;
            // round-off at a corner of the cell is not a piece
            const Stretch piece{std::max(std::min(a, b), s.from),
                                std::min(std::max(a, b), s.to)};
            if (piece.to - piece.from > 1e-15 * std::max(size, magnitude))
              for (const Stretch &part :
                   extent.stretches(piece, 1e-9 * size, [&](const double a) {
                     return std::make_pair(Point<2>(s.start + a * s.direction),
                                           s.normal);
                   }))
                add_segment_points<2>(
                  s.start, s.direction, part, s.normal, n_gauss, out);
          }
      }
  }

  BoundingBox<2>
  Polyline::bounding_box() const
  {
    return box;
  }

  bool
  Polyline::curved() const
  {
    return false;
  }

  namespace
  {
    PlaneFrame
    frame_of(const std::vector<Point<3>> &vertices)
    {
      if (vertices.size() < 3)
        throw InputError("a plane patch needs at least three points, found " +
                         std::to_string(vertices.size()));
      Tensor<1, 3> normal;
      double       size = 0.;
      for (unsigned int i = 1; i < vertices.size(); ++i)
        {
          size = std::max(size, vertices[i].distance(vertices[0]));
          normal += cross_product_3d(vertices[i - 1] - vertices[0],
                                     static_cast<Tensor<1, 3>>(vertices[i] -
                                                               vertices[0]));
        }
      if (normal.norm() <= 1e-12 * size * size)
        throw InputError("the points of a plane patch enclose no area");
      const PlaneFrame frame(vertices[0], normal);
      for (unsigned int i = 0; i < vertices.size(); ++i)
        if (std::abs((vertices[i] - vertices[0]) * frame.normal) > 1e-9 * size)
          throw InputError(
            "point " + std::to_string(i + 1) +
            " of a plane patch lies off the plane of the others");
      return frame;
    }
  } // namespace

  PlanePatch::PlanePatch(const PlaneFrame     &frame,
                         const Tensor<1, 3>   &unit_normal,
                         const BoundingBox<3> &box,
                         const double          magnitude,
                         const Extent<3>      &extent)
    : frame(frame)
    , unit_normal(unit_normal)
    , box(box)
    , magnitude(magnitude)
    , extent(extent)
  {}

  PlanePatch::PlanePatch(const std::vector<Point<3>> &vertices,
                         const bool                   flip,
                         const Extent<3>             &extent)
    : PlanePatch(frame_of(vertices),
                 {},
                 BoundingBox<3>(vertices),
                 largest_magnitude<3>(vertices),
                 extent)
  {
    unit_normal           = (flip ? -1. : 1.) * frame.normal;
    const Polygon outline = frame.to_plane(vertices);
    if (edges_cross(outline))
      throw InputError("the edges of a plane patch cross each other");
    if (is_convex(outline))
      convex_parts.push_back(outline);
    else
      convex_parts = triangulate(outline);
  }

  PlanePatch
  PlanePatch::plane(const Point<3>     &point,
                    const Tensor<1, 3> &normal,
                    const Extent<3>    &extent)
  {
    const Tensor<1, 3> n = unit_normal_of_plane<3>(normal);
    return {PlaneFrame(point, n),
            n,
            unlimited_box<3>(),
            coordinate_magnitude<3>(point),
            extent};
  }

  NearestPoint<3>
  PlanePatch::nearest(const Point<3> &x) const
  {
    const double   level     = -((x - frame.origin) * unit_normal);
    const Point<2> p         = frame.to_plane(x);
    const auto     is_inside = [&p](const Polygon &part) {
      for (unsigned int i = 0; i < part.size(); ++i)
        {
          const Tensor<1, 2> edge = part[(i + 1) % part.size()] - part[i];
          if (cross(edge, p - part[i]) < -1e-10 * edge.norm_square())
            return false;
        }
      return true;
    };
    return {level,
            unit_normal,
            (convex_parts.empty() || std::any_of(convex_parts.begin(),
                                                 convex_parts.end(),
                                                 is_inside)) &&
              extent.contains(x + level * unit_normal, unit_normal)};
  }

  void
  PlanePatch::pieces(const CellVertices<3>        &cell,
                     const unsigned int            n_gauss,
                     std::vector<SurfacePoint<3>> &out) const
  {
    if (!may_touch<3>(cell, box))
      return;
    std::array<double, 8> distance;
    for (unsigned int v = 0; v < cell.size(); ++v)
      distance[v] = -((cell[v] - frame.origin) * unit_normal);
    const double tolerance = 1e-9 * cell_size<3>(cell);
    for (const auto &cut : cut_cell<3>(cell, distance, magnitude))
      {
        const Polygon polygon = frame.to_plane(cut);
        if (convex_parts.empty())
          add_points(polygon, tolerance, n_gauss, out);
        for (const auto &part : convex_parts)
          add_points(clip_polygon(polygon, part), tolerance, n_gauss, out);
      }
  }

  void
  PlanePatch::add_points(const Polygon                &polygon,
                         const double                  tolerance,
                         const unsigned int            n_gauss,
                         std::vector<SurfacePoint<3>> &out) const
  {
    if (polygon.size() < 3)
      return;
    if (extent.limits.empty())
      {
        add_polygon_points(polygon, frame, unit_normal, n_gauss, out);
        return;
      }
    const auto corners = BoundingBox<2>(polygon).get_boundary_points();
    std::vector<SignedPiece<2>> pieces;
    add_curved_pieces<2>(
      [&](const Point<2> &p) {
        return extent.value(frame.to_space(p), unit_normal, tolerance);
      },
      false,
      ConvexPolytope<2>(corners.first, corners.second),
      1.,
      pieces);
    for (const auto &piece : pieces)
      {
        const auto   &outline = piece.polytope.vertices();
        const Polygon part =
          clip_polygon(polygon, Polygon(outline.begin(), outline.end()));
        if (part.size() >= 3)
          add_polygon_points(part, frame, unit_normal, n_gauss, out);
      }
  }

  BoundingBox<3>
  PlanePatch::bounding_box() const
  {
    return box;
  }

  bool
  PlanePatch::curved() const
  {
    return false;
  }
} // namespace moraine
