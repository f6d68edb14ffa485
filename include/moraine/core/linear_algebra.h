// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_linear_algebra_h
#define moraine_core_linear_algebra_h

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
  } // namespace LA
} // namespace moraine

#endif
