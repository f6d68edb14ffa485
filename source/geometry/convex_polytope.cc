// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/convex_polytope.h>

#include <deal.II/boost_adaptors/segment.h>

#include <boost/geometry/algorithms/intersects.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace moraine
{
  using namespace dealii;

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
        if (next(j) != i && boost::geometry::intersects(
                              Segment<2>(vertices[i], vertices[i + 1]),
                              Segment<2>(vertices[j], vertices[next(j)])))
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



  template <int dim>
  ConvexPolytope<dim>::ConvexPolytope(const CellVertices<dim> &vertices,
                                      const double             round_off,
                                      const bool               split)
    : corner(vertices.begin(), vertices.end())
    , round_off(round_off)
  {
    set_tolerance();
    if constexpr (dim == 2)
      {
        std::swap(corner[2], corner[3]);
        loops     = {0, 1, 2, 3};
        loop_ends = {4};
      }
    else
      for (const std::array<unsigned int, 4> &face :
           {std::array<unsigned int, 4>{{0, 4, 6, 2}},
            {{1, 3, 7, 5}},
            {{0, 1, 5, 4}},
            {{2, 6, 7, 3}},
            {{0, 2, 3, 1}},
            {{4, 5, 7, 6}}})
        add_face(face, split);
  }



  template <int dim>
  ConvexPolytope<dim>::ConvexPolytope(const Point<dim> &lower,
                                      const Point<dim> &upper)
    : ConvexPolytope(cell_of<dim>({{lower, upper}}), 0., false)
  {}



  template <int dim>
  ConvexPolytope<dim>
  ConvexPolytope<dim>::polygon(const PointList &vertices,
                               const double     round_off)
  {
    ConvexPolytope<dim> result(vertices[0], vertices[0]);
    result.corner.assign(vertices.begin(), vertices.end());
    result.loops.resize(vertices.size());
    std::iota(result.loops.begin(), result.loops.end(), 0);
    result.loop_ends = {static_cast<unsigned short>(vertices.size())};
    result.round_off = round_off;
    result.set_tolerance();
    return result;
  }



  template <int dim>
  void
  ConvexPolytope<dim>::add_face(const std::array<unsigned int, 4> &q,
                                const bool                         split)
  {
    if constexpr (dim == 3)
      {
        const Tensor<1, 3> diagonal = corner[q[2]] - corner[q[0]];
        const Tensor<1, 3> normal =
          cross_product_3d(diagonal, corner[q[3]] - corner[q[1]]);
        const double height = normal * (corner[q[1]] - corner[q[0]]);
        if (!split || std::abs(height) <= 4. * round_off * normal.norm())
          {
            loops.insert(loops.end(), q.begin(), q.end());
            loop_ends.push_back(loops.size());
            return;
          }
        const unsigned short centre = corner.size();
        Point<dim>           mean;
        for (const unsigned int v : q)
          mean += 0.25 * corner[v];
        corner.push_back(mean);
        for (unsigned int i = 0; i < 4; ++i)
          {
            loops.push_back(q[i]);
            loops.push_back(q[(i + 1) % 4]);
            loops.push_back(centre);
            loop_ends.push_back(loops.size());
          }
      }
  }



  template <int dim>
  void
  ConvexPolytope<dim>::set_tolerance()
  {
    double scale = 0.;
    for (const auto &x : corner)
      scale = std::max(scale, (x - corner[0]).norm() + x.norm());
    round_off =
      std::max(round_off, 4. * std::numeric_limits<double>::epsilon() * scale);
  }



  template <int dim>
  void
  ConvexPolytope<dim>::clip(const Point<dim>       &point,
                            const Tensor<1, dim>   &inward_normal,
                            std::vector<PointList> *cut)
  {
    const double length = inward_normal.norm();
    Assert(length > 0., ExcMessage("The normal of a plane must not vanish."));
    Distances    distance(corner.size());
    bool         some_in = false, some_out = false;
    unsigned int n_on = 0;
    for (unsigned int i = 0; i < corner.size(); ++i)
      {
        distance[i] = inward_normal * (corner[i] - point) / length;
        if (std::abs(distance[i]) <= round_off)
          distance[i] = 0.;
        some_in |= distance[i] > 0.;
        some_out |= distance[i] < 0.;
        n_on += distance[i] == 0.;
      }
    if (cut != nullptr)
      cut->clear();
    if (!some_in)
      {
        corner.clear();
        loops.clear();
        loop_ends.clear();
      }
    else if (some_out || (cut != nullptr && n_on >= dim))
      clip_faces(distance, cut);
  }



  template <int dim>
  void
  ConvexPolytope<dim>::clip_faces(const Distances        &distance,
                                  std::vector<PointList> *cut)
  {
    const auto    old       = corner;
    const Indices old_loops = loops;
    const auto    old_ends  = loop_ends;
    corner.clear();
    loops.clear();
    loop_ends.clear();

    constexpr unsigned short none = -1;
    Indices                  renumber(old.size(), none);
    boost::container::small_vector<std::array<unsigned short, 3>, 16> cut_edges;
    boost::container::small_vector<bool, 32>                          on_plane;

    const auto kept_vertex = [&](const unsigned short i) {
      if (renumber[i] == none)
        {
          renumber[i] = corner.size();
          corner.push_back(old[i]);
          on_plane.push_back(distance[i] == 0.);
        }
      return renumber[i];
    };
    const auto cut_vertex = [&](const unsigned short in,
                                const unsigned short out) {
      for (const auto &edge : cut_edges)
        if (edge[0] == in && edge[1] == out)
          return edge[2];
      const unsigned short index = corner.size();
      cut_edges.push_back({{in, out, index}});
      const double way = distance[in] / (distance[in] - distance[out]);
      corner.push_back(old[in] + way * (old[out] - old[in]));
      on_plane.push_back(true);
      return index;
    };

    // the edges of the kept faces that lie in the plane
    std::vector<std::array<unsigned short, 2>> rim;

    unsigned int begin = 0;
    for (const unsigned int end : old_ends)
      {
        const unsigned int first  = loops.size();
        bool               inside = false;
        for (unsigned int k = begin; k < end; ++k)
          inside |= distance[old_loops[k]] > 0.;
        for (unsigned int k = begin; inside && k < end; ++k)
          {
            const unsigned short a = old_loops[k];
            const unsigned short b = old_loops[k + 1 < end ? k + 1 : begin];
            if (distance[a] >= 0.)
              loops.push_back(kept_vertex(a));
            if (distance[a] * distance[b] < 0.)
              loops.push_back(distance[a] > 0. ? cut_vertex(a, b) :
                                                 cut_vertex(b, a));
          }
        begin = end;
        if (!inside)
          continue;
        loop_ends.push_back(loops.size());
        for (unsigned int k = first; k < loops.size(); ++k)
          {
            const unsigned short a = loops[k];
            const unsigned short b =
              loops[k + 1 < loops.size() ? k + 1 : first];
            if (on_plane[a] && on_plane[b])
              rim.push_back({{a, b}});
          }
      }
    close_cut(rim, cut);
  }



  template <int dim>
  void
  ConvexPolytope<dim>::close_cut(
    std::vector<std::array<unsigned short, 2>> &rim,
    std::vector<PointList>                     *cut)
  {
    if (dim == 2)
      {
        if (cut != nullptr && !rim.empty())
          {
            auto &face = cut->emplace_back();
            face.push_back(corner[rim[0][0]]);
            face.push_back(corner[rim[0][1]]);
          }
        return;
      }
    // edges used in both directions are interior to the kept faces; the
    // others, reversed, bound the new face
    for (unsigned int i = 0; i < rim.size(); ++i)
      for (unsigned int j = i + 1; j < rim.size(); ++j)
        if (rim[i][0] == rim[j][1] && rim[i][1] == rim[j][0])
          {
            rim.erase(rim.begin() + j);
            rim.erase(rim.begin() + i);
            --i;
            break;
          }
    while (!rim.empty())
      {
        PointList            face;
        const unsigned short start = rim.back()[1];
        unsigned short       at    = start;
        do
          {
            const auto edge =
              std::find_if(rim.begin(), rim.end(), [&](const auto &e) {
                return e[1] == at;
              });
            Assert(edge != rim.end(), ExcMessage("A clipped face is open."));
            loops.push_back(at);
            face.push_back(corner[at]);
            at = (*edge)[0];
            rim.erase(edge);
          }
        while (at != start);
        loop_ends.push_back(loops.size());
        if (cut != nullptr)
          cut->push_back(face);
      }
  }



  template <int dim>
  VolumeMoments<dim>
  ConvexPolytope<dim>::moments(const Point<dim> &reference) const
  {
    VolumeMoments<dim> sum;
    if (corner.empty())
      return sum;
    // local coordinates keep small polytopes far from the origin exact
    const Point<dim> base = corner[0];
    for_each_face([&](const PointList &loop) {
      const Tensor<1, dim> a = loop[0] - base;
      for (unsigned int i = 1; i + 1 < loop.size(); ++i)
        {
          const Tensor<1, dim> b = loop[i] - base;
          const Tensor<1, dim> c = loop[i + 1] - base;
          double               simplex;
          if constexpr (dim == 2)
            simplex = cross(b - a, c - a) / 2.;
          else
            simplex = a * cross_product_3d(b, c) / 6.;
          sum.volume += simplex;
          // the corners of the simplex: a, b, c and, in 3D, the base (0)
          sum.first += simplex / (dim + 1.) * (a + b + c);
        }
    });
    sum.first += sum.volume * (base - reference);
    return sum;
  }



  template <int dim>
  Point<dim>
  ConvexPolytope<dim>::centroid() const
  {
    Assert(!corner.empty(), ExcMessage("An empty polytope has no centroid."));
    const Point<dim>         mean = vertex_mean();
    const VolumeMoments<dim> m    = moments(mean);
    if (!(m.volume > 0.))
      return mean;
    const Tensor<1, dim> offset = m.first / m.volume;
    return offset.norm() <= radius(mean) ? mean + offset : mean;
  }



  template <int dim>
  Point<dim>
  ConvexPolytope<dim>::vertex_mean() const
  {
    Tensor<1, dim> sum;
    for (const auto &x : corner)
      sum += x - corner[0];
    return corner[0] + sum / double(corner.size());
  }



  template <int dim>
  double
  ConvexPolytope<dim>::radius(const Point<dim> &point) const
  {
    double square = 0.;
    for (const auto &x : corner)
      square = std::max(square, (x - point).norm_square());
    return std::sqrt(square);
  }



  template <int dim>
  Point<dim>
  ConvexPolytope<dim>::pull_inside(const Point<dim> &point) const
  {
    const Point<dim> centre = centroid();
    double           way    = 1.;
    const auto       stop   = [&](const Point<dim>     &on_face,
                          const Tensor<1, dim> &outward) {
      const double from_centre = outward * (on_face - centre);
      const double from_point  = outward * (on_face - point);
      if (from_point < 0. && from_centre > 0.)
        way = std::min(way, from_centre / (from_centre - from_point));
    };
    for_each_face([&](const PointList &loop) {
      if constexpr (dim == 2)
        for (unsigned int i = 0; i < loop.size(); ++i)
          {
            const Tensor<1, 2> edge = loop[(i + 1) % loop.size()] - loop[i];
            stop(loop[i], Tensor<1, 2>({edge[1], -edge[0]}));
          }
      else
        stop(loop[0], twice_area(loop));
    });
    return way < 1. ? centre + way * (point - centre) : point;
  }



  template class ConvexPolytope<2>;
  template class ConvexPolytope<3>;
} // namespace moraine
