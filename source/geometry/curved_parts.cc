// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/curved_parts.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    // A level function in a polytope and its linear part at a point.
    template <int dim>
    struct LinearPart
    {
      LinearPart(const LevelFunction<dim>  &level,
                 const ConvexPolytope<dim> &cell,
                 const Point<dim>          &x,
                 const double               size)
        : x(x)
        , value(level(x))
        , slope(central_gradient(level, x, 1e-3 * size))
      {
        lowest = highest = value;
        for (const auto &vertex : cell.vertices())
          {
            const double there = level(vertex);
            lowest             = std::min(lowest, there);
            highest            = std::max(highest, there);
            bend =
              std::max(bend, std::abs(there - value - slope * (vertex - x)));
          }
      }

      // decided where no vertex and not thrice the bend reach zero
      Overlap
      overlap() const
      {
        if (lowest >= 3. * bend && lowest > 0.)
          return Overlap::all;
        return highest <= -3. * bend ? Overlap::none : Overlap::part;
      }

      // where the linear part vanishes
      Point<dim>
      zero() const
      {
        return linear_zero<dim>(x, value, slope);
      }

      Point<dim>     x;
      double         value;
      Tensor<1, dim> slope;
      double         lowest, highest;
      double         bend = 0.;
    };



    // mean of f over a cut face; exact for quadratic functions
    template <int dim>
    double
    mean_on_cut(const typename ConvexPolytope<dim>::PointList &cut,
                const LevelFunction<dim>                      &f)
    {
      if constexpr (dim == 2)
        return (f(cut[0]) + 4. * f(Point<2>((cut[0] + cut[1]) / 2.)) +
                f(cut[1])) /
               6.;
      else
        {
          double integral = 0., area = 0.;
          for (unsigned int i = 1; i + 1 < cut.size(); ++i)
            {
              const std::array<Point<3>, 3> x{{cut[0], cut[i], cut[i + 1]}};
              const double                  part =
                cross_product_3d(x[1] - x[0], x[2] - x[0]).norm();
              area += part;
              for (unsigned int k = 0; k < 3; ++k)
                integral += part / 3. * f(x[k] + (x[(k + 1) % 3] - x[k]) / 2.);
            }
          return area > 0. ? integral / area : f(cut[0]);
        }
    }



    template <int dim>
    struct CurveCutter
    {
      void
      add(const ConvexPolytope<dim> &cell, const unsigned int n_halvings)
      {
        const Point<dim> middle = cell.vertex_mean();
        const double     size   = cell.radius(middle);
        Overlap          answer = Overlap::part;
        if (is_distance && std::abs(level(middle)) >= size)
          answer = level(middle) > 0. ? Overlap::all : Overlap::none;
        LinearPart<dim> linear(level, cell, middle, size);
        if (answer == Overlap::part)
          answer = linear.overlap();
        if (answer == Overlap::all)
          pieces.push_back({sign, cell});
        if (answer != Overlap::part)
          return;
        // the tangent plane at a point of the boundary near the middle
        for (unsigned int k = 0; k < 2 && linear.slope.norm() > 0. &&
                                 linear.zero().distance(middle) <= size;
             ++k)
          linear = LinearPart<dim>(level, cell, linear.zero(), size);
        if (linear.bend > flat_enough * size * linear.slope.norm() &&
            n_halvings > 0)
          halve(cell, n_halvings);
        else if (linear.slope.norm() > 0.)
          cut(cell, linear.zero(), linear.slope);
        else if (linear.value > 0.)
          pieces.push_back({sign, cell});
      }

      // Of the size of a leaf. Chosen by the error it leaves in a cut cell:
      // below 1e-6 of its volume where the radius is five cells or more.
      static constexpr double flat_enough = (dim == 2 ? 5e-3 : 2e-2);

      void
      halve(const ConvexPolytope<dim> &cell, const unsigned int n_halvings)
      {
        const auto   box  = cell.bounding_box();
        unsigned int wide = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (box.side_length(d) > box.side_length(wide))
            wide = d;
        for (const double side : {1., -1.})
          {
            ConvexPolytope<dim> half = cell;
            half.clip(box.center(), side * Point<dim>::unit_vector(wide));
            if (!half.empty())
              add(half, n_halvings - 1);
          }
      }

      void
      cut(const ConvexPolytope<dim> &cell,
          const Point<dim>          &foot,
          const Tensor<1, dim>      &slope)
      {
        std::vector<typename ConvexPolytope<dim>::PointList> faces;
        ConvexPolytope<dim>                                  part = cell;
        part.clip(foot, slope, &faces);
        if (!faces.empty())
          {
            const double mean = mean_on_cut<dim>(faces[0], level);
            part              = cell;
            part.clip(linear_zero<dim>(foot, mean, slope), slope);
          }
        if (!part.empty())
          pieces.push_back({sign, part});
      }

      const LevelFunction<dim> &level;
      const bool                is_distance;
      const double              sign;
      SignedPieces<dim>        &pieces;
    };
  } // namespace



  template <int dim>
  void
  add_curved_pieces(const LevelFunction<dim>  &level,
                    const bool                 is_distance,
                    const ConvexPolytope<dim> &cell,
                    const double               sign,
                    SignedPieces<dim>         &pieces)
  {
    constexpr unsigned int depth = (dim == 2 ? 10 : 6);
    CurveCutter<dim>{level, is_distance, sign, pieces}.add(cell, dim * depth);
  }



  template <int dim>
  Overlap
  overlap_by_values(const LevelFunction<dim>  &level,
                    const ConvexPolytope<dim> &cell)
  {
    const Point<dim> middle = cell.vertex_mean();
    return LinearPart<dim>(level, cell, middle, cell.radius(middle)).overlap();
  }



  namespace
  {
    // the values of t in [0, 1] between which |a + t (b - a)|^2 < square;
    // decided in the same way from both ends
    template <int dim>
    std::pair<double, double>
    inside_circle(const Tensor<1, dim> &a,
                  const Tensor<1, dim> &b,
                  const double          square)
    {
      if (std::lexicographical_compare(
            b.begin_raw(), b.end_raw(), a.begin_raw(), a.end_raw()))
        {
          const auto [begin, end] = inside_circle(b, a, square);
          return {1. - end, 1. - begin};
        }
      const Tensor<1, dim> edge   = b - a;
      const double         ee     = edge.norm_square();
      const double         ae     = a * edge;
      const double         root_2 = ae * ae - ee * (a.norm_square() - square);
      if (!(root_2 > 0.) || ee == 0.)
        return {0., 0.};
      const double root  = std::sqrt(root_2);
      const double begin = std::max(0., (-ae - root) / ee);
      const double end   = std::min(1., (-ae + root) / ee);
      return begin < end ? std::make_pair(begin, end) : std::make_pair(0., 0.);
    }



    /**
     * Quadrature of the part of a plane polygon in space whose projection on
     * the first two coordinates lies in a disc; exact for quadratic functions.
     * The weights are areas of the projection, negative where it runs
     * clockwise. Where the rim is outside of the disc, a circular segment joins
     * the end of a chord with the start of the next. Its points are taken
     * across this chord, so nothing cancels on faces that are nearly upright.
     */
    struct DiscRule
    {
      /** Call @p add(x, weight) for each point of a face that is not upright.
       */
      void
      apply(const ConvexPolytope<3>::PointList &face)
      {
        normal = twice_area(face);
        if (std::abs(normal[2]) <= 1e-14 * normal.norm())
          return;
        auto chords = chords_in_disc<3>(face, centre, radius);
        for (auto &[enter, leave, angle] : chords)
          if (enter == leave)
            enter[2] = leave[2] += normal * (face[0] - enter) / normal[2];
        for (unsigned int i = 0; i < chords.size(); ++i)
          {
            const auto &[enter, leave, angle] = chords[i];
            const Point<3> &next = chords[(i + 1) % chords.size()].enter;
            add_triangle(chords[0].enter, enter, leave);
            add_triangle(chords[0].enter, leave, next);
            if (angle != 0.)
              add_segment(leave, next, angle / 2.);
          }
      }

      Tensor<1, 2>
      flat(const Point<3> &x) const
      {
        return Point<2>(x[0], x[1]) - centre;
      }

      void
      add_triangle(const Point<3> &a,
                   const Point<3> &b,
                   const Point<3> &c) const
      {
        const double area = cross(flat(b) - flat(a), flat(c) - flat(a)) / 2.;
        if (area != 0.)
          for (const auto &[p, q] : {std::make_pair(a, b), {b, c}, {c, a}})
            add(p + .5 * (q - p), area / 3.);
      }

      /** Between the chord from a to b and its arc of twice the angle @p half;
       * R (cos f - cos(half)) high where f is seen from the centre. */
      void
      add_segment(const Point<3> &a, const Point<3> &b, const double half) const
      {
        static const QGauss<1> around(20), across(2);

        const Tensor<1, 2> u = flat(a) / flat(a).norm();
        const double       c = std::cos(half), s = std::sin(half);
        Tensor<1, 3>       up({c * u[0] - s * u[1], s * u[0] + c * u[1], 0.});
        Tensor<1, 3>       along({-up[1], up[0], 0.});
        up[2] = -(normal * up) / normal[2];
        // of a short chord its own direction is the more exact one
        if (std::abs(half) < numbers::PI_2)
          along = (b - a) / (2. * radius * s);
        else
          along[2] = -(normal * along) / normal[2];
        const Point<3> middle = a + (b - a) / 2.;
        for (unsigned int q = 0; q < around.size(); ++q)
          {
            const double f      = half * (2. * around.point(q)[0] - 1.);
            const double height = 2. * radius * std::sin((half + f) / 2.) *
                                  std::sin((half - f) / 2.);
            for (unsigned int k = 0; k < across.size(); ++k)
              add(middle + radius * std::sin(f) * along +
                    across.point(k)[0] * height * up,
                  2. * half * around.weight(q) * across.weight(k) * radius *
                    std::cos(f) * height);
          }
      }

      const Point<2>                                            centre;
      const double                                              radius;
      const std::function<void(const Point<3> &, const double)> add;

      /** Of the face, of any length. */
      Tensor<1, 3> normal = {};
    };



    // Moments about the centre of a sphere of the part of a polyhedron in it:
    // each face spans a cone from the centre, which the sphere cuts off where
    // the face is outside. Inside, a cone over an area A at distance d has
    // volume d A / 3 and first moment d / 4 int x dA; outside, a solid angle
    // has r^3 / 3 int dw and r^4 / 4 int w dw.
    struct BallInPolyhedron
    {
      void
      add_face(const ConvexPolytope<3>::PointList &loop)
      {
        normal = twice_area(loop);
        if (normal.norm_square() == 0.)
          return;
        normal /= normal.norm();
        distance = normal * (loop[0] - centre);
        square   = std::max(0., radius * radius - distance * distance);
        for (unsigned int i = 0; i < loop.size(); ++i)
          add_edge(loop[i] - centre, loop[(i + 1) % loop.size()] - centre);
      }

      void
      add_edge(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
      {
        if (a == b)
          return;
        const Tensor<1, 3> foot = distance * normal;
        const auto [begin, end] =
          inside_circle(Tensor<1, 3>(a - foot), Tensor<1, 3>(b - foot), square);
        const Tensor<1, 3> enter = a + begin * (b - a);
        const Tensor<1, 3> leave = a + end * (b - a);
        if (begin == end)
          return add_outside(a, b);
        if (begin > 0.)
          add_outside(a, enter);
        add_area(normal * cross_product_3d(enter - foot, leave - foot) / 2.,
                 (foot + enter + leave) / 3.);
        if (end < 1.)
          add_outside(leave, b);
      }

      void
      add_area(const double area, const Tensor<1, 3> &middle)
      {
        sum.volume += distance / 3. * area;
        sum.first += distance / 4. * area * middle;
      }

      // the part of the triangle foot, a, b beyond the sphere's trace on the
      // face, and the sector inside it
      void
      add_outside(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
      {
        const double       side = distance < 0. ? -1. : 1.;
        const Tensor<1, 3> ua = a / a.norm(), ub = b / b.norm();
        const Tensor<1, 3> ab     = cross_product_3d(ua, ub);
        const double       cosine = ua * ub;
        const double       up     = side * normal * (ua + ub);
        double solid = 2. * std::atan2(side * normal * ab, 1. + cosine + up);
        Tensor<1, 3> arc;
        if (ab.norm() > 0.)
          arc = std::atan2(ab.norm(), cosine) / (2. * ab.norm()) * ab;
        if (square > 0.)
          {
            const Tensor<1, 3> pa = a - distance * normal;
            const Tensor<1, 3> pb = b - distance * normal;
            const double       angle =
              std::atan2(normal * cross_product_3d(pa, pb), pa * pb);
            const double r = std::sqrt(square);
            // int of the unit vector from the foot over the angle
            const Tensor<1, 3> turn =
              cross_product_3d(pb / pb.norm() - pa / pa.norm(), normal);
            solid -= side * angle * (1. - std::abs(distance) / radius);
            arc -= r / (2. * radius * radius) *
                   (r * angle * normal - distance * turn);
            const double area = square * angle / 2.;
            sum.volume += distance / 3. * area;
            sum.first += distance / 4. *
                         (area * distance * normal + square * r / 3. * turn);
          }
        sum.volume += std::pow(radius, 3) / 3. * solid;
        sum.first += std::pow(radius, 4) / 4. * arc;
      }

      const Point<3>   centre;
      const double     radius;
      VolumeMoments<3> sum = {};

      // of the face: its unit normal, distance, the square of its disc's radius
      Tensor<1, 3> normal   = {};
      double       distance = 0.;
      double       square   = 0.;
    };
  } // namespace



  template <int dim>
  std::vector<DiscChord<dim>>
  chords_in_disc(const typename ConvexPolytope<dim>::PointList &polygon,
                 const Point<2>                                &centre,
                 const double                                   radius)
  {
    const auto flat = [&](const Point<dim> &x) -> Tensor<1, 2> {
      return Point<2>(x[0], x[1]) - centre;
    };
    const auto angle_between = [&](const Point<dim> &a, const Point<dim> &b) {
      return std::atan2(cross(flat(a), flat(b)), flat(a) * flat(b));
    };
    std::vector<DiscChord<dim>> chords;
    double                      angle_before = 0.;
    for (unsigned int i = 0; i < polygon.size(); ++i)
      {
        const Point<dim> &a = polygon[i],
                         &b = polygon[(i + 1) % polygon.size()];
        const auto [begin, end] =
          inside_circle(flat(a), flat(b), radius * radius);
        const Point<dim> enter = a + begin * (b - a), leave = a + end * (b - a);
        double          &angle =
          chords.empty() ? angle_before : chords.back().angle_after;
        if (begin == end)
          angle += angle_between(a, b);
        else
          {
            if (begin > 0.)
              angle += angle_between(a, enter);
            chords.push_back(
              {enter, leave, end < 1. ? angle_between(leave, b) : 0.});
          }
      }
    if (chords.empty() && std::abs(angle_before) > numbers::PI)
      {
        Point<dim> start;
        start[0] = centre[0] + radius;
        start[1] = centre[1];
        chords.push_back({start, start, 0.});
      }
    if (!chords.empty())
      chords.back().angle_after += angle_before;
    return chords;
  }



  template <int dim>
  VolumeMoments<dim>
  moments_in_round(const ConvexPolytope<dim> &cell,
                   const Point<dim>          &centre,
                   const Tensor<1, dim>      &axis,
                   const double               radius,
                   const Point<dim>          &reference)
  {
    VolumeMoments<dim> sum;
    if constexpr (dim == 2)
      {
        ConvexPolytope<3>::PointList face;
        for (const auto &x : cell.vertices())
          face.emplace_back(x[0] - reference[0], x[1] - reference[1], 0.);
        DiscRule{Point<2>(centre - reference),
                 radius,
                 [&](const Point<3> &x, const double weight) {
                   sum.volume += weight;
                   sum.first += weight * Point<2>(x[0], x[1]);
                 }}
          .apply(face);
      }
    else if (axis.norm() == 0.)
      {
        BallInPolyhedron part{centre, radius};
        cell.for_each_face([&](const auto &loop) { part.add_face(loop); });
        sum = part.sum;
        sum.first += sum.volume * (centre - reference);
      }
    else
      {
        const PlaneFrame frame(reference, axis);
        DiscRule         rule{frame.to_plane(centre),
                      radius,
                      [&](const Point<3> &x, const double weight) {
                        sum.volume += weight * x[2];
                        sum.first += weight * x[2] *
                                     (x[0] * frame.first + x[1] * frame.second +
                                      x[2] / 2. * axis);
                      }};
        // by the divergence theorem, as nothing flows along the axis through
        // the cylinder itself
        cell.for_each_face([&](ConvexPolytope<3>::PointList loop) {
          for (auto &x : loop)
            {
              const Point<2> p = frame.to_plane(x);
              x                = {p[0], p[1], (x - reference) * axis};
            }
          rule.apply(loop);
        });
      }
    return sum;
  }



#define INSTANTIATE(dim)                                            \
  template decltype(add_curved_pieces<dim>) add_curved_pieces<dim>; \
  template decltype(overlap_by_values<dim>) overlap_by_values<dim>; \
  template decltype(chords_in_disc<dim>)    chords_in_disc<dim>;    \
  template decltype(moments_in_round<dim>)  moments_in_round<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
