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
    const auto same_columns = [&](const int row) {
      return std::equal(rows.columns(first.row),
                        rows.columns(first.row) + rows.row_length(first.row),
                        rows.columns(row),
                        rows.columns(row) + rows.row_length(row));
    };
    for (unsigned int c = 0; c < dim; ++c)
      if (constraints->is_constrained(dof + c) ||
          rows.row(dof + c) != first.row + static_cast<int>(c) ||
          rows.column(dof + c) != first.column + static_cast<int>(c) ||
          !same_columns(first.row + c))
        return {};
    return first;
  }



  template <int dim>
  bool
  GlobalSystem<dim>::add_to_rows(const LocalSystem<dim> &local)
  {
    const unsigned int n_nodes = local.nodal_increments.size();
    by_column.resize(n_nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const int column = nodes_in_matrix[local.nodes[a]].column;
        if (column == LA::LocalRows::none)
          return false;
        by_column[a] = {column, a};
      }
    std::sort(by_column.begin(), by_column.end());
    const unsigned int n = dim * n_nodes;
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        // The rows of a node have the same columns and follow each other.
        const int          row     = nodes_in_matrix[local.nodes[a]].row;
        const unsigned int length  = rows.row_length(row);
        const int         *columns = rows.columns(row);
        const int         *end     = columns + length;
        double            *values  = rows.values(row);
        const int         *found   = columns;
        for (const auto &[column, b] : by_column)
          {
            found = std::find(found, end, column);
            Assert(found != end, ExcInternalError());
            const double *K = &local.matrix(dim * a, dim * b);
            double       *V = values + (found - columns);
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                V[c * length + d] += K[c * n + d];
            found += dim;
          }
      }
    return true;
  }



  template <int dim>
  void
  GlobalSystem<dim>::begin(const bool                         tangent,
                           const std::vector<Tensor<1, dim>> &predicted_)
  {
    first_failure.clear();
    with_tangent = tangent;
    predicted    = predicted_;
    std::fill(squares.begin(), squares.end(), 0.);
    work_sum = 0;
    node_forces.assign(space->n_nodes(), Tensor<1, dim>());
    if (tangent)
      *sum_of_matrices = 0;
  }



  template <int dim>
  void
  GlobalSystem<dim>::add(const LocalSystem<dim> &local, const bool tangent)
  {
    if (first_failure.empty())
      first_failure = local.failure;
    const unsigned int n_nodes = local.nodal_increments.size();
    if (counts_work)
      work_sum += local.work();
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
