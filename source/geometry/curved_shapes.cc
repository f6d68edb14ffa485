// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>

#include <moraine/geometry/curved_parts.h>
#include <moraine/geometry/shapes.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** How far a disc across an axis goes in each direction; a ball if the axis
     * is zero. */
    template <int dim>
    Tensor<1, dim>
    arm(const double radius, const Tensor<1, dim> &axis)
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = radius * std::sqrt(std::max(0., 1. - axis[d] * axis[d]));
      return result;
    }



    template <int dim>
    class RoundShape : public SmoothShape<dim>
    {
    public:
      RoundShape(const Point<dim>       &centre,
                 const double            radius,
                 const Tensor<1, dim>   &axis,
                 const BoundingBox<dim> &box)
        : SmoothShape<dim>(box)
        , centre(centre)
        , radius(radius)
        , axis(axis)
      {
        if (!(radius > 0.) || !std::isfinite(radius))
          throw InputError("a radius must be positive, found " +
                           std::to_string(radius));
      }

      double
      level(const Point<dim> &p) const override
      {
        return radius - radial(p - centre).norm();
      }

      Overlap
      overlap(const ConvexPolytope<dim> &cell) const override
      {
        const Overlap answer = Shape<dim>::overlap(cell);
        if (answer != Overlap::part)
          return answer;
        // a convex shape holds a polytope if it holds its vertices
        for (const auto &x : cell.vertices())
          if (level(x) < -cell.tolerance())
            return Overlap::part;
        return Overlap::all;
      }

      typename Shape<dim>::Faces
      faces(const std::string &part,
            const bool         body_inside,
            const Extent<dim> &extent) const override
      {
        if constexpr (dim == 2)
          return {make_arc(centre, radius, body_inside, 0., 360., extent)};
        else
          return SmoothShape<dim>::faces(part, body_inside, extent);
      }

      /** (R² − r²)/(2R) has the zeros of the distance and is smooth at r = 0.
       */
      double
      value(const Point<dim> &x) const override
      {
        return (radius * radius - radial(x - centre).norm_square()) /
               (2. * radius);
      }

      Tensor<1, dim>
      gradient(const Point<dim> &x, const double) const override
      {
        return -1. / radius * radial(x - centre);
      }

      NearestPoint<dim>
      nearest(const Point<dim> &x, const double) const override
      {
        const Tensor<1, dim> r = radial(x - centre);
        // on the axis r is round-off in any direction
        return {radius - r.norm(),
                unit_or_any<dim>(radial(unit_or_any<dim>(r))),
                true};
      }

      std::array<double, dim>
      turns(const Point<dim> &,
            const std::array<Tensor<1, dim>, dim> &edges) const override
      {
        std::array<double, dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = radial(edges[d]).norm() / radius;
        return result;
      }

      void
      report_unresolved(const Point<dim> &x) const override
      {
        std::ostringstream message;
        message << "found a surface of radius " << radius
                << ", too small for the cell at (" << x
                << "), allowed: radii from a twentieth of a cell on";
        throw InputError(message.str());
      }

    protected:
      VolumeMoments<dim>
      moments_of_part(const ConvexPolytope<dim> &cell,
                      const Point<dim>          &reference) const override
      {
        return moments_in_round(cell, centre, axis, radius, reference);
      }

    private:
      /** From the nearest point of centre or axis to x. */
      Tensor<1, dim>
      radial(const Tensor<1, dim> &from_centre) const
      {
        return from_centre - (from_centre * axis) * axis;
      }

      Point<dim>     centre;
      double         radius;
      Tensor<1, dim> axis; ///< of unit length, or zero
    };



    template <int dim>
    class ExpressionShape : public SmoothShape<dim>
    {
    public:
      ExpressionShape(const std::string &text, const std::string &place)
        : SmoothShape<dim>(unlimited_box<dim>())
        , expression(text, place, 1, {}, false)
        , text(text)
        , place(place)
      {}

      double
      level(const Point<dim> &p) const override
      {
        return expression.value(p);
      }

      bool
      covers(const Point<dim> &p, const double margin) const override
      {
        const double phi    = level(p);
        const bool   inside = phi > 0.;
        if (margin == 0. || inside == (margin > 0.))
          return inside;
        // Seen over a cell, of which margins are about a thousandth.
        return phi > -margin * gradient(p, 1e3 * std::abs(margin)).norm();
      }

      double
      distance(const Point<dim> &p, const double length) const override
      {
        constexpr unsigned int most_steps = 8;
        const double           phi        = level(p);
        WayPlace               place{p, phi, 0.};
        try
          {
            for (unsigned int k = 0; k < most_steps; ++k)
              {
                if (std::abs(place.value) <= 1e-4 * std::abs(phi))
                  break;
                if (!step_to_surface(place, length))
                  return std::copysign(length, phi);
              }
          }
        catch (const InputError &)
          {} // φ need not have values there
        return std::copysign(std::max(0., p.distance(place.x) + place.rest),
                             phi);
      }

      bool
      estimates_distance() const override
      {
        return true;
      }

      Overlap
      overlap(const ConvexPolytope<dim> &cell) const override
      {
        return overlap_by_values<dim>(
          [this](const Point<dim> &p) { return level(p); }, cell);
      }

      Tensor<1, dim>
      gradient(const Point<dim> &x, const double length) const override
      {
        // step ~ eps^(1/3); far from the origin x itself is known less well
        constexpr double eps = 0.01 * std::numeric_limits<double>::epsilon();
        const double     step =
          std::max(1e-5,
                   std::cbrt(eps * coordinate_magnitude<dim>(x) / length));
        return central_gradient<dim>(
          [this](const Point<dim> &p) { return level(p); }, x, step * length);
      }

      NearestPoint<dim>
      nearest(const Point<dim> &x, const double length) const override
      {
        const double scale =
          length > 0. ? length : std::max(coordinate_magnitude<dim>(x), 1e-3);
        const Tensor<1, dim> g     = gradient(x, scale);
        const double         slope = g.norm();
        const double         phi   = level(x);
        return {slope > 0. ? phi / slope : phi, -unit_or_any<dim>(g), true};
      }

      std::array<double, dim>
      turns(const Point<dim>                      &middle,
            const std::array<Tensor<1, dim>, dim> &edges) const override
      {
        double scale = edges[0].norm();
        for (const auto &edge : edges)
          scale = std::min(scale, edge.norm());
        const Point<dim>        x = near_surface(middle, edges, scale);
        const Tensor<1, dim>    g = gradient(x, scale);
        std::array<double, dim> result{};
        if (g.norm() == 0.)
          return result;
        double curvature = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            constexpr double     step  = 1e-3;
            const Tensor<1, dim> shift = step * edges[d];
            result[d] =
              (gradient(x + shift, scale) - gradient(x - shift, scale)).norm() /
              (2. * step * g.norm());
            curvature = std::max(curvature, result[d] / edges[d].norm());
          }
        // a distance does not bend along the normal, but the surface comes back
        for (unsigned int d = 0; d < dim; ++d)
          result[d] =
            std::max(result[d], curvature * std::abs(g * edges[d]) / g.norm());
        return result;
      }

      void
      report_unresolved(const Point<dim> &) const override
      {}

    private:
      /** On the way to φ = 0: a place, φ there, and how far it is from there by
       * the last slope, negative beyond. */
      struct WayPlace
      {
        Point<dim> x;
        double     value;
        double     rest;
      };

      /** A step of Newton's method, shortened until φ is smaller; from where φ
       * is flat or least, one along an axis. @return whether there is one. */
      bool
      step_to_surface(WayPlace &place, const double length) const
      {
        const Tensor<1, dim> g     = gradient(place.x, length);
        const double         slope = g.norm(), size = std::abs(place.value);
        if (!(slope * length > 1e-3 * size))
          return step_along_axis(place, length);
        place.rest               = size / slope;
        const Tensor<1, dim> way = -place.value / (slope * slope) * g;
        for (double part = 1.; part == 1. || part * place.rest > length / 64.;
             part *= 0.5)
          {
            const Point<dim> y     = place.x + part * way;
            const double     value = level(y);
            if (!(std::abs(value) < size))
              continue;
            const double rest = std::abs(value) / slope;
            place = {y, value, value * place.value < 0. ? -rest : rest};
            return true;
          }
        return step_along_axis(place, length);
      }

      /** The shortest to where φ is smaller or has changed its sign. */
      bool
      step_along_axis(WayPlace &place, const double length) const
      {
        const Point<dim> start = place.x;
        const double     from  = place.value;
        bool             found = false;
        for (double step = length / 64.; step <= length && !found; step *= 2.)
          for (unsigned int k = 0; k < 2 * dim; ++k)
            {
              const Point<dim> y = start + (k % 2 == 0 ? step : -step) *
                                             Point<dim>::unit_vector(k / 2);
              const double value = level(y);
              const double size  = value * from > 0. ? std::abs(value) : 0.;
              if (size < std::abs(place.value))
                {
                  place = {y, std::copysign(size, from), 0.};
                  found = true;
                }
            }
        return found;
      }

      /** A place near φ = 0 by Newton's method, kept within the box with these
       * edges, outside of which φ need not have values. */
      Point<dim>
      near_surface(const Point<dim>                      &middle,
                   const std::array<Tensor<1, dim>, dim> &edges,
                   const double                           scale) const
      {
        Point<dim>     x = middle;
        Tensor<1, dim> way;
        double         last = 1.;
        for (unsigned int k = 0; k < 4 && last > .1; ++k)
          {
            const Tensor<1, dim> g = gradient(x, scale), from = way;
            Tensor<1, dim>       slope;
            for (unsigned int d = 0; d < dim; ++d)
              slope[d] = g * edges[d];
            const double square = slope.norm_square();
            const double step   = square > 0. ? level(x) / square : 0.;
            x                   = middle;
            for (unsigned int d = 0; d < dim; ++d)
              {
                // where φ has an extremum, anywhere else
                way[d] = square > 0. ?
                           std::clamp(way[d] - step * slope[d], -.45, .45) :
                           .3;
                x += way[d] * edges[d];
              }
            last = (way - from).norm();
          }
        return x;
      }

    protected:
      void
      add_pieces_of_part(const ConvexPolytope<dim> &cell,
                         const double               sign,
                         SignedPieces<dim>         &pieces) const override
      {
        // A jump of the expression all along its boundary needs a fifth of
        // this.
        constexpr unsigned int most_evaluations = (dim == 2 ? 300000 : 3000000);
        unsigned int           n_evaluations    = 0;
        const auto             counted          = [&](const Point<dim> &p) {
          if (++n_evaluations > most_evaluations)
            {
              std::ostringstream message;
              message
                << place << ": found '" << text
                << "', whose boundary has too many details in the cell at ("
                << cell.vertex_mean()
                << "), allowed: details of about the size of a cell";
              throw InputError(message.str());
            }
          return level(p);
        };
        add_curved_pieces<dim>(counted, false, cell, sign, pieces);
      }

    private:
      Expression<dim> expression;
      std::string     text;
      std::string     place;
    };
  } // namespace



  template <int dim>
  std::shared_ptr<const SmoothShape<dim>>
  make_ball(const Point<dim> &centre, const double radius)
  {
    const Tensor<1, dim> axis, across = arm(radius, axis);
    return std::make_shared<RoundShape<dim>>(
      centre,
      radius,
      axis,
      BoundingBox<dim>({centre - across, centre + across}));
  }

  ShapePointer<3>
  make_cylinder(const Point<3> &start,
                const Point<3> &end,
                const double    radius,
                const double    inner_radius)
  {
    if (start == end)
      throw InputError("the axis of a cylinder must have a length");
    const Tensor<1, 3>   axis   = (end - start) / start.distance(end);
    const Tensor<1, 3>   across = arm(radius, axis);
    const BoundingBox<3> box(std::vector<Point<3>>{
      start - across, start + across, end - across, end + across});
    const auto           round = [&](const double r) {
      return std::make_shared<RoundShape<3>>(start, r, axis, box);
    };
    ShapePointer<3> outer = round(radius);
    if (inner_radius > 0.)
      outer = combine<3>(Operation::hollow_out,
                         outer,
                         round(inner_radius),
                         {{"outer", "inner"}});
    return combine<3>(Operation::intersect,
                      make_convex<3>({{start, -axis}, {end, axis}},
                                     box,
                                     {"bottom", "top"}),
                      outer,
                      {{"", inner_radius > 0. ? "" : "side"}});
  }



  template <int dim>
  std::shared_ptr<const SmoothShape<dim>>
  make_expression(const std::string &text, const std::string &place)
  {
    return std::make_shared<ExpressionShape<dim>>(text, place);
  }



#define INSTANTIATE(dim)                                  \
  template decltype(make_ball<dim>)       make_ball<dim>; \
  template decltype(make_expression<dim>) make_expression<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
