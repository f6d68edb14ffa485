// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/polygon.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    // is b, known to be on the line through a and c, between them?
    bool
    between(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      return (a - b) * (c - b) <= 0.;
    }



    bool
    edges_meet(const Point<2> &a,
               const Point<2> &b,
               const Point<2> &c,
               const Point<2> &d)
    {
      const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
      const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
      return (c_side * d_side < 0. && a_side * b_side < 0.) ||
             (c_side == 0. && between(a, c, b)) ||
             (d_side == 0. && between(a, d, b)) ||
             (a_side == 0. && between(c, a, d)) ||
             (b_side == 0. && between(c, b, d));
    }
  } // namespace



  double
  polygon_area(const Polygon &polygon)
  {
    double area = 0.;
    for (unsigned int i = 2; i < polygon.size(); ++i)
      area += 0.5 * cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return area;
  }



  std::pair<unsigned int, unsigned int>
  first_crossing(const Polygon &vertices)
  {
    const unsigned int n    = vertices.size();
    const auto         next = [n](const unsigned int i) { return (i + 1) % n; };
    for (unsigned int i = 0; i < n; ++i)
      {
        const Point<2> &a = vertices[i], &b = vertices[next(i)];
        const Point<2> &c = vertices[next(next(i))];
        if (a == b)
          return {i, i};
        if (cross(b - a, c - b) == 0. && (b - a) * (c - b) < 0.)
          return {i, next(i)};
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i + 2; j < n; ++j)
        if (next(j) != i && edges_meet(vertices[i],
                                       vertices[i + 1],
                                       vertices[j],
                                       vertices[next(j)]))
          return {i, j};
    return {n, n};
  }



  // by cutting ears
  std::vector<Polygon>
  convex_parts(Polygon p)
  {
    bool is_convex = true;
    for (unsigned int i = 0; i < p.size(); ++i)
      {
        const Point<2> &b = p[(i + 1) % p.size()], &c = p[(i + 2) % p.size()];
        is_convex = is_convex && cross(b - p[i], c - b) >= 0.;
      }
    if (is_convex)
      return {p};
    std::vector<Polygon> triangles;
    const auto           is_ear = [&p](const unsigned int i) {
      const unsigned int n = p.size();
      const Point<2>     a = p[(i + n - 1) % n], b = p[i], c = p[(i + 1) % n];
      if (cross(b - a, c - b) <= 0.)
        return false;
      return std::none_of(p.begin(), p.end(), [&](const Point<2> &x) {
        return x != a && x != b && x != c && cross(b - a, x - a) >= 0. &&
               cross(c - b, x - b) >= 0. && cross(a - c, x - c) >= 0.;
      });
    };
    while (p.size() >= 3)
      {
        const unsigned int n   = p.size();
        unsigned int       ear = 0;
        while (ear < n && !is_ear(ear))
          ++ear;
        if (ear == n)
          {
            // only vertices along one straight line are left
            AssertThrow(std::abs(polygon_area(p)) <= 1e-12 *
                                                       p[0].distance(p[n / 2]) *
                                                       p[0].distance(p[n / 2]),
                        ExcInternalError());
            break;
          }
        triangles.push_back({p[(ear + n - 1) % n], p[ear], p[(ear + 1) % n]});
        p.erase(p.begin() + ear);
      }
    return triangles;
  }



  PlaneFrame::PlaneFrame(const Point<3> &origin, const Tensor<1, 3> &normal)
    : origin(origin)
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
} // namespace moraine
