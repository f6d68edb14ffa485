// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/cell_cut.h>

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
  bool
  may_touch(const CellVertices<dim> &cell, const BoundingBox<dim> &box)
  {
    const BoundingBox<dim> around(cell);
    const double           slack = 1e-6 * cell_size<dim>(cell);
    for (unsigned int d = 0; d < dim; ++d)
      if (around.lower_bound(d) > box.upper_bound(d) + slack ||
          around.upper_bound(d) < box.lower_bound(d) - slack)
        return false;
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



#define INSTANTIATE(dim)                                       \
  template bool may_touch<dim>(const CellVertices<dim> &,      \
                               const BoundingBox<dim> &);      \
  template std::vector<std::vector<Point<dim>>> cut_cell<dim>( \
    const CellVertices<dim> &,                                 \
    const std::array<double, (1 << dim)> &,                    \
    const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
