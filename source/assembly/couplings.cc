// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/couplings.h>

#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Couplings<dim>::Couplings(const GridSpace<dim> &space)
    : space(space)
    , nodes(space.n_nodes())
  {}



  template <int dim>
  void
  Couplings<dim>::add(const unsigned int *batch, const unsigned int n)
  {
    sorted.assign(batch, batch + n);
    std::sort(sorted.begin(), sorted.end());
    for (const unsigned int node : sorted)
      nodes.add_entries(node, sorted.begin(), sorted.end(), true);
  }



  template <int dim>
  void
  Couplings<dim>::make_matrix(const AffineConstraints<double> &constraints,
                              LA::SparseMatrix                &matrix) const
  {
    DynamicSparsityPattern               pattern(space.n_dofs(),
                                   space.n_dofs(),
                                   space.locally_relevant());
    std::vector<types::global_dof_index> rows(dim), columns;
    for (unsigned int node = 0; node < nodes.n_rows(); ++node)
      if (const unsigned int length = nodes.row_length(node))
        {
          columns.clear();
          for (unsigned int k = 0; k < length; ++k)
            for (unsigned int c = 0; c < dim; ++c)
              columns.push_back(space.node_dof(nodes.column_number(node, k)) +
                                c);
          for (unsigned int c = 0; c < dim; ++c)
            {
              rows[c] = space.node_dof(node) + c;
              if (constraints.is_constrained(rows[c]))
                pattern.add(rows[c], rows[c]);
            }
          constraints.add_entries_local_to_global(rows,
                                                  columns,
                                                  pattern,
                                                  false);
        }
    SparsityTools::distribute_sparsity_pattern(pattern,
                                               space.locally_owned(),
                                               space.communicator(),
                                               space.locally_relevant());
    LA::make_matrix(matrix,
                    space.locally_owned(),
                    pattern,
                    space.communicator());
  }



  template class Couplings<2>;
  template class Couplings<3>;
} // namespace moraine
