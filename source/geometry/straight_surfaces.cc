// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/cell_cut.h>
#include <moraine/geometry/curve_subdivision.h>
#include <moraine/geometry/polygon.h>
#include <moraine/geometry/surfaces.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

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



    /** A flat face with its limits. */
    template <int dim>
    class FlatFace : public Surface<dim>
    {
    protected:
      FlatFace(const BoundingBox<dim> &box,
               const double            magnitude,
               const Extent<dim>      &extent)
        : Surface<dim>(intersection(box, extent.box), false)
        , magnitude(magnitude)
        , extent(extent)
      {}

      double      magnitude; ///< of the coordinates
      Extent<dim> extent;
    };



    /** Gauss points between two abscissae of a straight line. */
    void
    add_segment_points(const Point<2>               &origin,
                       const Tensor<1, 2>           &direction,
                       const Stretch                &stretch,
                       const Tensor<1, 2>           &normal,
                       const unsigned int            n_gauss,
                       std::vector<SurfacePoint<2>> &out)
    {
      const QGauss<1> gauss(n_gauss);
      const double    length = stretch.to - stretch.from;
      for (unsigned int q = 0; q < gauss.size(); ++q)
        out.push_back(
          {origin + (stretch.from + gauss.point(q)[0] * length) * direction,
           normal,
           gauss.weight(q) * length});
    }



    class Polyline : public FlatFace<2>
    {
    public:
      Polyline(const std::vector<Point<2>> &points,
               const bool                   flip,
               const Extent<2>             &extent)
        : FlatFace<2>(BoundingBox<2>(points),
                      largest_magnitude<2>(points),
                      extent)
        , closed(points.size() > 2 && points.front() == points.back())
      {
        if (points.size() < 2)
          throw InputError("a line needs at least two points, found " +
                           std::to_string(points.size()));
        for (unsigned int i = 1; i < points.size(); ++i)
          {
            const Tensor<1, 2> way    = points[i] - points[i - 1];
            const double       length = way.norm();
            if (length <= 1e-12 * magnitude)
              throw InputError("points " + std::to_string(i) + " and " +
                               std::to_string(i + 1) +
                               " of a line are the same place");
            const Tensor<1, 2> right =
              (flip ? -1. : 1.) / length * Point<2>(way[1], -way[0]);
            segments.push_back(
              {points[i - 1], way / length, right, 0., length});
          }
      }

      Polyline(const Point<2>     &point,
               const Tensor<1, 2> &n,
               const Extent<2>    &extent)
        : FlatFace<2>(unlimited_box<2>(),
                      coordinate_magnitude<2>(point),
                      extent)
        , closed(false)
      {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        segments.push_back(
          {point, Point<2>(-n[1], n[0]), n, -infinity, infinity});
      }

      NearestPoint<2>
      nearest(const Point<2> &x) const override
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
                const auto &other =
                  segments[(best + (at_start ? n - 1 : 1)) % n];
                const Point<2> corner =
                  s.start + (at_start ? s.from : s.to) * s.direction;
                point.normal = s.normal + other.normal;
                if (point.normal.norm() <= 1e-10)
                  point.normal = (at_start ? -1. : 1.) * s.direction;
                point.normal /= point.normal.norm();
                point.level =
                  -std::copysign(distance, (x - corner) * point.normal);
              }
          }
        point.in_extent =
          point.in_extent &&
          extent.contains(x + point.level * point.normal, point.normal);
        return point;
      }

      void
      pieces(const CellVertices<2>        &cell,
             const unsigned int            n_gauss,
             std::vector<SurfacePoint<2>> &out) const override
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
                  for (const Stretch &part : extent.stretches(
                         piece, 1e-9 * size, [&](const double a) {
                           return std::make_pair(Point<2>(s.start +
                                                          a * s.direction),
                                                 s.normal);
                         }))
                    add_segment_points(
                      s.start, s.direction, part, s.normal, n_gauss, out);
              }
          }
      }

    private:
      struct Segment
      {
        Point<2>     start;
        Tensor<1, 2> direction;
        Tensor<1, 2> normal;
        double       from; ///< abscissa of its first point
        double       to;
      };

      std::vector<Segment> segments;
      bool                 closed;
    };



    /** A plane's own coordinates in 3D; first x second = normal. */
    struct PlaneFrame
    {
      PlaneFrame(const Point<3> &origin, const Tensor<1, 3> &n)
        : origin(origin)
        , normal(n / n.norm())
      {
        unsigned int smallest = 0;
        for (unsigned int d = 1; d < 3; ++d)
          if (std::abs(normal[d]) < std::abs(normal[smallest]))
            smallest = d;
        first = Point<3>::unit_vector(smallest);
        first -= (first * normal) * normal;
        first /= first.norm();
        second = cross_product_3d(normal, first);
      }

      Point<2>
      to_plane(const Point<3> &x) const
      {
        return {(x - origin) * first, (x - origin) * second};
      }

      Polygon
      to_plane(const std::vector<Point<3>> &points) const
      {
        Polygon polygon;
        for (const auto &x : points)
          polygon.push_back(to_plane(x));
        return polygon;
      }

      Point<3>
      to_space(const Point<2> &p) const
      {
        return origin + p[0] * first + p[1] * second;
      }

      Point<3>     origin;
      Tensor<1, 3> normal, first, second;
    };



    /** Without vertices that repeat, to 1e-15 of the size. */
    Polygon
    without_repeats(const Polygon &polygon, const double size)
    {
      Polygon result;
      for (const auto &p : polygon)
        if (result.empty() || p.distance(result.back()) > 1e-15 * size)
          result.push_back(p);
      while (result.size() > 1 &&
             result.back().distance(result.front()) <= 1e-15 * size)
        result.pop_back();
      return result;
    }



    /** Points of the affine image of a reference cell at @p o with edges a, b.
     */
    void
    add_affine_points(const Quadrature<2>          &rule,
                      const Point<2>               &o,
                      const Tensor<1, 2>           &a,
                      const Tensor<1, 2>           &b,
                      const PlaneFrame             &frame,
                      const Tensor<1, 3>           &normal,
                      std::vector<SurfacePoint<3>> &out)
    {
      const double jacobian = cross(a, b);
      for (unsigned int q = 0; q < rule.size(); ++q)
        out.push_back(
          {frame.to_space(o + rule.point(q)[0] * a + rule.point(q)[1] * b),
           normal,
           rule.weight(q) * jacobian});
    }



    /**
     * Quadrature of a polygon in the plane of @p frame, exact for polynomials
     * of degree 2 n_gauss - 1 whatever its shape; weights are positive if it is
     * convex. Tensor product Gauss on parallelograms, Witherden-Vincent rules
     * (n_gauss <= 7) on the triangles of a fan otherwise. @p normal is what the
     * points carry.
     */
    void
    add_polygon_points(const Polygon                &polygon,
                       const PlaneFrame             &frame,
                       const Tensor<1, 3>           &normal,
                       const unsigned int            n_gauss,
                       std::vector<SurfacePoint<3>> &out)
    {
      AssertThrow(n_gauss >= 1 && n_gauss <= 7,
                  ExcMessage("Plane pieces in 3D need 1 to 7 Gauss points."));
      double size = 0.;
      for (const auto &p : polygon)
        size = std::max(size, p.distance(polygon[0]));
      auto p = without_repeats(polygon, size);
      if (polygon_area(p) < 0.)
        std::reverse(p.begin(), p.end());
      if (polygon_area(p) <= 1e-15 * size * size)
        return;
      if (p.size() == 4 && (p[0] - p[1] + (p[2] - p[3])).norm() <= 1e-14 * size)
        {
          add_affine_points(QGauss<2>(n_gauss),
                            p[0],
                            p[1] - p[0],
                            p[3] - p[0],
                            frame,
                            normal,
                            out);
          return;
        }
      const QWitherdenVincentSimplex<2> rule(n_gauss);
      for (unsigned int i = 2; i < p.size(); ++i)
        add_affine_points(
          rule, p[0], p[i - 1] - p[0], p[i] - p[0], frame, normal, out);
    }



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



    class PlanePatch : public FlatFace<3>
    {
    public:
      PlanePatch(const std::vector<Point<3>> &vertices,
                 const bool                   flip,
                 const Extent<3>             &extent)
        : FlatFace<3>(BoundingBox<3>(vertices),
                      largest_magnitude<3>(vertices),
                      extent)
        , frame(frame_of(vertices))
        , unit_normal((flip ? -1. : 1.) * frame.normal)
      {
        const Polygon outline = frame.to_plane(vertices);
        if (first_crossing(outline).first < outline.size())
          throw InputError("the edges of a plane patch cross each other");
        if (is_convex(outline))
          convex_parts.push_back(outline);
        else
          convex_parts = triangulate(outline);
      }

      PlanePatch(const Point<3>     &point,
                 const Tensor<1, 3> &normal,
                 const Extent<3>    &extent)
        : FlatFace<3>(unlimited_box<3>(),
                      coordinate_magnitude<3>(point),
                      extent)
        , frame(point, normal)
        , unit_normal(normal)
      {}

      NearestPoint<3>
      nearest(const Point<3> &x) const override
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
      pieces(const CellVertices<3>        &cell,
             const unsigned int            n_gauss,
             std::vector<SurfacePoint<3>> &out) const override
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

    private:
      /** Append points of what of a polygon lies within the extent. */
      void
      add_points(const Polygon                &polygon,
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

      PlaneFrame           frame;
      Tensor<1, 3>         unit_normal;
      std::vector<Polygon> convex_parts; ///< none: the whole plane
    };



    template <int dim>
    using Flat = std::conditional_t<dim == 2, Polyline, PlanePatch>;
  } // namespace



  template <int dim>
  SurfacePointer<dim>
  make_plane(const Point<dim>     &point,
             const Tensor<1, dim> &normal,
             const Extent<dim>    &extent)
  {
    if (!(normal.norm() > 0.))
      throw InputError("the normal of a plane must not be zero");
    return std::make_shared<Flat<dim>>(point, normal / normal.norm(), extent);
  }



  template <int dim>
  SurfacePointer<dim>
  make_flat_face(const std::vector<Point<dim>> &corners,
                 const bool                     flip,
                 const Extent<dim>             &extent)
  {
    return std::make_shared<Flat<dim>>(corners, flip, extent);
  }



#define INSTANTIATE(dim)                                                       \
  template SurfacePointer<dim> make_plane(const Point<dim> &,                  \
                                          const Tensor<1, dim> &,              \
                                          const Extent<dim> &);                \
  template SurfacePointer<dim> make_flat_face(const std::vector<Point<dim>> &, \
                                              const bool,                      \
                                              const Extent<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
