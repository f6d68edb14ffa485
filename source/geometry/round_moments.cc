// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/round_moments.h>

#include <moraine/geometry/polygon.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    using Edge = std::pair<Tensor<1, 2>, Tensor<1, 2>>;

    // angle - sin(angle) without cancellation
    double
    angle_minus_sine(const double angle)
    {
      const double s = angle * angle;
      if (s > 0.04)
        return angle - std::sin(angle);
      return angle * s / 6. *
             (1. - s / 20. * (1. - s / 42. * (1. - s / 72. * (1. - s / 110.))));
    }



    // the values of t in [0, 1] between which |a + t (b - a)|^2 < square
    template <int dim>
    std::pair<double, double>
    inside_circle(const Tensor<1, dim> &a,
                  const Tensor<1, dim> &b,
                  const double          square)
    {
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



    // Moments about 0 of the region enclosed by edges, given in any order,
    // within a disc about centre: the polygon of the edges, with what is
    // outside projected on the circle, plus a circular segment per such edge.
    VolumeMoments<2>
    disc_moments(const std::vector<Edge> &edges,
                 const Tensor<1, 2>      &centre,
                 const double             radius)
    {
      VolumeMoments<2> sum;
      const auto       add_triangle = [&](const Tensor<1, 2> &p,
                                    const Tensor<1, 2> &q) {
        const double area = cross(p, q) / 2.;
        sum.volume += area;
        sum.first += area / 3. * (p + q);
      };
      const auto add_outside = [&](const Tensor<1, 2> &p,
                                   const Tensor<1, 2> &q) {
        const Tensor<1, 2> u = p / p.norm(), v = q / q.norm();
        add_triangle(centre + radius * u, centre + radius * v);
        const double angle = std::atan2(cross(u, v), u * v);
        const double area  = radius * radius / 2. * angle_minus_sine(angle);
        const double half  = std::sin(angle / 2.);
        const Tensor<1, 2> middle({std::cos(angle / 2.) * u[0] - half * u[1],
                                   half * u[0] + std::cos(angle / 2.) * u[1]});
        sum.volume += area;
        sum.first +=
          area * centre + 2. / 3. * std::pow(radius * half, 3) * middle;
      };
      for (const auto &[from, to] : edges)
        {
          const Tensor<1, 2> a = from - centre, b = to - centre;
          const auto [begin, end]  = inside_circle(a, b, radius * radius);
          const Tensor<1, 2> enter = a + begin * (b - a);
          const Tensor<1, 2> leave = a + end * (b - a);
          if (begin == end)
            {
              if (a != b)
                add_outside(a, b);
              continue;
            }
          if (begin > 0.)
            add_outside(a, enter);
          add_triangle(begin > 0. ? centre + enter : from,
                       end < 1. ? centre + leave : to);
          if (end < 1.)
            add_outside(leave, b);
        }
      return sum;
    }



    // Moments about the centre of a sphere of the part of a polyhedron in it:
    // each face spans a cone from the centre, which the sphere cuts off where
    // the face is outside. Inside, a cone over an area A at distance d has
    // volume d A / 3 and first moment d / 4 int x dA; outside, a solid angle
    // has r^3 / 3 int dw and r^4 / 4 int w dw.
    class BallInPolyhedron
    {
    public:
      BallInPolyhedron(const Point<3> &centre, const double radius)
        : centre(centre)
        , radius(radius)
      {}

      void
      add_face(const ConvexPolytope<3>::PointList &loop)
      {
        normal = 0.;
        for (unsigned int i = 1; i + 1 < loop.size(); ++i)
          normal += cross_product_3d(loop[i] - loop[0], loop[i + 1] - loop[0]);
        if (normal.norm_square() == 0.)
          return;
        normal /= normal.norm();
        distance = normal * (loop[0] - centre);
        square   = std::max(0., radius * radius - distance * distance);
        for (unsigned int i = 0; i < loop.size(); ++i)
          add_edge(loop[i] - centre, loop[(i + 1) % loop.size()] - centre);
      }

      VolumeMoments<3> sum;

    private:
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
          {
            add_outside(a, b);
            return;
          }
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

      Point<3>     centre;
      double       radius;
      Tensor<1, 3> normal;
      double       distance = 0.;
      double       square   = 0.;
    };



    // Area, first moments and area times height, integrated over the height of
    // a polyhedron given in the frame of a cylinder (third axis = its axis).
    class CylinderInPolyhedron
    {
    public:
      using Values = Tensor<1, 4>;

      CylinderInPolyhedron(
        const std::vector<ConvexPolytope<3>::PointList> &faces,
        const Tensor<1, 2>                              &centre,
        const double                                     radius,
        const Values                                    &tolerance)
        : faces(faces)
        , centre(centre)
        , radius(radius)
        , tolerance(tolerance)
        , rule(8)
      {}

      Values
      integrate() const
      {
        const std::vector<double> heights = kinks();
        Values                    sum;
        for (unsigned int i = 0; i + 1 < heights.size(); ++i)
          if (heights[i] < heights[i + 1])
            sum += adapt({heights[i], heights[i + 1]},
                         0.,
                         1.,
                         gauss({heights[i], heights[i + 1]}, 0., 1.),
                         max_halvings);
        return sum;
      }

    private:
      static constexpr unsigned int max_halvings = 20;

      Values
      slice(const double height) const
      {
        std::vector<Edge> edges;
        for (const auto &face : faces)
          {
            boost::container::small_vector<Tensor<1, 2>, 2> up, down;
            for (unsigned int i = 0; i < face.size(); ++i)
              {
                const Point<3> &a = face[i], &b = face[(i + 1) % face.size()];
                if ((a[2] < height) == (b[2] < height))
                  continue;
                const double       t = (height - a[2]) / (b[2] - a[2]);
                const Tensor<1, 2> x(
                  {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
                (b[2] > a[2] ? up : down).push_back(x);
              }
            // seen from outside, a loop goes up on the right-hand side
            for (unsigned int i = 0; i < up.size(); ++i)
              edges.emplace_back(down[i], up[i]);
          }
        const VolumeMoments<2> m = disc_moments(edges, centre, radius);
        return Values({m.volume, m.first[0], m.first[1], m.volume * height});
      }

      // Heights between which the slice's moments are smooth: of vertices, of
      // edges that meet the cylinder and of faces that touch it.
      std::vector<double>
      kinks() const
      {
        std::vector<double> heights;
        double              lowest  = std::numeric_limits<double>::infinity();
        double              highest = -lowest;
        for (const auto &face : faces)
          for (const auto &x : face)
            {
              lowest  = std::min(lowest, x[2]);
              highest = std::max(highest, x[2]);
            }
        for (const auto &face : faces)
          {
            Tensor<1, 3> normal;
            for (unsigned int i = 0; i < face.size(); ++i)
              {
                const Point<3> &a = face[i], &b = face[(i + 1) % face.size()];
                const auto [begin, end] =
                  inside_circle(Tensor<1, 2>({a[0], a[1]}) - centre,
                                Tensor<1, 2>({b[0], b[1]}) - centre,
                                radius * radius);
                heights.push_back(a[2]);
                heights.push_back(a[2] + begin * (b[2] - a[2]));
                heights.push_back(a[2] + end * (b[2] - a[2]));
                normal += cross_product_3d(a - face[0], b - face[0]);
              }
            const double across = std::hypot(normal[0], normal[1]);
            const double to_axis =
              normal * (face[0] - Point<3>(centre[0], centre[1], 0.));
            for (const double side : {-1., 1.})
              {
                const double touch =
                  (to_axis + side * radius * across) / normal[2];
                if (touch > lowest && touch < highest)
                  heights.push_back(touch);
              }
          }
        std::sort(heights.begin(), heights.end());
        return heights;
      }

      // Over the part (s, e) of an interval of heights, mapped from [0, 1]
      // with zero slope at both ends: there, moments may grow like a root
      // (x - end)^(3/2), which becomes a smooth function of s.
      Values
      gauss(const std::pair<double, double> &interval,
            const double                     begin,
            const double                     end) const
      {
        const double length = interval.second - interval.first;
        Values       sum;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const double s = begin + (end - begin) * rule.point(q)[0];
            sum += (end - begin) * rule.weight(q) * length * 6. * s * (1. - s) *
                   slice(interval.first + length * s * s * (3. - 2. * s));
          }
        return sum;
      }

      Values
      adapt(const std::pair<double, double> &interval,
            const double                     begin,
            const double                     end,
            const Values                    &whole,
            const unsigned int               n_halvings) const
      {
        const double middle = (begin + end) / 2.;
        const Values lower  = gauss(interval, begin, middle);
        const Values upper  = gauss(interval, middle, end);
        const Values change = lower + upper - whole;
        bool         fine   = true;
        for (unsigned int i = 0; i < 4; ++i)
          fine &= std::abs(change[i]) <= tolerance[i];
        if (fine || n_halvings == 0)
          return lower + upper;
        return adapt(interval, begin, middle, lower, n_halvings - 1) +
               adapt(interval, middle, end, upper, n_halvings - 1);
      }

      const std::vector<ConvexPolytope<3>::PointList> &faces;
      const Tensor<1, 2>                               centre;
      const double                                     radius;
      const Values                                     tolerance;
      const QGauss<1>                                  rule;
    };
  } // namespace



  template <int dim>
  VolumeMoments<dim>
  moments_in_ball(const ConvexPolytope<dim> &cell,
                  const Point<dim>          &centre,
                  const double               radius,
                  const Point<dim>          &reference)
  {
    if constexpr (dim == 2)
      {
        std::vector<Edge> edges;
        const auto       &x = cell.vertices();
        for (unsigned int i = 0; i < x.size(); ++i)
          edges.emplace_back(x[i] - reference,
                             x[(i + 1) % x.size()] - reference);
        return disc_moments(edges, centre - reference, radius);
      }
    else
      {
        BallInPolyhedron part(centre, radius);
        cell.for_each_face([&](const auto &loop) { part.add_face(loop); });
        part.sum.first += part.sum.volume * (centre - reference);
        return part.sum;
      }
  }

  VolumeMoments<3>
  moments_in_cylinder(const ConvexPolytope<3> &cell,
                      const Point<3>          &start,
                      const Tensor<1, 3>      &axis,
                      const double             radius,
                      const Point<3>          &reference)
  {
    unsigned int across = 0;
    for (unsigned int d = 1; d < 3; ++d)
      if (std::abs(axis[d]) < std::abs(axis[across]))
        across = d;
    std::array<Tensor<1, 3>, 3> frame;
    frame[2] = axis;
    frame[0] = cross_product_3d(Point<3>::unit_vector(across), axis);
    frame[0] /= frame[0].norm();
    frame[1] = cross_product_3d(axis, frame[0]);

    std::vector<ConvexPolytope<3>::PointList> faces;
    cell.for_each_face([&](ConvexPolytope<3>::PointList loop) {
      for (auto &x : loop)
        {
          const Tensor<1, 3> arm = x - reference;
          x = Point<3>(arm * frame[0], arm * frame[1], arm * frame[2]);
        }
      faces.push_back(loop);
    });
    const Tensor<1, 3> arm    = start - reference;
    const double       volume = cell.volume();
    const double       size   = cell.radius(cell.vertex_mean());
    const auto         m =
      CylinderInPolyhedron(faces,
                           Tensor<1, 2>({arm * frame[0], arm * frame[1]}),
                           radius,
                           1e-10 * volume *
                             Tensor<1, 4>({1., size, size, size}))
        .integrate();
    VolumeMoments<3> sum;
    sum.volume = m[0];
    for (unsigned int d = 0; d < 3; ++d)
      sum.first += m[d + 1] * frame[d];
    return sum;
  }



#define INSTANTIATE(dim)                                                   \
  template VolumeMoments<dim> moments_in_ball(const ConvexPolytope<dim> &, \
                                              const Point<dim> &,          \
                                              const double,                \
                                              const Point<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
