// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shapes.h>

#include <moraine/geometry/polygon.h>
#include <moraine/geometry/surfaces.h>

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



    /** The intersection of half spaces; one of them if it has no limits. */
    template <int dim>
    class ConvexShape : public Shape<dim>
    {
    public:
      /**
       * @p bounding_box must hold the intersection of @p sides. @p names are
       * those of the sides, or none.
       */
      ConvexShape(const std::vector<HalfSpace<dim>> &sides,
                  const BoundingBox<dim> &bounding_box  = unlimited_box<dim>(),
                  const std::vector<std::string> &names = {})
        : Shape<dim>(bounding_box, true, names)
        , sides(sides)
      {}

      double
      level(const Point<dim> &p) const override
      {
        double value = std::numeric_limits<double>::infinity();
        for (const auto &side : sides)
          value = std::min(value, side.outward * (side.point - p));
        return value;
      }

      Overlap
      overlap(const ConvexPolytope<dim> &cell) const override
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

      typename Shape<dim>::Faces
      faces(const std::string &part,
            const bool         body_inside,
            const Extent<dim> &extent) const override
      {
        typename Shape<dim>::Faces faces;
        for (unsigned int i = 0; i < sides.size(); ++i)
          if (part.empty() || this->parts()[i] == part)
            {
              Extent<dim> limited = extent;
              limited.box         = intersection(extent.box, box_of(sides[i]));
              std::vector<HalfSpace<dim>> ends;
              for (const auto &side : sides)
                if (std::abs(side.outward * sides[i].outward) < .5)
                  ends.push_back(side);
              faces.push_back(
                make_plane<dim>(sides[i].point,
                                (body_inside ? 1. : -1.) * sides[i].outward,
                                limited,
                                ends));
            }
        return faces;
      }

    protected:
      void
      add_pieces_of_part(const ConvexPolytope<dim> &cell,
                         const double               sign,
                         SignedPieces<dim>         &pieces) const override
      {
        ConvexPolytope<dim> part = cell;
        for (const auto &side : sides)
          if (!part.empty())
            part.clip(side.point, -side.outward);
        if (!part.empty())
          pieces.push_back({sign, part});
      }

    private:
      /** One that holds a side. */
      BoundingBox<dim>
      box_of(const HalfSpace<dim> &side) const
      {
        const auto             &box = this->bounding_box();
        std::vector<Point<dim>> corners;
        for (unsigned int v = 0; v < (1 << dim); ++v)
          if (side.outward * (box.vertex(v) - side.point) == 0.)
            corners.push_back(box.vertex(v));
        return corners.empty() ? box : BoundingBox<dim>(corners);
      }

      std::vector<HalfSpace<dim>> sides;
    };



    template <int dim>
    BoundingBox<dim>
    box_of(const std::vector<Point<2>>     &vertices,
           const std::pair<double, double> &heights)
    {
      std::vector<Point<dim>> corners;
      for (const auto &x : vertices)
        for (const double z : {heights.first, heights.second})
          {
            corners.push_back(lift<dim>(x));
            if (dim == 3)
              corners.back()[dim - 1] = z;
          }
      return BoundingBox<dim>(corners);
    }



    template <int dim>
    std::vector<std::string>
    parts_of(const std::vector<Point<2>> &vertices)
    {
      std::vector<std::string> names;
      for (unsigned int i = 1; i <= vertices.size(); ++i)
        names.push_back(std::to_string(i));
      if (dim == 3)
        names.insert(names.end(), {"bottom", "top"});
      return names;
    }



    template <int dim>
    class PolygonShape : public Shape<dim>
    {
    public:
      PolygonShape(const std::vector<Point<2>>     &vertices,
                   const std::pair<double, double> &heights)
        : Shape<dim>(box_of<dim>(vertices, heights),
                     true,
                     parts_of<dim>(vertices))
        , vertices(vertices)
        , heights(heights)
        , clockwise(polygon_area(vertices) < 0.)
        , line(vertices)
      {
        line.push_back(line[0]);
        outline = make_flat_face<2>(line, clockwise);
        convex  = convex_parts(
          clockwise ? Polygon(vertices.rbegin(), vertices.rend()) : vertices);
      }

      double
      level(const Point<dim> &p) const override
      {
        const double value = outline->level(Point<2>(p[0], p[1]));
        if constexpr (dim == 3)
          return std::min({value, p[2] - heights.first, heights.second - p[2]});
        else
          return value;
      }

      typename Shape<dim>::Faces
      faces(const std::string &part,
            const bool         body_inside,
            const Extent<dim> &extent) const override
      {
        typename Shape<dim>::Faces faces;
        const auto add = [&](const std::vector<Point<dim>> &corners) {
          faces.push_back(
            make_flat_face(corners, body_inside == clockwise, extent));
        };
        const auto [low, high] = heights;
        if constexpr (dim == 2)
          if (part.empty())
            {
              add(line);
              return faces;
            }
        for (unsigned int i = 0; i < vertices.size(); ++i)
          if (part.empty() || part == std::to_string(i + 1))
            {
              const Point<2> &x = line[i], &y = line[i + 1];
              if constexpr (dim == 2)
                add({x, y});
              else
                add({{x[0], x[1], low},
                     {y[0], y[1], low},
                     {y[0], y[1], high},
                     {x[0], x[1], high}});
            }
        if constexpr (dim == 3)
          for (const bool top : {false, true})
            if (part.empty() || part == (top ? "top" : "bottom"))
              {
                std::vector<Point<3>> corners;
                for (const auto &x : vertices)
                  corners.emplace_back(x[0], x[1], top ? high : low);
                if (!top)
                  std::reverse(corners.begin(), corners.end());
                add(corners);
              }
        return faces;
      }

    protected:
      void
      add_pieces_of_part(const ConvexPolytope<dim> &cell,
                         const double               sign,
                         SignedPieces<dim>         &pieces) const override
      {
        ConvexPolytope<dim> slice = cell;
        if constexpr (dim == 3)
          {
            const Tensor<1, dim> up = Point<dim>::unit_vector(2);
            slice.clip(Point<dim>(heights.first * up), up);
            slice.clip(Point<dim>(heights.second * up), -up);
          }
        for (const auto &polygon : convex)
          {
            ConvexPolytope<dim> part = slice;
            for (unsigned int i = 0; i < polygon.size(); ++i)
              {
                const Tensor<1, 2> edge =
                  polygon[(i + 1) % polygon.size()] - polygon[i];
                part.clip(lift<dim>(polygon[i]),
                          lift<dim>(Point<2>(-edge[1], edge[0])));
              }
            if (!part.empty())
              pieces.push_back({sign, part});
          }
      }

    private:
      std::vector<Point<2>>     vertices;
      std::pair<double, double> heights;
      bool                      clockwise;
      std::vector<Point<2>>     line; ///< the vertices, closed
      SurfacePointer<2>         outline;
      std::vector<Polygon>      convex; ///< parts
    };
  } // namespace



  template <int dim>
  ShapePointer<dim>
  make_space()
  {
    return std::make_shared<ConvexShape<dim>>(std::vector<HalfSpace<dim>>());
  }



  template <int dim>
  ShapePointer<dim>
  make_half_space(const Point<dim> &point, const Tensor<1, dim> &outward_normal)
  {
    return std::make_shared<ConvexShape<dim>>(std::vector<HalfSpace<dim>>{
      {point, outward_normal / outward_normal.norm()}});
  }



  template <int dim>
  ShapePointer<dim>
  make_box(const Point<dim> &lower, const Point<dim> &upper)
  {
    std::vector<HalfSpace<dim>> sides;
    for (unsigned int d = 0; d < dim; ++d)
      {
        sides.push_back({lower, -Point<dim>::unit_vector(d)});
        sides.push_back({upper, Point<dim>::unit_vector(d)});
      }
    std::vector<std::string> names{"left", "right", "bottom", "top"};
    if (dim == 3)
      names.insert(names.begin() + 2, {"front", "back"});
    return std::make_shared<ConvexShape<dim>>(
      sides, BoundingBox<dim>(std::make_pair(lower, upper)), names);
  }

  ShapePointer<3>
  make_slab(const Point<3>       &start,
            const Point<3>       &end,
            const BoundingBox<3> &box)
  {
    const Tensor<1, 3> axis = (end - start) / start.distance(end);
    return std::make_shared<ConvexShape<3>>(
      std::vector<HalfSpace<3>>{{start, -axis}, {end, axis}},
      box,
      std::vector<std::string>{"bottom", "top"});
  }



  template <int dim>
  ShapePointer<dim>
  make_polygon(const std::vector<Point<2>>     &vertices,
               const std::pair<double, double> &heights)
  {
    return std::make_shared<PolygonShape<dim>>(vertices, heights);
  }



#define INSTANTIATE(dim)                                                       \
  template ShapePointer<dim> make_space();                                     \
  template ShapePointer<dim> make_half_space(const Point<dim> &,               \
                                             const Tensor<1, dim> &);          \
  template ShapePointer<dim> make_box(const Point<dim> &, const Point<dim> &); \
  template ShapePointer<dim> make_polygon(const std::vector<Point<2>> &,       \
                                          const std::pair<double, double> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
