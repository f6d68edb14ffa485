// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/curved_parts.h>
#include <moraine/geometry/shapes.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/hp/q_collection.h>

#include <deal.II/non_matching/quadrature_generator.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** φ of a smooth shape, or of what is around it, composed with the map of a
     * cell and lowered by a shift. */
    template <int dim>
    class ReferenceLevelSet : public Function<dim>
    {
    public:
      ReferenceLevelSet(const SmoothShape<dim> &shape,
                        const double            sign,
                        const CellMap<dim>     &map,
                        const double            length,
                        const double            shift)
        : shape(shape)
        , sign(sign)
        , map(map)
        , length(length)
        , shift(shift)
      {}

      double
      value(const Point<dim> &xi, const unsigned int = 0) const override
      {
        return sign * shape.value(map.place(xi)) - shift;
      }

      Tensor<1, dim>
      gradient(const Point<dim> &xi, const unsigned int = 0) const override
      {
        return sign * transpose(map.jacobian(xi)) *
               shape.gradient(map.place(xi), length);
      }

      SymmetricTensor<2, dim>
      hessian(const Point<dim> &xi, const unsigned int = 0) const override
      {
        // differences serve, as this only bounds how φ bends: a little more
        // than they say, for round-off must not decide what is near a bound
        constexpr double        step = 1e-3;
        SymmetricTensor<2, dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const Tensor<1, dim> shift = step * Point<dim>::unit_vector(d);
            const Tensor<1, dim> change =
              gradient(xi + shift) - gradient(xi - shift);
            for (unsigned int e = d; e < dim; ++e)
              result[d][e] = (1. + 1e-8) * change[e] / (2. * step);
          }
        return result;
      }

    private:
      const SmoothShape<dim> &shape;
      const double            sign;
      const CellMap<dim>     &map;
      const double            length;
      const double            shift;
    };



    /** Boxes that make up the part of a cell within an extent, so small that
     * the surface hardly turns in them. */
    template <int dim>
    struct BoxesWithin
    {
      void
      add(BoundingBox<dim> box, const unsigned int halvings)
      {
        bool exact = true;
        if (is_far(box))
          return;
        for (const auto &limit : extent.limits)
          if (!trim(limit, box, exact))
            return;
        if (exact || halvings == 0)
          add_resolved(box, dim * 5);
        else
          for (unsigned int child = 0; child < (1 << dim); ++child)
            add(box.child(child), halvings - 1);
      }

      /**
       * Add a box, halved across its directions in which the surface turns too
       * much. The generator halves but four times itself to see how the surface
       * runs; what it has not seen then it loses, or finds too large.
       */
      void
      add_resolved(const BoundingBox<dim> &box, const unsigned int halvings)
      {
        const Tensor<2, dim>            J = map.jacobian(box.center());
        std::array<Tensor<1, dim>, dim> edges;
        for (unsigned int d = 0; d < dim; ++d)
          edges[d] = box.side_length(d) * (J * Point<dim>::unit_vector(d));
        const auto turns = shape.turns(map.place(box.center()), edges);
        const auto most  = std::max_element(turns.begin(), turns.end());
        if (*most > largest_turn && halvings == 0)
          shape.report_unresolved(map.place(box.center()));
        if (*most <= largest_turn || halvings == 0)
          return boxes.push_back(box);
        const unsigned int d       = most - turns.begin();
        auto               corners = box.get_boundary_points();
        const double       upper   = corners.second[d];
        for (const double end : {box.center()[d], upper})
          {
            corners.second[d] = end;
            const BoundingBox<dim> half(corners);
            if (!is_far(half))
              add_resolved(half, halvings - 1);
            corners.first[d] = end;
          }
      }

      /** Of the normal along an edge of a box. Chosen by the error of areas:
       * below 0.5 % with three points a direction; twice as much loses whole
       * boxes. */
      static constexpr double largest_turn = 0.7;

      CellVertices<dim>
      image(const BoundingBox<dim> &box) const
      {
        CellVertices<dim> vertices = cell_of(box);
        for (auto &x : vertices)
          x = map.place(x);
        return vertices;
      }

      /** Whether the surface surely keeps away from the image of a box. */
      bool
      is_far(const BoundingBox<dim> &box) const
      {
        const Point<dim> middle = map.place(box.center());
        const bool       inside = shape.value(middle) > 0.;
        double           radius = 0.;
        for (const auto &x : image(box))
          {
            if ((shape.value(x) > 0.) != inside)
              return false;
            radius = std::max(radius, x.distance(middle));
          }
        // twice: the distance from an expression is only an estimate
        return std::abs(shape.nearest(middle, radius).level) > 2. * radius;
      }

      /** Cut a box down to the part within a limit. False where none is left;
       * @p exact is cleared where the limit runs across the box. */
      bool
      trim(const typename Extent<dim>::Limit &limit,
           BoundingBox<dim>                  &box,
           bool                              &exact) const
      {
        const CellVertices<dim> vertices = image(box);
        const Overlap           overlap =
          limit.shape->overlap(ConvexPolytope<dim>(vertices));
        if (overlap != Overlap::part)
          return (overlap == Overlap::all) == limit.inside;
        const auto margin = [&](const Point<dim> &x) {
          return (limit.inside ? 1. : -1.) * limit.shape->level(x);
        };
        std::array<double, (1 << dim)> margins;
        for (unsigned int v = 0; v < vertices.size(); ++v)
          margins[v] = margin(vertices[v]);
        // a limit along the axes changes the margin in one direction only
        unsigned int along    = dim;
        bool         straight = limit.shape->is_straight();
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int v = 0; v < vertices.size(); ++v)
            if (std::abs(margins[v] - margins[v ^ (1u << d)]) > tolerance)
              {
                straight = straight && (along == dim || along == d);
                along    = d;
              }
        const double low  = margins[0],
                     high = along == dim ? low : margins[1u << along];
        if (!straight || low * high >= 0. ||
            std::abs(2. * margin(map.place(box.center())) - low - high) >
              2. * tolerance)
          {
            exact = false;
            return true;
          }
        auto         corners = box.get_boundary_points();
        const double cut =
          corners.first[along] +
          low / (low - high) * (corners.second[along] - corners.first[along]);
        (low < 0. ? corners.first : corners.second)[along] = cut;
        box = BoundingBox<dim>(corners);
        return true;
      }

      const SmoothShape<dim> &shape;
      const CellMap<dim>     &map;
      const Extent<dim>      &extent;

      /** Lengths below are round-off. */
      const double tolerance;

      std::vector<BoundingBox<dim>> boxes = {};
    };



    template <int dim>
    class SmoothFace : public Surface<dim>
    {
    public:
      SmoothFace(const std::shared_ptr<const SmoothShape<dim>> &shape,
                 const bool                                     body_inside,
                 const Extent<dim>                             &extent)
        : Surface<dim>(intersection(shape->bounding_box(), extent.box), true)
        , shape(shape)
        , sign(body_inside ? 1. : -1.)
        , extent(extent)
      {}

      NearestPoint<dim>
      nearest(const Point<dim> &x, const double length) const override
      {
        NearestPoint<dim> point = shape->nearest(x, length);
        point.level *= sign;
        point.normal *= sign;
        point.in_extent =
          extent.contains(x + point.level * point.normal, point.normal);
        return point;
      }

      void
      pieces(const CellVertices<dim>        &cell,
             const unsigned int              n_gauss,
             std::vector<SurfacePoint<dim>> &out) const override
      {
        if (!this->may_touch(cell))
          return;
        const CellMap<dim> map(cell);
        const double       size = cell_size<dim>(cell);
        BoxesWithin<dim>   within{*shape, map, extent, 1e-12 * size};
        within.add(create_unit_bounding_box<dim>(), 4);
        if (within.boxes.empty())
          return;
        // a surface that follows a face is moved into the body, to be found
        // once
        const double shift =
          1e-10 * size *
          shape->gradient(map.place(within.boxes[0].center()), size).norm();
        const ReferenceLevelSet<dim> level_set(*shape, sign, map, size, shift);
        const hp::QCollection<1>     gauss((QGauss<1>(n_gauss)));
        NonMatching::QuadratureGenerator<dim> generator(gauss);
        for (const auto &part : within.boxes)
          {
            generator.generate(level_set, part);
            const auto &rule = generator.get_surface_quadrature();
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                const Tensor<2, dim> J = map.jacobian(rule.point(q));
                Point<dim>           x = map.place(rule.point(q));
                Tensor<1, dim>       g = shape->gradient(x, size);
                x = linear_zero<dim>(x, shape->value(x), g);
                g = shape->gradient(x, size);
                const Tensor<1, dim> normal = -sign / g.norm() * g;
                if (!extent.contains(x, normal))
                  continue;
                const double stretch =
                  determinant(J) *
                  (transpose(invert(J)) * rule.normal_vector(q)).norm();
                out.push_back({x, normal, rule.weight(q) * stretch});
              }
          }
      }

    protected:
      std::shared_ptr<const SmoothShape<dim>> shape;
      double                                  sign;
      Extent<dim>                             extent;
    };



    class Arc : public SmoothFace<2>
    {
    public:
      Arc(const Point<2>  &centre,
          const double     radius,
          const bool       body_inside,
          const double     start_angle,
          const double     end_angle,
          const Extent<2> &extent)
        : SmoothFace<2>(make_ball<2>(centre, radius), body_inside, extent)
        , centre(centre)
        , radius(radius)
        , start(start_angle * numbers::PI / 180.)
        , sweep((end_angle - start_angle) * numbers::PI / 180.)
      {
        if (!(end_angle > start_angle) || end_angle > start_angle + 360.)
          throw InputError(
            "an arc must end after its start and within 360 degrees "
            "of it, found " +
            std::to_string(start_angle) + " to " + std::to_string(end_angle));
        std::vector<Point<2>> extremes{at_angle(0.), at_angle(sweep)};
        for (int quarter = std::ceil(2. * start / numbers::PI);
             quarter * numbers::PI / 2. < start + sweep;
             ++quarter)
          extremes.push_back(at_angle(quarter * numbers::PI / 2. - start));
        this->box = intersection(BoundingBox<2>(extremes), extent.box);
      }

      NearestPoint<2>
      nearest(const Point<2> &x, const double length) const override
      {
        constexpr double tolerance = 1e-10;
        NearestPoint<2>  point     = SmoothFace<2>::nearest(x, length);
        const double     angle     = from_start(x);
        point.in_extent =
          point.in_extent &&
          (angle <= sweep + tolerance || angle >= 2. * numbers::PI - tolerance);
        return point;
      }

      void
      pieces(const CellVertices<2>        &cell,
             const unsigned int            n_gauss,
             std::vector<SurfacePoint<2>> &out) const override
      {
        if (!this->may_touch(cell))
          return;
        const double tolerance = 1e-9 * cell_size<2>(cell);
        for (const auto &chord : chords_in_disc<2>(
               {cell[0], cell[1], cell[3], cell[2]}, centre, radius))
          {
            const double from = from_start(chord.leave);
            for (const double turn : {0., 2. * numbers::PI})
              {
                const Stretch piece{std::max(from - turn, 0.),
                                    std::min(from - turn + chord.angle_after,
                                             sweep)};
                if (piece.second - piece.first > 4e-15)
                  for (const Stretch &part : extent.stretches(
                         piece, tolerance, [this](const double angle) {
                           const Point<2> x = at_angle(angle);
                           return std::make_pair(x, normal_at(x));
                         }))
                    add_points(part.first, part.second, n_gauss, out);
              }
          }
      }

      SurfacePointer<2>
      within(const Extent<2> &other) const override
      {
        const auto part = std::make_shared<Arc>(*this);
        part->extent    = extent.and_within(other);
        part->box       = intersection(box, other.box);
        return part;
      }

    private:
      /** The angle to x from the start of the arc, in [0, 2π). */
      double
      from_start(const Point<2> &x) const
      {
        constexpr double turn  = 2. * numbers::PI;
        const double     angle = std::atan2(x[1] - centre[1], x[0] - centre[0]);
        return angle - start - turn * std::floor((angle - start) / turn);
      }

      Point<2>
      at_angle(const double from_start) const
      {
        return centre + radius * Point<2>(std::cos(start + from_start),
                                          std::sin(start + from_start));
      }

      Tensor<1, 2>
      normal_at(const Point<2> &x) const
      {
        return sign * unit_or_any<2>(x - centre);
      }

      /** Gauss points of the stretch between two angles from the start. */
      void
      add_points(const double                  from,
                 const double                  to,
                 const unsigned int            n_gauss,
                 std::vector<SurfacePoint<2>> &out) const
      {
        const QGauss<1>    gauss(n_gauss);
        const double       angle = to - from;
        const unsigned int n =
          std::max(1., std::ceil(angle / (numbers::PI / 4.) - 1e-9));
        for (unsigned int part = 0; part < n; ++part)
          for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const auto x =
                at_angle(from + (part + gauss.point(q)[0]) * angle / n);
              out.push_back(
                {x, normal_at(x), gauss.weight(q) * radius * angle / n});
            }
      }

      Point<2> centre;
      double   radius;
      double   start;
      double   sweep;
    };
  } // namespace



  template <int dim>
  typename Shape<dim>::Faces
  SmoothShape<dim>::faces(const std::string &,
                          const bool         body_inside,
                          const Extent<dim> &extent) const
  {
    return {std::make_shared<SmoothFace<dim>>(
      std::static_pointer_cast<const SmoothShape<dim>>(
        this->shared_from_this()),
      body_inside,
      extent)};
  }



  SurfacePointer<2>
  make_arc(const Point<2>  &centre,
           const double     radius,
           const bool       body_inside,
           const double     start_angle,
           const double     end_angle,
           const Extent<2> &extent)
  {
    return std::make_shared<Arc>(
      centre, radius, body_inside, start_angle, end_angle, extent);
  }



  template class SmoothShape<2>;
  template class SmoothShape<3>;
} // namespace moraine
