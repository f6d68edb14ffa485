// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/shared_nodes.h>

#include <moraine/assembly/cell_stress.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The coordinates, from 0 to the degree, of the node @p a of a cell. */
    template <int dim>
    std::array<unsigned int, dim>
    coordinates_of_node(unsigned int a, const unsigned int degree)
    {
      std::array<unsigned int, dim> i;
      for (unsigned int d = 0; d < dim; ++d, a /= degree + 1)
        i[d] = a % (degree + 1);
      return i;
    }



    /** Area times normal of a face, away from @p centre. */
    template <int dim>
    Tensor<1, dim>
    outward_area(const std::vector<Point<dim>> &corners,
                 const Point<dim>              &centre)
    {
      Tensor<1, dim> area;
      if constexpr (dim == 2)
        area = cross_product_2d(corners[1] - corners[0]);
      else
        area = 0.5 * cross_product_3d(corners[3] - corners[0],
                                      corners[2] - corners[1]);
      return area * (corners[0] - centre) > 0 ? area : -area;
    }
  } // namespace



  template <int dim>
  Point<dim>
  place_in_balance(const StepContext<dim> &context, const unsigned int node)
  {
    const Point<dim> &x = context.state.grid().node_position(node);
    return context.balances_at_end() ? x + context.increments()[node] : x;
  }



  template <int dim>
  double
  moment_on_nodes(const GridCondition<dim> &condition,
                  const StepContext<dim>   &context,
                  const Point<dim>         &x,
                  const Tensor<1, dim>     &force)
  {
    // Nodes that nothing moves are where they were with the axis.
    const double t = context.balances_at_end() ? context.t_end :
                     context.state.mesh_after_step() == MeshAfterStep::keep ?
                                                 condition.start :
                                                 context.t_start;
    return condition.motion.moment(x, force, condition.motion.pose(t));
  }



  template <int dim>
  SharedNodes<dim>::SharedNodes(const PrescribedNodes<dim> &prescribed,
                                const unsigned int          n_conditions,
                                const GridSpace<dim>       &space)
  {
    any = Utilities::MPI::max(prescribed.shared.empty() ? 0 : 1,
                              space.communicator()) == 1;
    if (prescribed.shared.empty())
      return;
    std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>>
      conditions_of;
    for (const auto &entry : prescribed.shared)
      {
        auto &of = conditions_of[{entry.node, entry.component}];
        if (of.empty())
          of.push_back(entry.first);
        of.push_back(entry.second);
      }
    std::vector<std::vector<bool>> prescribes(
      n_conditions, std::vector<bool>(dim * space.n_nodes(), false));
    for (const auto &entry : prescribed.entries)
      prescribes[entry.condition][dim * entry.node + entry.component] = true;
    for (const auto &[place, of] : conditions_of)
      {
        unknowns.push_back({place.first, place.second, of, 0., {}});
        for (const unsigned int c : of)
          prescribes[c][dim * place.first + place.second] = true;
      }
    find_faces(prescribes, space);
  }



  template <int dim>
  typename SharedNodes<dim>::Face
  SharedNodes<dim>::face_of(const Cell              &cell,
                            const unsigned int       f,
                            const unsigned int       component,
                            const std::vector<bool> &is_shared,
                            const GridSpace<dim>    &space)
  {
    const unsigned int     degree = space.degree();
    const QGaussLobatto<1> rule(degree + 1);
    const unsigned int    *nodes = space.cell_nodes(cell);
    Face face{cell->active_cell_index(), 0, component, {}, {}, {}, {}};
    for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
      {
        const auto i = coordinates_of_node<dim>(a, degree);
        const bool is_corner =
          std::all_of(i.begin(), i.end(), [&](const auto n) {
            return n == 0 || n == degree;
          });
        if (is_corner)
          face.corners_of_cell.push_back(nodes[a]);
        if (i[f / 2] != (f % 2) * degree)
          continue;
        face.nodes.push_back(nodes[a]);
        if (is_corner)
          face.corners.push_back(nodes[a]);
        if (!is_shared[dim * nodes[a] + component])
          continue;
        double weight = 1;
        for (unsigned int e = 0; e < dim; ++e)
          if (e != f / 2)
            weight *= rule.weight(i[e]);
        face.shares.emplace_back(nodes[a], weight);
      }
    return face;
  }



  template <int dim>
  void
  SharedNodes<dim>::find_faces(const std::vector<std::vector<bool>> &prescribes,
                               const GridSpace<dim>                 &space)
  {
    std::vector<bool> is_shared(dim * space.n_nodes(), false),
      has_shared(space.n_nodes(), false);
    for (const Unknown &unknown : unknowns)
      {
        is_shared[dim * unknown.node + unknown.component] = true;
        has_shared[unknown.node]                          = true;
      }
    const auto touches = [&](const Cell &cell) {
      const unsigned int *nodes = space.cell_nodes(cell);
      return std::any_of(nodes,
                         nodes + space.nodes_per_cell(),
                         [&](const unsigned int node) {
                           return has_shared[node];
                         });
    };
    const auto take = [&](Face face) {
      for (unsigned int c = 0; c < prescribes.size(); ++c)
        if (std::all_of(face.nodes.begin(),
                        face.nodes.end(),
                        [&](const unsigned int node) {
                          return prescribes[c][dim * node + face.component];
                        }))
          {
            face.condition = c;
            faces.push_back(face);
          }
    };
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary() &&
          space.is_active(cell) && touches(cell))
        for (const unsigned int f : cell->face_indices())
          for (unsigned int d = 0; cell->face(f)->at_boundary() && d < dim; ++d)
            {
              Face face = face_of(cell, f, d, is_shared, space);
              if (!face.shares.empty())
                take(std::move(face));
            }
  }



  template <int dim>
  void
  SharedNodes<dim>::keep(const StepContext<dim> &context,
                         const LA::Vector       &unbalanced,
                         const double            factor)
  {
    const GridSpace<dim> &space = context.state.grid();
    for (Unknown &unknown : unknowns)
      {
        const auto dof = space.node_dof(unknown.node) + unknown.component;
        unknown.force =
          space.locally_owned().is_element(dof) ? factor * unbalanced(dof) : 0.;
        unknown.x = place_in_balance(context, unknown.node);
      }
  }



  template <int dim>
  std::map<std::pair<types::global_dof_index, unsigned int>, double>
  SharedNodes<dim>::tractions(const StepContext<dim> &context) const
  {
    using Key = std::pair<types::global_dof_index, unsigned int>;
    const GridSpace<dim> &space  = context.state.grid();
    const PointSet<dim>  &points = context.state.material_points();
    std::map<Key, double> here, all;
    for (const Face &face : faces)
      if (const auto sigma = stress_in_cell(points, face.cell))
        {
          Point<dim> centre;
          for (const unsigned int node : face.corners_of_cell)
            centre += space.node_position(node);
          centre /= 1. * face.corners_of_cell.size();
          std::vector<Point<dim>> corners;
          for (const unsigned int node : face.corners)
            corners.push_back(space.node_position(node));
          const Tensor<1, dim> force = *sigma * outward_area(corners, centre);
          for (const auto &[node, weight] : face.shares)
            here[{space.node_dof(node) + face.component, face.condition}] +=
              weight * force[face.component];
        }
    for (const auto &of_rank :
         Utilities::MPI::all_gather(space.communicator(), here))
      for (const auto &[key, traction] : of_rank)
        all[key] += traction;
    return all;
  }



  template <int dim>
  void
  SharedNodes<dim>::share_out(const StepContext<dim>                &context,
                              const std::vector<GridCondition<dim>> &conditions,
                              std::vector<BoundaryReport<dim>> &reports) const
  {
    if (!any)
      return;
    const GridSpace<dim>            &space       = context.state.grid();
    const auto                       of_unknowns = tractions(context);
    std::vector<BoundaryReport<dim>> changes(conditions.size());
    for (const Unknown &unknown : unknowns)
      {
        std::vector<double> t;
        double              sum = 0, size = 0;
        for (const unsigned int c : unknown.conditions)
          {
            const auto of = of_unknowns.find(
              {space.node_dof(unknown.node) + unknown.component, c});
            t.push_back(of == of_unknowns.end() ? 0. : of->second);
            sum += t.back();
            size += std::abs(t.back());
          }
        if (unknown.force == 0 || size == 0)
          continue;
        for (unsigned int k = 0; k < t.size(); ++k)
          {
            const unsigned int c = unknown.conditions[k];
            const double       share =
              t[k] + (unknown.force - sum) * std::abs(t[k]) / size;
            const double   before = k == 0 ? unknown.force : 0.;
            Tensor<1, dim> change;
            change[unknown.component] = share - before;
            changes[c].reaction += change;
            changes[c].force_magnitude += std::abs(share) - std::abs(before);
            changes[c].moment +=
              moment_on_nodes(conditions[c], context, unknown.x, change);
          }
      }
    for (unsigned int c = 0; c < changes.size(); ++c)
      {
        sum_over_ranks(changes[c], space.communicator());
        reports[c].reaction += changes[c].reaction;
        reports[c].force_magnitude += changes[c].force_magnitude;
        reports[c].moment += changes[c].moment;
      }
  }



#define INSTANTIATE(dim)                                          \
  template decltype(place_in_balance<dim>) place_in_balance<dim>; \
  template decltype(moment_on_nodes<dim>)  moment_on_nodes<dim>;  \
  template class SharedNodes<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
