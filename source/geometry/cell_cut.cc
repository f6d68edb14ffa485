// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/cell_cut.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    using Edge = std::pair<unsigned int, unsigned int>;

    Edge
    make_edge(const unsigned int a, const unsigned int b)
    {
      return {std::min(a, b), std::max(a, b)};
    }

    /**
     * The crossed edges of a quadrilateral (vertices in cyclic order), joined
     * in pairs. With four crossings each inside vertex is cut off by itself, so
     * the answer does not depend on the cell from which a face is seen.
     */
    template <std::size_t n>
    void
    join_crossings(const std::array<unsigned int, 4>  &cycle,
                   const std::array<double, n>        &distance,
                   std::vector<std::pair<Edge, Edge>> &links)
    {
      std::vector<Edge> entering, leaving;
      for (unsigned int i = 0; i < 4; ++i)
        {
          const unsigned int a = cycle[i], b = cycle[(i + 1) % 4];
          if (distance[a] <= 0. && distance[b] > 0.)
            entering.push_back(make_edge(a, b));
          else if (distance[a] > 0. && distance[b] <= 0.)
            leaving.push_back(make_edge(a, b));
        }
      if (entering.empty())
        return;
      if (entering.size() == 1)
        links.emplace_back(entering[0], leaving[0]);
      else
        {
          // alternating signs; the inside vertices are cycle[1 or 0] and
          // opposite
          const unsigned int first = distance[cycle[0]] > 0. ? 0 : 1;
          for (const unsigned int i : {first, first + 2})
            links.emplace_back(make_edge(cycle[(i + 3) % 4], cycle[i]),
                               make_edge(cycle[i], cycle[(i + 1) % 4]));
        }
    }

    template <int dim>
    Point<dim>
    crossing(const CellVertices<dim>              &cell,
             const std::array<double, (1 << dim)> &distance,
             const Edge                           &edge)
    {
      unsigned int a = edge.first, b = edge.second;
      if (distance[a] == 0.)
        return cell[a];
      if (distance[b] == 0.)
        return cell[b];
      for (unsigned int d = 0; d < dim; ++d)
        if (cell[a][d] != cell[b][d])
          {
            if (cell[a][d] > cell[b][d])
              std::swap(a, b);
            break;
          }
      return cell[a] +
             (distance[a] / (distance[a] - distance[b])) * (cell[b] - cell[a]);
    }

    template <int dim>
    std::vector<std::pair<Edge, Edge>>
    links_of_cell(const std::array<double, (1 << dim)> &distance)
    {
      std::vector<std::pair<Edge, Edge>> links;
      if constexpr (dim == 2)
        join_crossings({{0, 1, 3, 2}}, distance, links);
      else
        for (unsigned int d = 0; d < 3; ++d)
          {
            const unsigned int u = 1u << ((d + 1) % 3), v = 1u << ((d + 2) % 3);
            for (const unsigned int o : {0u, 1u << d})
              join_crossings({{o, o + u, o + u + v, o + v}}, distance, links);
          }
      return links;
    }

    /** Chains of crossed edges; closed ones in 3D, where each edge has two
     * links. */
    std::vector<std::vector<Edge>>
    trace(std::vector<std::pair<Edge, Edge>> links)
    {
      std::vector<std::vector<Edge>> chains;
      while (!links.empty())
        {
          std::vector<Edge> chain{links[0].first, links[0].second};
          links.erase(links.begin());
          while (chain.back() != chain.front())
            {
              const auto next =
                std::find_if(links.begin(), links.end(), [&](const auto &link) {
                  return link.first == chain.back() ||
                         link.second == chain.back();
                });
              if (next == links.end())
                break;
              chain.push_back(next->first == chain.back() ? next->second :
                                                            next->first);
              links.erase(next);
            }
          if (chain.back() == chain.front())
            chain.pop_back();
          chains.push_back(chain);
        }
      return chains;
    }
  } // namespace

  template <int dim>
  double
  coordinate_magnitude(const Point<dim> &x)
  {
    double magnitude = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      magnitude = std::max(magnitude, std::abs(x[d]));
    return magnitude;
  }

  template <int dim>
  double
  cell_size(const CellVertices<dim> &cell)
  {
    double size = 0.;
    for (const auto &vertex : cell)
      size = std::max(size, vertex.distance(cell[0]));
    return size;
  }

  template <int dim>
  bool
  may_touch(const CellVertices<dim> &cell, const BoundingBox<dim> &box)
  {
    const double slack = 1e-6 * cell_size<dim>(cell);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto range =
          std::minmax_element(cell.begin(),
                              cell.end(),
                              [d](const auto &a, const auto &b) {
                                return a[d] < b[d];
                              });
        if ((*range.first)[d] > box.upper_bound(d) + slack ||
            (*range.second)[d] < box.lower_bound(d) - slack)
          return false;
      }
    return true;
  }

  template <int dim>
  std::vector<std::vector<Point<dim>>>
  cut_cell(const CellVertices<dim>              &cell,
           const std::array<double, (1 << dim)> &distance,
           const double                          magnitude)
  {
    const double size    = std::max(magnitude, cell_size<dim>(cell));
    auto         snapped = distance;
    bool         inside = false, outside = false;
    for (unsigned int v = 0; v < cell.size(); ++v)
      {
        const double tolerance =
          std::ldexp(std::max(size, coordinate_magnitude<dim>(cell[v])), -44);
        if (std::abs(distance[v]) <= tolerance)
          snapped[v] = 0.;
        (snapped[v] > 0. ? inside : outside) = true;
      }
    std::vector<std::vector<Point<dim>>> result;
    if (!inside || !outside)
      return result;
    for (const auto &chain : trace(links_of_cell<dim>(snapped)))
      {
        result.emplace_back();
        for (const auto &edge : chain)
          result.back().push_back(crossing<dim>(cell, snapped, edge));
      }
    return result;
  }

  template <int dim>
  void
  add_segment_points(const Point<dim>               &origin,
                     const Tensor<1, dim>           &direction,
                     const Stretch                  &stretch,
                     const Tensor<1, dim>           &normal,
                     const unsigned int              n_gauss,
                     std::vector<SurfacePoint<dim>> &out)
  {
    const QGauss<1> gauss(n_gauss);
    const double    length = stretch.to - stretch.from;
    for (unsigned int q = 0; q < gauss.size(); ++q)
      out.push_back(
        {origin + (stretch.from + gauss.point(q)[0] * length) * direction,
         normal,
         gauss.weight(q) * length});
  }

  PlaneFrame::PlaneFrame(const Point<3> &origin, const Tensor<1, 3> &n)
    : origin(origin)
    , normal(n / n.norm())
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

  Point<2>
  PlaneFrame::to_plane(const Point<3> &x) const
  {
    return {(x - origin) * first, (x - origin) * second};
  }

  Polygon
  PlaneFrame::to_plane(const std::vector<Point<3>> &points) const
  {
    Polygon polygon;
    for (const auto &x : points)
      polygon.push_back(to_plane(x));
    return polygon;
  }

  Point<3>
  PlaneFrame::to_space(const Point<2> &p) const
  {
    return origin + p[0] * first + p[1] * second;
  }

  namespace
  {
    /** Without vertices that repeat, to 1e-15 of the size. */
    Polygon
    without_repeats(const Polygon &polygon, const double size)
    {
      Polygon result;
      for (const auto &p : polygon)
        if (result.empty() || p.distance(result.back()) > 1e-15 * size)
          result.push_back(p);
      while (result.size() > 1 &&
             result.back().distance(result.front()) <= 1e-15 * size)
        result.pop_back();
      return result;
    }

    /** Points of the affine image of a reference cell at @p o with edges a, b.
     */
    void
    add_affine_points(const Quadrature<2>          &rule,
                      const Point<2>               &o,
                      const Tensor<1, 2>           &a,
                      const Tensor<1, 2>           &b,
                      const PlaneFrame             &frame,
                      const Tensor<1, 3>           &normal,
                      std::vector<SurfacePoint<3>> &out)
    {
      const double jacobian = cross(a, b);
      for (unsigned int q = 0; q < rule.size(); ++q)
        out.push_back(
          {frame.to_space(o + rule.point(q)[0] * a + rule.point(q)[1] * b),
           normal,
           rule.weight(q) * jacobian});
    }
  } // namespace

  void
  add_polygon_points(const Polygon                &polygon,
                     const PlaneFrame             &frame,
                     const Tensor<1, 3>           &normal,
                     const unsigned int            n_gauss,
                     std::vector<SurfacePoint<3>> &out)
  {
    AssertThrow(n_gauss >= 1 && n_gauss <= 7,
                ExcMessage("Plane pieces in 3D need 1 to 7 Gauss points."));
    double size = 0.;
    for (const auto &p : polygon)
      size = std::max(size, p.distance(polygon[0]));
    auto p = without_repeats(polygon, size);
    if (polygon_area(p) < 0.)
      std::reverse(p.begin(), p.end());
    if (polygon_area(p) <= 1e-15 * size * size)
      return;
    if (p.size() == 4 && (p[0] - p[1] + (p[2] - p[3])).norm() <= 1e-14 * size)
      {
        add_affine_points(QGauss<2>(n_gauss),
                          p[0],
                          p[1] - p[0],
                          p[3] - p[0],
                          frame,
                          normal,
                          out);
        return;
      }
    const QWitherdenVincentSimplex<2> rule(n_gauss);
    for (unsigned int i = 2; i < p.size(); ++i)
      add_affine_points(
        rule, p[0], p[i - 1] - p[0], p[i] - p[0], frame, normal, out);
  }

#define INSTANTIATE(dim)                                         \
  template double coordinate_magnitude<dim>(const Point<dim> &); \
  template double cell_size<dim>(const CellVertices<dim> &);     \
  template bool   may_touch<dim>(const CellVertices<dim> &,      \
                               const BoundingBox<dim> &);      \
  template std::vector<std::vector<Point<dim>>> cut_cell<dim>(   \
    const CellVertices<dim> &,                                   \
    const std::array<double, (1 << dim)> &,                      \
    const double);                                               \
  template void add_segment_points<dim>(const Point<dim> &,      \
                                        const Tensor<1, dim> &,  \
                                        const Stretch &,         \
                                        const Tensor<1, dim> &,  \
                                        const unsigned int,      \
                                        std::vector<SurfacePoint<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
