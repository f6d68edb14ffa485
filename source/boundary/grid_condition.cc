// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/grid_condition.h>

#include <moraine/boundary/condition_agreement.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/object_error.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The vertices of a part of a cell, ascending; vertices, edges, faces. */
    using Part = std::array<unsigned int, 4>;

    Part
    part_of(const std::vector<unsigned int> &vertices)
    {
      Part part;
      part.fill(numbers::invalid_unsigned_int);
      std::copy(vertices.begin(), vertices.end(), part.begin());
      std::sort(part.begin(), part.end());
      return part;
    }



    /** The faces of a side with their edges and vertices. */
    template <int dim>
    std::set<Part>
    parts_of_side(const Triangulation<dim> &mesh, const types::boundary_id side)
    {
      std::set<Part> parts;
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary() && face->boundary_id() == side)
          {
            std::vector<unsigned int> corners;
            for (const unsigned int v : face->vertex_indices())
              {
                corners.push_back(face->vertex_index(v));
                parts.insert(part_of({corners.back()}));
              }
            parts.insert(part_of(corners));
            if constexpr (dim == 3)
              for (unsigned int l = 0; l < face->n_lines(); ++l)
                parts.insert(part_of({face->line(l)->vertex_index(0),
                                      face->line(l)->vertex_index(1)}));
          }
      return parts;
    }



    /** The part of a cell in which node @p a lies: its corners share with it
     * the coordinates that are not in the middle. */
    template <int dim>
    std::vector<unsigned int>
    corners_of_node(const typename GridSpace<dim>::CellIterator &cell,
                    const unsigned int                           degree,
                    const unsigned int                           a)
    {
      std::vector<unsigned int> corners;
      for (const unsigned int v : cell->vertex_indices())
        {
          bool         shares = true;
          unsigned int rest   = a;
          for (unsigned int d = 0; d < dim; ++d, rest /= degree + 1)
            {
              const unsigned int i = rest % (degree + 1);
              shares               = shares && ((i != 0 && i != degree) ||
                                  i == ((v >> d) & 1) * degree);
            }
          if (shares)
            corners.push_back(cell->vertex_index(v));
        }
      return corners;
    }



    /**
     * Flags for the nodes that lie on a side of the mesh, also those of a cell
     * that touches the side with an edge or a corner only. Every rank knows all
     * faces of the side, so ranks agree on the nodes they share.
     */
    template <int dim>
    std::vector<bool>
    nodes_on_side(const GridSpace<dim> &space, const types::boundary_id side)
    {
      const auto       &mesh  = space.mesh().triangulation();
      const auto        parts = parts_of_side<dim>(mesh, side);
      std::vector<bool> vertex_on_side(mesh.n_vertices(), false);
      for (const Part &part : parts)
        vertex_on_side[part[0]] = true;
      std::vector<bool> on_side(space.n_nodes(), false);
      for (const auto &cell : mesh.active_cell_iterators())
        if (space.knows(cell))
          {
            bool touches = false;
            for (const unsigned int v : cell->vertex_indices())
              touches = touches || vertex_on_side[cell->vertex_index(v)];
            for (unsigned int a = 0; touches && a < space.nodes_per_cell(); ++a)
              {
                const auto corners =
                  corners_of_node<dim>(cell, space.degree(), a);
                if (corners.size() < cell->n_vertices() &&
                    parts.count(part_of(corners)) > 0)
                  on_side[space.cell_nodes(cell)[a]] = true;
              }
          }
      return on_side;
    }



    template <int dim>
    PrescribedNodes<dim>
    find_nodes(const std::vector<GridCondition<dim>> &conditions,
               const GridSpace<dim>                  &space)
    {
      PrescribedNodes<dim>      prescribed;
      constexpr unsigned int    none = numbers::invalid_unsigned_int;
      std::vector<unsigned int> condition_of(dim * space.n_nodes(), none);
      for (unsigned int c = 0; c < conditions.size(); ++c)
        {
          const GridCondition<dim> &condition = conditions[c];
          std::vector<bool>         on_side;
          if (condition.side)
            on_side = nodes_on_side(space, *condition.side);
          for (unsigned int node = 0; node < space.n_nodes(); ++node)
            {
              if ((condition.side && !on_side[node]) ||
                  (condition.region && !is_inside(*condition.region,
                                                  space.built_position(node),
                                                  space.mesh().round_off())))
                continue;
              for (unsigned int d = 0; d < dim; ++d)
                if (condition.component[d])
                  {
                    unsigned int &first = condition_of[dim * node + d];
                    if (first == none)
                      {
                        first = c;
                        prescribed.entries.push_back({node, d, c});
                      }
                    else
                      prescribed.shared.push_back({node, d, first, c});
                  }
            }
        }
      return prescribed;
    }



    /** Whether two changes of a component of what is at @p x are not the same;
     * rigid motions know them to the round-off of the place. */
    template <int dim>
    bool
    differ(const Tensor<1, dim> &u,
           const Tensor<1, dim> &v,
           const unsigned int    component,
           const Point<dim>     &x,
           const GridSpace<dim> &space)
    {
      return !(std::abs(u[component] - v[component]) <=
               1e-9 * std::max(u.norm(), v.norm()) +
                 1e-14 * (x.norm() + space.mesh().cell_size()));
    }



    template <int dim>
    std::string
    complaint(const std::vector<GridCondition<dim>>       &conditions,
              const typename PrescribedNodes<dim>::Shared &shared,
              const Point<dim>                            &x)
    {
      std::ostringstream message;
      message << "'" << conditions[shared.first].name << "' and '"
              << conditions[shared.second].name << "' prescribe different "
              << "xyz"[shared.component] << " displacements at (" << x << ")";
      return message.str();
    }
  } // namespace



  template <int dim>
  PrescribedNodes<dim>
  find_prescribed_nodes(const std::vector<GridCondition<dim>> &conditions,
                        const GridSpace<dim>                  &space,
                        const double                           t_end)
  {
    const PrescribedNodes<dim> prescribed = find_nodes(conditions, space);
    for (const auto &entry : prescribed.shared)
      {
        const Point<dim> x      = space.node_position(entry.node);
        const auto       change = [&](const unsigned int c) {
          return conditions[c].increment_before(
            x, space.built_position(entry.node), conditions[c].start, t_end);
        };
        if (differ(change(entry.first),
                   change(entry.second),
                   entry.component,
                   x,
                   space))
          throw ObjectError("grid conditions",
                            "",
                            complaint(conditions, entry, x));
      }
    return prescribed;
  }



  template <int dim>
  void
  check_agreement(const std::vector<GridCondition<dim>> &conditions,
                  const GridSpace<dim>                  &space,
                  const double                           start,
                  const double                           end,
                  const unsigned int                     n_steps,
                  const bool                             nodes_follow)
  {
    const double size = (end - start) / n_steps;
    for (const auto &entry : find_nodes(conditions, space).shared)
      {
        const Point<dim> X = space.built_position(entry.node);
        Point<dim>       x = space.node_position(entry.node);
        for (unsigned int step = 0; step < n_steps; ++step)
          {
            const double t_n = start + step * size, t = t_n + size;
            const auto   u = conditions[entry.first].increment(x, X, t_n, t),
                       v   = conditions[entry.second].increment(x, X, t_n, t);
            if (differ(u, v, entry.component, x, space))
              {
                std::ostringstream message;
                message << complaint(conditions, entry, x)
                        << " from t = " << t_n << " to t = " << t << ": "
                        << u[entry.component] << " and " << v[entry.component];
                throw ObjectError("grid conditions", "", message.str());
              }
            if (nodes_follow)
              x += u;
          }
      }
  }



  template struct GridCondition<2>;
  template struct GridCondition<3>;
#define INSTANTIATE(dim)                                                    \
  template decltype(find_prescribed_nodes<dim>) find_prescribed_nodes<dim>; \
  template decltype(check_agreement<dim>)       check_agreement<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
