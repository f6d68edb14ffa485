// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shapes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using Planes = std::vector<HalfSpace<dim>>;

    /** A face of the rim, as far as an extent goes. */
    template <int dim>
    using Face = std::function<SurfacePointer<dim>(const bool body_inside,
                                                   const Extent<dim> &extent)>;



    /** Convex parts side by side, each the intersection of half spaces. */
    template <int dim>
    class StraightShape : public Shape<dim>
    {
    public:
      /**
       * @p names are those of the @p sides, or none. Several parts need their
       * @p outline as seen along z, between the lowest and highest z of the
       * @p box. The @p whole of the faces may be given as one.
       */
      StraightShape(const std::vector<Planes<dim>> &parts,
                    const BoundingBox<dim>         &box,
                    const std::vector<std::string> &names,
                    const std::vector<Face<dim>>   &sides,
                    const Face<dim>                &whole   = {},
                    const SurfacePointer<2>        &outline = nullptr)
        : Shape<dim>(box, true, names)
        , convex(parts)
        , sides(sides)
        , whole(whole)
        , outline(outline)
      {}

      double
      level(const Point<dim> &p) const override
      {
        double value = std::numeric_limits<double>::infinity();
        if (convex.size() == 1)
          for (const auto &plane : convex[0])
            value = std::min(value, plane.depth(p));
        else
          value = outline->level(Point<2>(p[0], p[1]));
        if (dim == 3 && convex.size() > 1)
          value = std::min({value,
                            p[dim - 1] - this->bounding_box().lower_bound(2),
                            this->bounding_box().upper_bound(2) - p[dim - 1]});
        return value;
      }

      Overlap
      overlap(const ConvexPolytope<dim> &cell) const override
      {
        if (convex.size() > 1)
          return Shape<dim>::overlap(cell);
        Overlap answer = Overlap::all;
        for (const auto &plane : convex[0])
          {
            double lowest  = std::numeric_limits<double>::infinity();
            double highest = -lowest;
            for (const auto &x : cell.vertices())
              {
                const double depth = plane.depth(x);
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
        if (part.empty() && whole)
          return {whole(body_inside, extent)};
        typename Shape<dim>::Faces faces;
        for (unsigned int i = 0; i < sides.size(); ++i)
          if (part.empty() || this->parts()[i] == part)
            faces.push_back(sides[i](body_inside, extent));
        return faces;
      }

    protected:
      void
      add_pieces_of_part(const ConvexPolytope<dim> &cell,
                         const double               sign,
                         SignedPieces<dim>         &pieces) const override
      {
        for (const auto &planes : convex)
          {
            ConvexPolytope<dim> part = cell;
            for (const auto &plane : planes)
              part.clip(plane.point, -plane.outward);
            if (!part.empty())
              pieces.push_back({sign, part});
          }
      }

    private:
      std::vector<Planes<dim>> convex; ///< parts
      std::vector<Face<dim>>   sides;
      Face<dim>                whole;
      SurfacePointer<2>        outline;
    };



    template <int dim>
    Point<dim>
    lift(const Tensor<1, 2> &a, const double height)
    {
      Point<dim> lifted;
      if (dim == 3)
        lifted[dim - 1] = height;
      lifted[0] = a[0];
      lifted[1] = a[1];
      return lifted;
    }



    /** The planes of a convex polygon, counter-clockwise, or of the prism over
     * it. */
    template <int dim>
    Planes<dim>
    planes_of(const Polygon &p, const double low, const double high)
    {
      Planes<dim> planes;
      if (dim == 3)
        planes = {{lift<dim>(p[0], low), lift<dim>({}, -1.)},
                  {lift<dim>(p[0], high), lift<dim>({}, 1.)}};
      for (unsigned int i = 0; i < p.size(); ++i)
        {
          const Tensor<1, 2> edge = p[(i + 1) % p.size()] - p[i];
          planes.push_back(
            {lift<dim>(p[i], low),
             lift<dim>(Point<2>(edge[1], -edge[0]) / edge.norm(), 0.)});
        }
      return planes;
    }
  } // namespace



  template <int dim>
  ShapePointer<dim>
  make_convex(const Planes<dim>              &planes,
              const BoundingBox<dim>         &box,
              const std::vector<std::string> &names)
  {
    std::vector<Face<dim>> faces;
    for (const auto &plane : planes)
      {
        Planes<dim>             ends;
        std::vector<Point<dim>> corners;
        for (const auto &other : planes)
          if (std::abs(other.outward * plane.outward) < .5)
            ends.push_back(other);
        for (const auto &x : cell_of(box))
          if (plane.depth(x) == 0.)
            corners.push_back(x);
        const BoundingBox<dim> around =
          corners.empty() ? box : BoundingBox<dim>(corners);
        faces.push_back([=](const bool inside, const Extent<dim> &extent) {
          Extent<dim> limited = extent;
          limited.box         = intersection(extent.box, around);
          return make_plane<dim>(
            {plane.point, (inside ? 1. : -1.) * plane.outward}, limited, ends);
        });
      }
    return std::make_shared<StraightShape<dim>>(
      std::vector<Planes<dim>>{planes}, box, names, faces);
  }



  template <int dim>
  ShapePointer<dim>
  make_box(const Point<dim> &lower, const Point<dim> &upper)
  {
    Planes<dim> sides;
    for (unsigned int d = 0; d < dim; ++d)
      {
        sides.push_back({lower, -Point<dim>::unit_vector(d)});
        sides.push_back({upper, Point<dim>::unit_vector(d)});
      }
    std::vector<std::string> names{"left", "right", "bottom", "top"};
    if (dim == 3)
      names.insert(names.begin() + 2, {"front", "back"});
    return make_convex<dim>(sides, {{lower, upper}}, names);
  }



  template <int dim>
  ShapePointer<dim>
  make_polygon(const std::vector<Point<2>>     &vertices,
               const std::pair<double, double> &heights)
  {
    const auto [low, high] = heights;
    const bool clockwise   = polygon_area(vertices) < 0.;
    Polygon    line        = vertices;
    line.push_back(line[0]);

    const auto face = [clockwise](const std::vector<Point<dim>> &corners) {
      return [=](const bool inside, const Extent<dim> &extent) {
        return make_flat_face<dim>(corners, inside == clockwise, extent);
      };
    };
    std::vector<std::string> names;
    std::vector<Face<dim>>   faces;
    std::vector<Point<dim>>  bottom, top;
    for (unsigned int i = 0; i < vertices.size(); ++i)
      {
        bottom.push_back(lift<dim>(line[i], low));
        top.push_back(lift<dim>(line[i], high));
        std::vector<Point<dim>> corners{bottom[i], lift<dim>(line[i + 1], low)};
        if (dim == 3)
          corners.insert(corners.end(), {lift<dim>(line[i + 1], high), top[i]});
        names.push_back(std::to_string(i + 1));
        faces.push_back(face(corners));
      }
    BoundingBox<dim> box(bottom);
    box.merge_with(BoundingBox<dim>(top));
    if (dim == 3)
      {
        std::reverse(bottom.begin(), bottom.end());
        names.insert(names.end(), {"bottom", "top"});
        faces.insert(faces.end(), {face(bottom), face(top)});
      }

    std::vector<Planes<dim>> parts;
    for (const auto &part : convex_parts(
           clockwise ? Polygon(vertices.rbegin(), vertices.rend()) : vertices))
      parts.push_back(planes_of<dim>(part, low, high));
    Face<dim> whole;
    if constexpr (dim == 2)
      whole = face(line);
    return std::make_shared<StraightShape<dim>>(
      parts, box, names, faces, whole, make_flat_face<2>(line, clockwise));
  }



#define INSTANTIATE(dim)                                 \
  template decltype(make_convex<dim>)  make_convex<dim>; \
  template decltype(make_box<dim>)     make_box<dim>;    \
  template decltype(make_polygon<dim>) make_polygon<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
