// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/arc.h>
#include <moraine/geometry/cell_cut.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  Arc::Arc(const Point<2> &centre,
           const double    radius,
           const bool      body_inside,
           const double    start_angle,
           const double    end_angle)
    : centre(centre)
    , radius(radius)
    , sign(body_inside ? 1. : -1.)
    , start(start_angle * numbers::PI / 180.)
    , sweep((end_angle - start_angle) * numbers::PI / 180.)
  {
    check_radius(radius);
    if (!(end_angle > start_angle) || end_angle > start_angle + 360.)
      throw InputError("an arc must end after its start and within 360 degrees "
                       "of it, found " +
                       std::to_string(start_angle) + " to " +
                       std::to_string(end_angle));
    std::vector<Point<2>> extremes{at_angle(0.), at_angle(sweep)};
    for (int quarter = std::ceil(2. * start / numbers::PI);
         quarter * numbers::PI / 2. < start + sweep;
         ++quarter)
      extremes.push_back(at_angle(quarter * numbers::PI / 2. - start));
    box = BoundingBox<2>(extremes);
  }

  double
  Arc::angle_from_start(const Point<2> &x) const
  {
    double angle = std::atan2(x[1] - centre[1], x[0] - centre[0]) - start;
    angle -= 2. * numbers::PI * std::floor(angle / (2. * numbers::PI));
    return angle;
  }

  Point<2>
  Arc::at_angle(const double from_start) const
  {
    return centre + radius * Point<2>(std::cos(start + from_start),
                                      std::sin(start + from_start));
  }

  double
  Arc::level(const Point<2> &x) const
  {
    return sign * (radius - x.distance(centre));
  }

  Tensor<1, 2>
  Arc::normal(const Point<2> &x) const
  {
    return sign * unit_or_any<2>(x - centre);
  }

  bool
  Arc::in_extent(const Point<2> &x) const
  {
    const double angle = angle_from_start(x), tolerance = 1e-10;
    return angle <= sweep + tolerance || angle >= 2. * numbers::PI - tolerance;
  }

  namespace
  {
    /**
     * The line of a cell's edge as a circle sees it: points of the circle
     * within
     * @p half_angle of the direction @p middle lie on the cell's side if
     * @p cell_within, else on the other. Computed from the ends in an order
     * that neighbours share, so both see the same angles, even where it grazes.
     */
    struct EdgeOnCircle
    {
      double middle, half_angle;
      bool   cell_within;
      /** Crossings on the edge or so near that they may be. */
      std::vector<double> breaks;
    };

    EdgeOnCircle
    edge_on_circle(Point<2>        a,
                   Point<2>        b,
                   const Point<2> &centre,
                   const double    radius)
    {
      EdgeOnCircle edge;
      edge.cell_within =
        std::make_pair(a[0], a[1]) < std::make_pair(b[0], b[1]);
      if (!edge.cell_within)
        std::swap(a, b);
      const double       length = a.distance(b);
      const Tensor<1, 2> t      = (b - a) / length;
      const Tensor<1, 2> left   = Point<2>(-t[1], t[0]);
      const double       height = (centre - a) * left;
      // (R − h)(R + h) keeps the digits of a grazing line
      const double half_chord =
        std::sqrt(std::max(0., (radius - height) * (radius + height)));
      edge.middle = std::atan2(left[1], left[0]);
      // a line that does not cross leaves every angle on one side, ±π too
      edge.half_angle = half_chord > 0. ? std::atan2(half_chord, -height) :
                        height > 0.     ? 4. :
                                          0.;
      if (half_chord > 0.)
        for (const double side : {-1., 1.})
          {
            const double abscissa = (centre - a) * t - side * half_chord;
            // one break too many does no harm, one too few does
            if (abscissa >= -1e-3 * length && abscissa <= 1.001 * length)
              edge.breaks.push_back(edge.middle + side * edge.half_angle);
          }
      return edge;
    }

    bool
    contains(const std::vector<EdgeOnCircle> &edges, const double angle)
    {
      return std::all_of(edges.begin(), edges.end(), [angle](const auto &edge) {
        const double off =
          std::remainder(angle - edge.middle, 2. * numbers::PI);
        return (std::abs(off) < edge.half_angle) == edge.cell_within;
      });
    }
  } // namespace

  void
  Arc::pieces(const CellVertices<2>        &cell,
              const unsigned int            n_gauss,
              std::vector<SurfacePoint<2>> &out) const
  {
    if (!may_touch<2>(cell, box))
      return;
    constexpr unsigned int    cycle[5] = {0, 1, 3, 2, 0};
    std::vector<EdgeOnCircle> edges;
    std::vector<double>       breaks{0., sweep};
    for (unsigned int e = 0; e < 4; ++e)
      {
        edges.push_back(
          edge_on_circle(cell[cycle[e]], cell[cycle[e + 1]], centre, radius));
        for (const double angle : edges.back().breaks)
          {
            const double turn = 2. * numbers::PI;
            const double from_start =
              angle - start - turn * std::floor((angle - start) / turn);
            if (from_start < sweep)
              breaks.push_back(from_start);
          }
      }
    std::sort(breaks.begin(), breaks.end());

    const QGauss<1> gauss(n_gauss);
    for (unsigned int i = 0; i + 1 < breaks.size();)
      {
        unsigned int j = i + 1;
        while (j < breaks.size() &&
               contains(edges, start + .5 * (breaks[j - 1] + breaks[j])))
          ++j;
        const double from = breaks[i], angle = breaks[j - 1] - from;
        i = j;
        if (angle <= 4e-15)
          continue;
        const unsigned int n =
          std::max(1., std::ceil(angle / (numbers::PI / 4.) - 1e-9));
        for (unsigned int part = 0; part < n; ++part)
          for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const auto x =
                at_angle(from + (part + gauss.point(q)[0]) * angle / n);
              out.push_back(
                {x, normal(x), gauss.weight(q) * radius * angle / n});
            }
      }
  }

  BoundingBox<2>
  Arc::bounding_box() const
  {
    return box;
  }
} // namespace moraine
