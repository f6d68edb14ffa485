// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/held_off_bodies.h>

#include <moraine/run/drawn_bodies.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <set>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a cell: what is held further from a body is told of. */
    constexpr double told_distance = 0.1;



    /** Whether a body has been drawn less than told_distance of a cell from @p
     * x. */
    template <int dim>
    bool
    is_near_a_body(const Point<dim> &x, const Model<dim> &model)
    {
      for (const unsigned int corner : GeometryInfo<dim>::vertex_indices())
        {
          Tensor<1, dim> way;
          for (unsigned int d = 0; d < dim; ++d)
            way[d] = ((corner >> d) & 1 ? told_distance : -told_distance) *
                     model.mesh->cell_size();
          if (in_a_body(x + way, model))
            return true;
        }
      return false;
    }



    /** Whether a place of a face, of a lattice on it, is what @p is_it says. */
    template <typename Face, typename Predicate>
    bool
    any_of_face(const Face &face, const Predicate &is_it)
    {
      constexpr unsigned int n = 5; // along an edge
      const unsigned int     m = face->n_vertices() == 4 ? n : 1;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < m; ++j)
          {
            const double s = i / (n - 1.), t = j / (n - 1.);
            auto         x = (1 - s) * face->vertex(0) + s * face->vertex(1);
            if (m > 1)
              x = (1 - t) * x +
                  t * ((1 - s) * face->vertex(2) + s * face->vertex(3));
            if (is_it(x))
              return true;
          }
      return false;
    }



    /** Of the nodes of a condition: those off bodies, all. Collective. */
    template <int dim>
    std::vector<unsigned int>
    nodes_off_bodies(const GridCondition<dim> &condition,
                     const Model<dim>         &model,
                     const double              t)
    {
      const GridSpace<dim>  &space = *model.space;
      std::set<unsigned int> nodes;
      for (const auto &entry :
           find_prescribed_nodes<dim>({condition}, space, t).entries)
        if (space.locally_owned().is_element(space.node_dof(entry.node)))
          nodes.insert(entry.node);
      std::vector<unsigned int> n(2, 0);
      for (const unsigned int node : nodes)
        {
          n[0] += !is_near_a_body(space.node_position(node), model);
          ++n[1];
        }
      Utilities::MPI::sum(n, space.communicator(), n);
      return n;
    }
  } // namespace



  template <int dim>
  void
  tell_of_held_off_bodies(const std::vector<GridCondition<dim>> &conditions,
                          const Model<dim>                      &model,
                          const double                           t,
                          std::vector<std::string>              &notes)
  {
    if (!are_drawn(model.bodies))
      return;
    for (const auto &condition : conditions)
      {
        // Pieces of the side, or nodes: off bodies, all.
        std::vector<unsigned int> n(2, 0);
        if (condition.side)
          for (const auto &cell :
               model.mesh->triangulation().active_cell_iterators())
            {
              if (model.space->is_active(cell))
                for (const auto &face : cell->face_iterators())
                  if (face->at_boundary() &&
                      face->boundary_id() == *condition.side)
                    {
                      n[0] += !any_of_face(face, [&](const Point<dim> &x) {
                        return is_near_a_body(x, model);
                      });
                      ++n[1];
                    }
            }
        else
          n = nodes_off_bodies(condition, model, t);
        // A body may lie between the nodes that it moves.
        if (n[0] == 0 || (condition.side ? 2 * n[0] <= n[1] : n[0] < n[1]))
          continue;
        notes.push_back(
          condition.name + ": " + std::to_string(n[0]) + " of the " +
          std::to_string(n[1]) + (condition.side ? " faces" : " nodes") +
          " that it holds are off the bodies, which end before these and are "
          "held as if they went on to there; let them end on faces of cells, "
          "or hold their rim in section 'Boundaries'");
      }
  }



  template void
  tell_of_held_off_bodies(const std::vector<GridCondition<2>> &,
                          const Model<2> &,
                          const double,
                          std::vector<std::string> &);
  template void
  tell_of_held_off_bodies(const std::vector<GridCondition<3>> &,
                          const Model<3> &,
                          const double,
                          std::vector<std::string> &);
} // namespace moraine
