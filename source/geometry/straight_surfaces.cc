// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/curved_parts.h>
#include <moraine/geometry/shapes.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using Loop = typename ConvexPolytope<dim>::PointList;

    /** A convex piece of a plane: what its ends leave of it. */
    template <int dim>
    struct Facet
    {
      struct End : HalfSpace<dim>
      {
        /** The mean normal where another facet goes on, else zero. */
        Tensor<1, dim> corner_normal;
      };

      Point<dim>       point;
      Tensor<1, dim>   normal; ///< out of the body
      std::vector<End> ends;
    };



    /** Those of a line of points, the body on the left of it or on the right.
     */
    std::vector<Facet<2>>
    make_facets(const std::vector<Point<2>> &points, const bool flip)
    {
      if (points.size() < 2)
        throw InputError("a line needs at least two points, found " +
                         std::to_string(points.size()));
      double magnitude = 0.;
      for (const auto &x : points)
        magnitude = std::max(magnitude, coordinate_magnitude<2>(x));
      std::vector<Facet<2>> facets;
      for (unsigned int i = 1; i < points.size(); ++i)
        {
          const Point<2>    &a = points[i - 1], &b = points[i];
          const Tensor<1, 2> way = (b - a) / a.distance(b);
          if (a.distance(b) <= 1e-12 * magnitude)
            throw InputError("points " + std::to_string(i) + " and " +
                             std::to_string(i + 1) +
                             " of a line are the same place");
          facets.push_back({a,
                            (flip ? -1. : 1.) * Point<2>(way[1], -way[0]),
                            {{{a, -way}, {}}, {{b, way}, {}}}});
        }
      const unsigned int n      = facets.size();
      const bool         closed = n > 1 && points.front() == points.back();
      for (unsigned int i = closed ? 0 : 1; i < n; ++i)
        {
          Facet<2>    &one = facets[(i + n - 1) % n], &next = facets[i];
          Tensor<1, 2> mean = one.normal + next.normal;
          if (mean.norm() <= 1e-10)
            mean = one.ends[1].outward;
          one.ends[1].corner_normal = next.ends[0].corner_normal =
            mean / mean.norm();
        }
      return facets;
    }



    /** Those of a plane polygon: itself if it is convex, else triangles. */
    std::vector<Facet<3>>
    make_facets(const std::vector<Point<3>> &vertices, const bool flip)
    {
      if (vertices.size() < 3)
        throw InputError("a plane patch needs at least three points, found " +
                         std::to_string(vertices.size()));
      Tensor<1, 3> normal = twice_area(vertices);
      double       size   = 0.;
      for (const auto &x : vertices)
        size = std::max(size, x.distance(vertices[0]));
      if (normal.norm() <= 1e-12 * size * size)
        throw InputError("the points of a plane patch enclose no area");
      normal /= normal.norm();
      const PlaneFrame frame(vertices[0], normal);
      Polygon          outline;
      for (const auto &x : vertices)
        {
          if (std::abs((x - vertices[0]) * normal) > 1e-9 * size)
            throw InputError("point " + std::to_string(outline.size() + 1) +
                             " of a plane patch lies off the plane of the "
                             "others");
          outline.push_back(frame.to_plane(x));
        }
      if (first_crossing(outline).first < outline.size())
        throw InputError("the edges of a plane patch cross each other");
      std::vector<Facet<3>> facets;
      for (const auto &part : convex_parts(outline))
        {
          facets.push_back({vertices[0], (flip ? -1. : 1.) * normal, {}});
          for (unsigned int i = 0; i < part.size(); ++i)
            {
              const Point<3> a = frame.to_space(part[i]),
                             b = frame.to_space(part[(i + 1) % part.size()]);
              facets.back().ends.push_back(
                {{a, cross_product_3d(b - a, normal) / a.distance(b)}, {}});
            }
        }
      return facets;
    }



    /**
     * Quadrature of a flat piece, exact for polynomials of degree
     * 2 n_gauss - 1 whatever its shape; weights are positive if it is convex.
     * Tensor product Gauss on segments and parallelograms, Witherden-Vincent
     * rules (n_gauss <= 7) on the triangles of a fan otherwise, but on those up
     * to the @p smallest area. Seen against
     * @p normal its vertices run counter-clockwise.
     */
    template <int dim>
    void
    add_loop_points(const Loop<dim>                &p,
                    const Tensor<1, dim>           &normal,
                    const double                    smallest,
                    const unsigned int              n_gauss,
                    std::vector<SurfacePoint<dim>> &out)
    {
      // points of an affine image of the reference cell at the first vertex
      const auto add = [&](const Quadrature<dim - 1>                 &rule,
                           const std::array<Tensor<1, dim>, dim - 1> &edges) {
        double jacobian;
        if constexpr (dim == 2)
          jacobian = edges[0].norm();
        else
          jacobian = cross_product_3d(edges[0], edges[1]) * normal;
        if (dim == 3 && std::abs(jacobian) <= smallest)
          return;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point<dim> x = p[0];
            for (unsigned int d = 0; d + 1 < dim; ++d)
              x += rule.point(q)[d] * edges[d];
            out.push_back({x, normal, rule.weight(q) * jacobian});
          }
      };
      const QGauss<dim - 1> gauss(n_gauss);
      if constexpr (dim == 2)
        add(gauss, {{p[1] - p[0]}});
      else
        {
          AssertThrow(n_gauss >= 1 && n_gauss <= 7,
                      ExcMessage(
                        "Plane pieces in 3D need 1 to 7 Gauss points."));
          if (p.size() == 4 && (p[0] - p[1] + (p[2] - p[3])).norm() <=
                                 1e-14 * p[0].distance(p[2]))
            return add(gauss, {{p[1] - p[0], p[3] - p[0]}});
          const QWitherdenVincentSimplex<2> rule(n_gauss);
          for (unsigned int i = 2; i < p.size(); ++i)
            add(rule, {{p[i - 1] - p[0], p[i] - p[0]}});
        }
    }



    using PlanePolygon = ConvexPolytope<2>::PointList;

    double
    area_of(const std::vector<PlanePolygon> &polygons)
    {
      double area = 0;
      for (const auto &p : polygons)
        area += polygon_area(Polygon(p.begin(), p.end()));
      return area;
    }



    /** What one set of polygons has beyond another, as polygons whose areas
     * sum up to it: clockwise ones count as negative. */
    std::vector<PlanePolygon>
    without(const std::vector<PlanePolygon> &one,
            const std::vector<PlanePolygon> &other,
            const double                     round_off)
    {
      const auto counter_clockwise = [](PlanePolygon p) {
        const bool turn = area_of({p}) < 0;
        if (turn)
          std::reverse(p.begin(), p.end());
        return std::make_pair(p, turn);
      };
      std::vector<PlanePolygon> result = one;
      for (const auto &a : one)
        for (const auto &b : other)
          {
            const auto [p, p_turned] = counter_clockwise(a);
            const auto [q, q_turned] = counter_clockwise(b);
            auto both                = ConvexPolytope<2>::polygon(p, round_off);
            for (unsigned int i = 0; i < q.size() && !both.empty(); ++i)
              both.clip(q[i], -cross_product_2d(q[(i + 1) % q.size()] - q[i]));
            if (both.empty())
              continue;
            result.emplace_back(both.vertices().begin(), both.vertices().end());
            if (p_turned == q_turned)
              std::reverse(result.back().begin(), result.back().end());
          }
      return result;
    }



    /**
     * What a straight @p shape has of a polygon in a plane on one side of it,
     * exactly: faces in the plane of what it has of a slab there. Clockwise
     * ones count as negative.
     */
    std::vector<PlanePolygon>
    parts_on_side(const Shape<3>     &shape,
                  const PlaneFrame   &frame,
                  const Tensor<1, 3> &outward,
                  const PlanePolygon &polygon,
                  const double        round_off,
                  const double        tolerance)
    {
      const auto      box  = BoundingBox<2>(polygon);
      const double    deep = 1e-2 * (box.side_length(0) + box.side_length(1));
      CellVertices<3> corners;
      for (unsigned int v = 0; v < corners.size(); ++v)
        corners[v] =
          frame.to_space(box.vertex(v & 3)) - ((v & 4) ? 0. : deep) * outward;
      if (cross_product_3d(frame.first, frame.second) * outward < 0)
        for (unsigned int v = 0; v < 4; ++v)
          std::swap(corners[v], corners[v + 4]);
      ConvexPolytope<3> slab(corners, round_off);
      for (unsigned int i = 0; i < polygon.size(); ++i)
        {
          const Tensor<1, 2> in =
            -cross_product_2d(polygon[(i + 1) % polygon.size()] - polygon[i]);
          slab.clip(frame.to_space(polygon[i]),
                    in[0] * frame.first + in[1] * frame.second);
        }
      SignedPieces<3>           pieces;
      std::vector<PlanePolygon> parts;
      shape.add_pieces(slab, 1., pieces);
      for (const auto &[sign, piece] : pieces)
        piece.for_each_face([&, sign = sign](const auto &face) {
          PlanePolygon flat;
          for (const auto &x : face)
            {
              if (std::abs((x - frame.origin) * outward) > tolerance)
                return;
              flat.push_back(frame.to_plane(x));
            }
          if (twice_area(face) * outward <= 0)
            return;
          if ((area_of({flat}) < 0) != (sign < 0))
            std::reverse(flat.begin(), flat.end());
          parts.push_back(flat);
        });
      return parts;
    }



    /** What a straight shape has of a polygon in a plane on either side of it;
     * see parts_on_side(). */
    std::vector<PlanePolygon>
    parts_beside(const Shape<3>     &shape,
                 const PlaneFrame   &frame,
                 const Tensor<1, 3> &normal,
                 const PlanePolygon &polygon,
                 const double        round_off,
                 const double        tolerance)
    {
      auto parts =
        parts_on_side(shape, frame, normal, polygon, round_off, tolerance);
      if (area_of(parts) > (1 - 1e-12) * area_of({polygon}))
        return parts;
      const auto more = without(
        parts_on_side(shape, frame, -normal, polygon, round_off, tolerance),
        parts,
        round_off);
      parts.insert(parts.end(), more.begin(), more.end());
      return parts;
    }



    /** Whether a polygon in a plane can be cut by parts_beside(): by a straight
     * shape that leaves no gap. */
    bool
    is_cut_exactly(const Extent<3>    &extent,
                   const PlaneFrame   &frame,
                   const Tensor<1, 3> &normal,
                   const PlanePolygon &polygon,
                   const double        tolerance)
    {
      if (extent.limits.size() != 1 ||
          extent.limits[0].along != Extent<3>::Along::beside ||
          !extent.limits[0].shape->is_straight())
        return false;
      Extent<3> without_reach       = extent;
      without_reach.limits[0].reach = 0;
      Point<2> middle;
      for (const auto &p : polygon)
        middle += p / double(polygon.size());
      for (unsigned int i = 0; i < polygon.size(); ++i)
        for (const double toward : {0., 0.5, 0.9, 0.999})
          for (const double along : {0., 0.5})
            {
              const Point<2> end =
                polygon[i] +
                along * (polygon[(i + 1) % polygon.size()] - polygon[i]);
              const Point<3> x =
                frame.to_space(middle + toward * (end - middle));
              if ((extent.value(x, normal, tolerance) > 0) !=
                  (without_reach.value(x, normal, tolerance) > 0))
                return false;
            }
      return true;
    }



    /** The parts of a flat piece within an extent; clockwise ones count as
     * negative. */
    template <int dim>
    std::vector<Loop<dim>>
    parts_within(const Extent<dim>    &extent,
                 const Loop<dim>      &piece,
                 const Tensor<1, dim> &normal,
                 const double          round_off,
                 const double          tolerance)
    {
      if (extent.limits.empty())
        return {piece};
      std::vector<Loop<dim>> parts;
      if constexpr (dim == 2)
        {
          const Tensor<1, 2> way = piece[1] - piece[0];
          for (const auto &[from, to] :
               extent.stretches({0., 1.}, tolerance, [&](const double s) {
                 return std::make_pair(Point<2>(piece[0] + s * way), normal);
               }))
            {
              parts.push_back(piece);
              parts.back()[0] = piece[0] + from * way;
              parts.back()[1] = piece[0] + to * way;
            }
        }
      else
        {
          const PlaneFrame frame(piece[0], normal);
          PlanePolygon     polygon;
          SignedPieces<2>  flat;
          const auto       add = [&](const auto &part) {
            parts.emplace_back();
            for (const Point<2> &p : part)
              parts.back().push_back(frame.to_space(p));
          };
          for (const auto &x : piece)
            polygon.push_back(frame.to_plane(x));
          if (is_cut_exactly(extent, frame, normal, polygon, tolerance))
            {
              for (const auto &part :
                   parts_beside(*extent.limits[0].shape,
                                frame,
                                normal,
                                polygon,
                                round_off,
                                std::max(tolerance, round_off)))
                add(part);
              return parts;
            }
          add_curved_pieces<2>(
            [&](const Point<2> &p) {
              return extent.value(frame.to_space(p), normal, tolerance);
            },
            false,
            ConvexPolytope<2>::polygon(polygon, round_off),
            1.,
            flat);
          for (const auto &part : flat)
            add(part.polytope.vertices());
        }
      return parts;
    }



    /** One or more facets with their limits. */
    template <int dim>
    class FlatFace : public Surface<dim>
    {
    public:
      FlatFace(const std::vector<Facet<dim>> &facets,
               const BoundingBox<dim>        &box,
               const Extent<dim>             &extent)
        : Surface<dim>(intersection(box, extent.box), false)
        , facets(facets)
        , extent(extent)
      {
        for (const auto &facet : facets)
          {
            magnitude = std::max(magnitude, coordinate_magnitude(facet.point));
            for (const auto &end : facet.ends)
              magnitude = std::max(magnitude, coordinate_magnitude(end.point));
          }
      }

      /** That of the nearest facet. */
      NearestPoint<dim>
      nearest(const Point<dim> &x, const double) const override
      {
        const Facet<dim>               *facet   = &facets[0];
        const typename Facet<dim>::End *end     = nullptr;
        double                          nearest = infinity, beyond = -infinity;
        for (const auto &candidate : facets)
          {
            double                          last     = -infinity;
            const typename Facet<dim>::End *last_end = nullptr;
            for (const auto &e : candidate.ends)
              if ((x - e.point) * e.outward > last)
                {
                  last     = (x - e.point) * e.outward;
                  last_end = &e;
                }
            const double level  = (x - candidate.point) * candidate.normal;
            const double over   = std::max(last, 0.);
            const double square = level * level + over * over;
            if (square < nearest)
              {
                facet   = &candidate;
                end     = last_end;
                nearest = square;
                beyond  = last;
              }
          }
        NearestPoint<dim> point{-((x - facet->point) * facet->normal),
                                facet->normal,
                                true};
        if (beyond > 1e-10 * magnitude)
          {
            point.in_extent = end->corner_normal.norm_square() > 0.;
            // at a corner the mean normal tells inside from outside
            if (point.in_extent)
              {
                point.normal = end->corner_normal;
                point.level  = -std::copysign(std::sqrt(nearest),
                                             (x - end->point) * point.normal);
              }
          }
        point.in_extent =
          point.in_extent &&
          extent.contains(x + point.level * point.normal, point.normal);
        return point;
      }

      /**
       * Neighbours agree on what is theirs, as all is decided by distances of
       * vertices that they share. Vertices nearer to the plane than 2^-44 of
       * the coordinates' size are on it and count as outside the body.
       */
      void
      pieces(const CellVertices<dim>        &cell,
             const unsigned int              n_gauss,
             std::vector<SurfacePoint<dim>> &out) const override
      {
        if (!this->may_touch(cell))
          return;
        const double size  = cell_size<dim>(cell);
        double       scale = std::max(magnitude, size);
        for (const auto &x : cell)
          scale = std::max(scale, coordinate_magnitude(x));
        const double tolerance = std::ldexp(scale, -44);
        for (const auto &facet : facets)
          {
            const unsigned int n_in =
              std::count_if(cell.begin(), cell.end(), [&](const auto &x) {
                return (facet.point - x) * facet.normal > tolerance;
              });
            if (n_in == 0 || n_in == cell.size())
              continue;
            ConvexPolytope<dim> part(cell, tolerance, false);
            for (const auto &end : facet.ends)
              part.clip(end.point, -end.outward);
            std::vector<Loop<dim>> cut;
            part.clip(facet.point, -facet.normal, &cut);
            for (const auto &loop : cut)
              for (const auto &p : parts_within<dim>(
                     extent, loop, facet.normal, tolerance, 1e-9 * size))
                add_loop_points<dim>(
                  p, facet.normal, 1e-15 * size * size, n_gauss, out);
          }
      }

      SurfacePointer<dim>
      within(const Extent<dim> &other) const override
      {
        return std::make_shared<FlatFace>(facets,
                                          this->box,
                                          extent.and_within(other));
      }

    private:
      static constexpr double infinity =
        std::numeric_limits<double>::infinity();

      std::vector<Facet<dim>> facets;
      Extent<dim>             extent;
      double                  magnitude = 0.; ///< of the coordinates
    };
  } // namespace



  template <int dim>
  SurfacePointer<dim>
  make_plane(const HalfSpace<dim>              &body,
             const Extent<dim>                 &extent,
             const std::vector<HalfSpace<dim>> &ends)
  {
    Facet<dim> facet{body.point, body.outward, {}};
    for (const auto &end : ends)
      facet.ends.push_back({end, {}});
    return std::make_shared<FlatFace<dim>>(std::vector<Facet<dim>>{facet},
                                           unlimited_box<dim>(),
                                           extent);
  }



  template <int dim>
  SurfacePointer<dim>
  make_flat_face(const std::vector<Point<dim>> &corners,
                 const bool                     flip,
                 const Extent<dim>             &extent)
  {
    return std::make_shared<FlatFace<dim>>(make_facets(corners, flip),
                                           BoundingBox<dim>(corners),
                                           extent);
  }



#define INSTANTIATE(dim)                                  \
  template decltype(make_plane<dim>)     make_plane<dim>; \
  template decltype(make_flat_face<dim>) make_flat_face<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
