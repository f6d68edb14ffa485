// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/grid_condition.h>

#include <moraine/core/exceptions.h>

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



    /** Flags for the nodes that lie on a side of the mesh. */
    template <int dim>
    std::vector<bool>
    nodes_on_side(const GridSpace<dim> &space, const types::boundary_id side)
    {
      const unsigned int k = space.degree();
      std::vector<bool>  on_side(space.n_nodes(), false);
      for (const auto &cell :
           space.mesh().triangulation().active_cell_iterators())
        if (space.knows(cell) && cell->at_boundary())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() &&
                cell->face(f)->boundary_id() == side)
              for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
                {
                  unsigned int index = a;
                  for (unsigned int d = 0; d < f / 2; ++d)
                    index /= k + 1;
                  if (index % (k + 1) == (f % 2) * k)
                    on_side[space.cell_nodes(cell)[a]] = true;
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
