// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/straight_surfaces.h>
#include <moraine/core/exceptions.h>

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
  } // namespace

  Polyline::Polyline(const std::vector<Point<2>> &points, const bool flip)
    : closed(points.size() > 2 && points.front() == points.back())
    , box(points)
    , magnitude(largest_magnitude<2>(points))
  {
    if (points.size() < 2)
      throw InputError("a line needs at least two points, found " +
                       std::to_string(points.size()));
    for (unsigned int i = 1; i < points.size(); ++i)
      {
        Segment segment;
        segment.start     = points[i - 1];
        segment.direction = points[i] - points[i - 1];
        segment.length    = segment.direction.norm();
        if (segment.length <= 1e-12 * magnitude)
          throw InputError("points " + std::to_string(i) + " and " +
                           std::to_string(i + 1) +
                           " of a line are the same place");
        segment.direction /= segment.length;
        segment.normal[0] = segment.direction[1];
        segment.normal[1] = -segment.direction[0];
        if (flip)
          segment.normal *= -1.;
        segments.push_back(segment);
      }
  }

  Polyline::Foot
  Polyline::nearest(const Point<2> &x) const
  {
    unsigned int best     = 0;
    double       distance = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < segments.size(); ++i)
      {
        const auto  &s = segments[i];
        const double abscissa =
          std::clamp((x - s.start) * s.direction, 0., s.length);
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
    const double       tolerance = 1e-10 * s.length;
    Foot               foot{&s, -((x - s.start) * s.normal), s.normal, false};
    if (abscissa < -tolerance || abscissa > s.length + tolerance)
      {
        const bool at_start = abscissa < 0.;
        if (!closed && best == (at_start ? 0 : n - 1))
          foot.beyond_end = true;
        else
          {
            // at a corner the mean normal tells inside from outside
            const auto &other = segments[(best + (at_start ? n - 1 : 1)) % n];
            const Point<2> corner =
              at_start ? s.start : s.start + s.length * s.direction;
            foot.normal = s.normal + other.normal;
            if (foot.normal.norm() <= 1e-10)
              foot.normal = (at_start ? -1. : 1.) * s.direction;
            foot.normal /= foot.normal.norm();
            foot.distance =
              -std::copysign(distance, (x - corner) * foot.normal);
          }
      }
    return foot;
  }

  double
  Polyline::level(const Point<2> &x) const
  {
    return nearest(x).distance;
  }

  Tensor<1, 2>
  Polyline::normal(const Point<2> &x) const
  {
    return nearest(x).normal;
  }

  bool
  Polyline::in_extent(const Point<2> &x) const
  {
    return !nearest(x).beyond_end;
  }

  void
  Polyline::pieces(const CellVertices<2>        &cell,
                   const unsigned int            n_gauss,
                   std::vector<SurfacePoint<2>> &out) const
  {
    if (!may_touch<2>(cell, box))
      return;
    for (const auto &s : segments)
      {
        std::array<double, 4> distance;
        for (unsigned int v = 0; v < cell.size(); ++v)
          distance[v] = -((cell[v] - s.start) * s.normal);
        for (const auto &chord : cut_cell<2>(cell, distance, magnitude))
          {
            double from = (chord[0] - s.start) * s.direction,
                   to   = (chord[1] - s.start) * s.direction;
            if (from > to)
              std::swap(from, to);
            from = std::max(from, 0.);
            to   = std::min(to, s.length);
            // round-off at a corner of the cell is not a piece
            if (to - from > 1e-15 * std::max(s.length, magnitude))
              add_segment_points<2>(
                s.start, s.direction, from, to, s.normal, n_gauss, out);
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

  template <int dim>
  Plane<dim>::Plane(const Point<dim> &point, const Tensor<1, dim> &normal)
    : point(point)
    , magnitude(coordinate_magnitude<dim>(point))
  {
    const double length = normal.norm();
    if (!(length > 0.))
      throw InputError("the normal of a plane must not be zero");
    unit_normal = normal / length;
  }

  template <int dim>
  double
  Plane<dim>::level(const Point<dim> &x) const
  {
    return -((x - point) * unit_normal);
  }

  template <int dim>
  Tensor<1, dim>
  Plane<dim>::normal(const Point<dim> &) const
  {
    return unit_normal;
  }

  template <int dim>
  bool
  Plane<dim>::in_extent(const Point<dim> &) const
  {
    return true;
  }

  template <int dim>
  void
  Plane<dim>::pieces(const CellVertices<dim>        &cell,
                     const unsigned int              n_gauss,
                     std::vector<SurfacePoint<dim>> &out) const
  {
    std::array<double, (1 << dim)> distance;
    for (unsigned int v = 0; v < cell.size(); ++v)
      distance[v] = level(cell[v]);
    for (const auto &cut : cut_cell<dim>(cell, distance, magnitude))
      if constexpr (dim == 2)
        {
          const Tensor<1, 2> chord  = cut[1] - cut[0];
          const double       length = chord.norm();
          if (length > 1e-15 * std::max(magnitude, cell_size<dim>(cell)))
            add_segment_points<2>(
              cut[0], chord / length, 0., length, unit_normal, n_gauss, out);
        }
      else
        {
          const PlaneFrame frame(point, unit_normal);
          add_polygon_points(
            frame.to_plane(cut), frame, unit_normal, n_gauss, out);
        }
  }

  template <int dim>
  BoundingBox<dim>
  Plane<dim>::bounding_box() const
  {
    return unlimited_box<dim>();
  }

  template <int dim>
  bool
  Plane<dim>::curved() const
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

  PlanePatch::PlanePatch(const std::vector<Point<3>> &vertices, const bool flip)
    : frame(frame_of(vertices))
    , unit_normal((flip ? -1. : 1.) * frame.normal)
    , box(vertices)
    , magnitude(largest_magnitude<3>(vertices))
  {
    const Polygon outline = frame.to_plane(vertices);
    if (edges_cross(outline))
      throw InputError("the edges of a plane patch cross each other");
    if (is_convex(outline))
      convex_parts.push_back(outline);
    else
      convex_parts = triangulate(outline);
  }

  double
  PlanePatch::level(const Point<3> &x) const
  {
    return -((x - frame.origin) * unit_normal);
  }

  Tensor<1, 3>
  PlanePatch::normal(const Point<3> &) const
  {
    return unit_normal;
  }

  bool
  PlanePatch::in_extent(const Point<3> &x) const
  {
    const Point<2> p = frame.to_plane(x);
    for (const auto &part : convex_parts)
      {
        bool inside = true;
        for (unsigned int i = 0; i < part.size() && inside; ++i)
          {
            const Tensor<1, 2> edge = part[(i + 1) % part.size()] - part[i];
            inside = cross(edge, p - part[i]) >= -1e-10 * edge.norm_square();
          }
        if (inside)
          return true;
      }
    return false;
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
      distance[v] = level(cell[v]);
    for (const auto &cut : cut_cell<3>(cell, distance, magnitude))
      {
        const Polygon polygon = frame.to_plane(cut);
        for (const auto &part : convex_parts)
          {
            const auto piece = clip_polygon(polygon, part);
            if (piece.size() >= 3)
              add_polygon_points(piece, frame, unit_normal, n_gauss, out);
          }
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

  template class Plane<2>;
  template class Plane<3>;
} // namespace moraine
