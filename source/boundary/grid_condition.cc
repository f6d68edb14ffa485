// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/grid_condition.h>

#include <moraine/core/exceptions.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    bool
    inside(const BoundingBox<dim> &box, const Point<dim> &x, const double by)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (x[d] < box.lower_bound(d) - by || x[d] > box.upper_bound(d) + by)
          return false;
      return true;
    }



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



    /**
     * The part of a cell in which node @p a lies: its corners share with it the
     * coordinates that are not in the middle.
     */
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
  } // namespace



  template <int dim>
  PrescribedNodes<dim>
  find_prescribed_nodes(const std::vector<GridCondition<dim>> &conditions,
                        const GridSpace<dim>                  &space,
                        const double                           t_end)
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
            const Point<dim> &x = space.node_position(node);
            if ((condition.side && !on_side[node]) ||
                (condition.region && !inside(*condition.region,
                                             x,
                                             1e-9 * space.mesh().cell_size())))
              continue;
            for (unsigned int d = 0; d < dim; ++d)
              if (condition.component[d])
                {
                  const unsigned int other = condition_of[dim * node + d];
                  if (other == none)
                    {
                      condition_of[dim * node + d] = c;
                      prescribed.entries.push_back({node, d, c});
                    }
                  else if (std::abs(conditions[other].value(x, t_end)[d] -
                                    condition.value(x, t_end)[d]) > 1e-12)
                    {
                      std::ostringstream message;
                      message << "section 'Grid conditions': '"
                              << conditions[other].name << "' and '"
                              << condition.name << "' prescribe different "
                              << "xyz"[d] << " displacements at (" << x << ")";
                      throw InputError(message.str());
                    }
                }
          }
      }
    return prescribed;
  }



  template struct GridCondition<2>;
  template struct GridCondition<3>;
  template PrescribedNodes<2>
  find_prescribed_nodes(const std::vector<GridCondition<2>> &,
                        const GridSpace<2> &,
                        const double);
  template PrescribedNodes<3>
  find_prescribed_nodes(const std::vector<GridCondition<3>> &,
                        const GridSpace<3> &,
                        const double);
} // namespace moraine
