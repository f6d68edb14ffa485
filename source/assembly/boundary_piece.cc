// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/boundary_piece.h>
#include <moraine/state/motion.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  BoundaryPiece<dim>::reinit(const ImplicitBoundary<dim> &boundary,
                             const StepContext<dim>      &context,
                             const unsigned int           first,
                             const double                 share)
  {
    const auto &points = boundary.points();
    this->boundary     = &boundary;
    first_point        = first;
    cell_index         = points[first].cell;
    find_nodes(context.state);
    increments.clear();
    constraints.clear();
    double missed = 0, area = 0;
    for (unsigned int q = first;
         q < points.size() && points[q].cell == cell_index;
         ++q)
      {
        set_place(q);
        increments.push_back(increment_here(context.increments()));
        constraints.push_back(
          boundary.constraint_state(points[q], increments.back().value, share));
        const ConstraintState<dim> &state = constraints.back();
        missed += points[q].JxW * (state.normal * state.violation);
        area += points[q].JxW;
      }
    for (ConstraintState<dim> &state : constraints)
      state.mean_violation = missed / area;
  }



  template <int dim>
  void
  BoundaryPiece<dim>::find_nodes(const State<dim> &state)
  {
    const GridSpace<dim> &space = state.grid();
    n_of_cell                   = space.nodes_per_cell();
    const unsigned int *first   = space.cell_nodes(cell_index);
    node_numbers.assign(first, first + n_of_cell);
    mean_grad_N.assign(n_of_cell, Tensor<1, dim>());
    state.mean_of_cell(cell_index, parts);
    for (const auto &part : parts)
      for (unsigned int a = 0; a < n_of_cell; ++a)
        {
          const unsigned int node = space.cell_nodes(part.cell)[a];
          const auto         found =
            std::find(node_numbers.begin(), node_numbers.end(), node);
          const auto place = found - node_numbers.begin();
          if (found == node_numbers.end())
            {
              node_numbers.push_back(node);
              mean_grad_N.emplace_back();
            }
          mean_grad_N[place] += part.weight * part.gradients[a];
        }
    N.assign(node_numbers.size(), 0.);
    grad_N.assign(node_numbers.size(), Tensor<1, dim>());
  }



  template <int dim>
  void
  BoundaryPiece<dim>::set_place(const unsigned int q)
  {
    std::copy_n(boundary->N(q), n_of_cell, N.begin());
    std::copy_n(boundary->grad_N(q), n_of_cell, grad_N.begin());
    if (parts.empty())
      std::copy_n(boundary->grad_N(q), n_of_cell, mean_grad_N.begin());
  }



  template <int dim>
  typename BoundaryPiece<dim>::Increment
  BoundaryPiece<dim>::increment_here(
    const std::vector<Tensor<1, dim>> &nodal) const
  {
    Increment du;
    for (unsigned int a = 0; a < node_numbers.size(); ++a)
      {
        const Tensor<1, dim> &u = nodal[node_numbers[a]];
        du.value += N[a] * u;
        du.gradient += outer_product(u, grad_N[a]);
        du.mean_gradient += outer_product(u, mean_grad_N[a]);
      }
    return du;
  }



  template class BoundaryPiece<2>;
  template class BoundaryPiece<3>;
} // namespace moraine
