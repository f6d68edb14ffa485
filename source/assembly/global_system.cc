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
                            const ConstraintTable           &table_,
                            const Couplings<dim>            &couplings,
                            const std::vector<unsigned int> &body_of_node_,
                            const unsigned int               n_bodies)
  {
    space        = &space_;
    table        = &table_;
    constraints  = &table_.homogeneous();
    body_of_node = &body_of_node_;
    squares.assign(n_bodies, 0.);
    sum_of_matrices = std::make_shared<LA::SparseMatrix>();
    couplings.make_matrix(*constraints, *sum_of_matrices);
    rows = LA::LocalRows(*sum_of_matrices);
    nodes_in_matrix.resize(space->n_nodes());
    for (unsigned int node = 0; node < space->n_nodes(); ++node)
      nodes_in_matrix[node] = find_node(node);
    find_ghost_rows(couplings);
    tied_rows.clear();
    for (const auto dof : space->locally_owned())
      if (const auto *line = constraints->get_constraint_entries(dof))
        if (!line->empty())
          tied_rows.push_back(dof);
    any_tied =
      Utilities::MPI::logical_or(!tied_rows.empty(), space->communicator());
  }



  template <int dim>
  typename GlobalSystem<dim>::NodeInMatrix
  GlobalSystem<dim>::find_node(const unsigned int node) const
  {
    const auto   dof = space->node_dof(node);
    NodeInMatrix first;
    first.row    = rows.row(dof);
    first.column = rows.column(dof);
    if (first.column == LA::LocalRows::none)
      return {};
    const bool is_here      = first.row != LA::LocalRows::none;
    const auto same_columns = [&](const int row) {
      return std::equal(rows.columns(first.row),
                        rows.columns(first.row) + rows.row_length(first.row),
                        rows.columns(row),
                        rows.columns(row) + rows.row_length(row));
    };
    for (unsigned int c = 0; c < dim; ++c)
      if (constraints->is_constrained(dof + c) ||
          rows.column(dof + c) != first.column + static_cast<int>(c) ||
          (is_here && (rows.row(dof + c) != first.row + static_cast<int>(c) ||
                       !same_columns(first.row + c))))
        return {};
    return first;
  }



  template <int dim>
  void
  GlobalSystem<dim>::find_ghost_rows(const Couplings<dim> &couplings)
  {
    const DynamicSparsityPattern        &nodes = couplings.of_nodes();
    std::vector<GhostRows::Block>        blocks;
    std::vector<types::global_dof_index> columns;
    for (unsigned int node = 0; node < space->n_nodes(); ++node)
      {
        NodeInMatrix &at = nodes_in_matrix[node];
        if (at.column == LA::LocalRows::none || at.row != LA::LocalRows::none ||
            nodes.row_length(node) == 0)
          continue;
        by_column.clear();
        for (unsigned int k = 0; k < nodes.row_length(node); ++k)
          {
            const unsigned int other = nodes.column_number(node, k);
            if (nodes_in_matrix[other].column != LA::LocalRows::none)
              by_column.emplace_back(nodes_in_matrix[other].column, other);
          }
        std::sort(by_column.begin(), by_column.end());
        columns.clear();
        for (const auto &entry : by_column)
          for (unsigned int c = 0; c < dim; ++c)
            columns.push_back(space->node_dof(entry.second) + c);
        at.ghost = blocks.size();
        blocks.push_back({space->node_dof(node), columns});
      }
    ghost_rows = GhostRows(
      blocks, dim, rows, space->locally_owned(), space->communicator());
  }



  template <int dim>
  void
  GlobalSystem<dim>::add_rows_of_node(const LocalSystem<dim> &local,
                                      const unsigned int      a,
                                      const unsigned int      length,
                                      const int              *columns,
                                      double                 *values) const
  {
    const unsigned int n     = dim * local.nodal_increments.size();
    const int         *end   = columns + length;
    const int         *found = columns;
    for (const auto &[column, b] : by_column)
      {
        found = std::find(found, end, column);
        AssertThrow(found != end, ExcInternalError());
        const double *K = &local.matrix(dim * a, dim * b);
        double       *V = values + (found - columns);
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            V[c * length + d] += K[c * n + d];
        found += dim;
      }
  }



  template <int dim>
  void
  GlobalSystem<dim>::add_to_matrix(const LocalSystem<dim> &local)
  {
    const unsigned int n_nodes = local.nodal_increments.size();
    by_column.clear();
    bool whole = false;
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const int column = nodes_in_matrix[local.nodes[a]].column;
        if (column != LA::LocalRows::none)
          by_column.emplace_back(column, a);
        else
          for (unsigned int r = dim * a; r < dim * (a + 1); ++r)
            whole = whole || local.matrix(r, r) == 0.;
      }
    // Of a diagonal with nothing on it deal.II takes the mean of all others.
    if (whole)
      {
        rest = local.matrix;
        return add_rest(local);
      }
    std::sort(by_column.begin(), by_column.end());
    add_to_rows(local);
    if (by_column.size() == n_nodes)
      return;
    rest = local.matrix;
    for (const auto &[row, a] : by_column)
      for (const auto &[column, b] : by_column)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            rest(dim * a + c, dim * b + d) = 0;
    add_rest(local);
  }



  template <int dim>
  void
  GlobalSystem<dim>::add_rest(const LocalSystem<dim> &local)
  {
    if (table->any_taken())
      for (unsigned int r = 0; r < local.dofs.size(); ++r)
        if (table->taken().is_element(local.dofs[r]))
          for (unsigned int s = 0; s < local.dofs.size(); ++s)
            rest(r, s) = 0;
    constraints->distribute_local_to_global(rest, local.dofs, *sum_of_matrices);
  }



  template <int dim>
  void
  GlobalSystem<dim>::add_to_rows(const LocalSystem<dim> &local)
  {
    for (const auto &entry : by_column)
      {
        const unsigned int  a  = entry.second;
        const NodeInMatrix &at = nodes_in_matrix[local.nodes[a]];
        if (at.ghost == LA::LocalRows::none)
          // The rows of a node have the same columns and follow each other.
          add_rows_of_node(local,
                           a,
                           rows.row_length(at.row),
                           rows.columns(at.row),
                           rows.values(at.row));
        else
          add_rows_of_node(local,
                           a,
                           ghost_rows.row_length(at.ghost),
                           ghost_rows.columns(at.ghost),
                           ghost_rows.values(at.ghost));
      }
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
    if (!tangent)
      return;
    *sum_of_matrices = 0;
    ghost_rows.set_zero();
  }



  template <int dim>
  void
  GlobalSystem<dim>::add(const LocalSystem<dim> &local, const bool tangent)
  {
    if (first_failure.empty())
      first_failure = local.failure;
    const unsigned int n_nodes = local.nodal_increments.size();
    if (is_counting)
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
    if (tangent)
      add_to_matrix(local);
  }



  template <int dim>
  void
  GlobalSystem<dim>::end(LA::Vector &forces)
  {
    if (with_tangent)
      {
        ghost_rows.add_to_owners();
        sum_of_matrices->compress(VectorOperation::add);
        if (any_tied)
          scale_tied_rows();
      }
    space->sum_node_values(node_forces, forces);
  }



  template <int dim>
  void
  GlobalSystem<dim>::scale_tied_rows()
  {
    double largest = 0;
    for (const auto dof : space->locally_owned())
      largest = std::max(largest, std::abs(sum_of_matrices->diag_element(dof)));
    largest = Utilities::MPI::max(largest, space->communicator());
    for (const auto dof : tied_rows)
      sum_of_matrices->set(dof, dof, largest);
    sum_of_matrices->compress(VectorOperation::insert);
  }



  template class GlobalSystem<2>;
  template class GlobalSystem<3>;
} // namespace moraine
