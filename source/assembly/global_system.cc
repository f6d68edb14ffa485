// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/global_system.h>

#include <algorithm>
#include <numeric>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  GlobalSystem<dim>::reinit(const GridSpace<dim>            &space_,
                            const AffineConstraints<double> &constraints_,
                            const LA::SparsityPattern       &pattern,
                            const std::vector<unsigned int> &body_of_node_,
                            const unsigned int               n_bodies)
  {
    space        = &space_;
    constraints  = &constraints_;
    body_of_node = &body_of_node_;
    squares.assign(n_bodies, 0.);
    sum_of_matrices = std::make_shared<LA::SparseMatrix>();
    sum_of_matrices->reinit(pattern);
    rows = LA::LocalRows(*sum_of_matrices);
    nodes_in_matrix.resize(space->n_nodes());
    for (unsigned int node = 0; node < space->n_nodes(); ++node)
      nodes_in_matrix[node] = find_node(node);
  }



  template <int dim>
  typename GlobalSystem<dim>::NodeInMatrix
  GlobalSystem<dim>::find_node(const unsigned int node) const
  {
    const auto         dof = space->node_dof(node);
    const NodeInMatrix first{rows.row(dof), rows.column(dof)};
    if (first.row == LA::LocalRows::none || first.column == LA::LocalRows::none)
      return {};
    for (unsigned int c = 0; c < dim; ++c)
      if (constraints->is_constrained(dof + c) ||
          rows.row(dof + c) != first.row + static_cast<int>(c) ||
          rows.column(dof + c) != first.column + static_cast<int>(c))
        return {};
    return first;
  }



  template <int dim>
  bool
  GlobalSystem<dim>::add_to_rows(const LocalSystem<dim> &local)
  {
    const unsigned int n_nodes = local.nodal_increments.size();
    for (unsigned int a = 0; a < n_nodes; ++a)
      if (nodes_in_matrix[local.nodes[a]].row == LA::LocalRows::none)
        return false;
    const auto column = [&](const unsigned int b) {
      return nodes_in_matrix[local.nodes[b]].column;
    };
    by_column.resize(n_nodes);
    std::iota(by_column.begin(), by_column.end(), 0u);
    std::sort(by_column.begin(), by_column.end(), [&](auto a, auto b) {
      return column(a) < column(b);
    });
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const int  row     = nodes_in_matrix[local.nodes[a]].row + c;
          const int *columns = rows.columns(row);
          const int *end     = columns + rows.row_length(row);
          double    *values  = rows.values(row);
          const int *found   = columns;
          for (const unsigned int b : by_column)
            {
              found = std::find(found, end, column(b));
              Assert(found != end, ExcInternalError());
              const double *K = &local.matrix(dim * a + c, dim * b);
              double       *V = values + (found - columns);
              for (unsigned int d = 0; d < dim; ++d)
                V[d] += K[d];
            }
        }
    return true;
  }



  template <int dim>
  void
  GlobalSystem<dim>::begin(const bool                         tangent,
                           const std::vector<Tensor<1, dim>> &predicted_)
  {
    with_tangent = tangent;
    predicted    = predicted_;
    std::fill(squares.begin(), squares.end(), 0.);
    node_forces.assign(space->n_nodes(), Tensor<1, dim>());
    if (tangent)
      *sum_of_matrices = 0;
  }



  template <int dim>
  void
  GlobalSystem<dim>::add(const LocalSystem<dim> &local, const bool tangent)
  {
    const unsigned int n_nodes = local.nodal_increments.size();
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < dim; ++c)
        {
          double f = local.force[dim * a + c];
          if (!predicted.empty())
            for (unsigned int b = 0; b < n_nodes; ++b)
              for (unsigned int d = 0; d < dim; ++d)
                f -= local.matrix(dim * a + c, dim * b + d) *
                     predicted[local.nodes[b]][d];
          squares[(*body_of_node)[local.nodes[a]]] += f * f;
          node_forces[local.nodes[a]][c] += f;
        }
    if (tangent && !add_to_rows(local))
      constraints->distribute_local_to_global(local.matrix,
                                              local.dofs,
                                              *sum_of_matrices);
  }



  template <int dim>
  void
  GlobalSystem<dim>::end(LA::Vector &forces)
  {
    if (with_tangent)
      sum_of_matrices->compress(VectorOperation::add);
    space->sum_node_values(node_forces, forces);
  }



  template class GlobalSystem<2>;
  template class GlobalSystem<3>;
} // namespace moraine
