// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_multigrid_options_h
#define moraine_solver_multigrid_options_h

#include <deal.II/lac/trilinos_precondition.h>

#include <moraine/core/linear_algebra.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <memory>
#include <vector>

namespace moraine
{
  /** ML's options for elasticity, and the modes it needs while they are used.
   * None of them has a unit. */
  class MultigridOptions
  {
  public:
    Teuchos::ParameterList list;

    MultigridOptions(const LA::SparseMatrix        &matrix,
                     const bool                     symmetric,
                     const std::vector<LA::Vector> &near_null_space,
                     const unsigned int             dim);

  private:
    std::unique_ptr<Epetra_MultiVector> modes;
  };



  /**
   * Make block Gauss-Seidel on the finest level from the values that the matrix
   * has now: of its blocks on the diagonal it keeps factors, of the rest it
   * sees every change. Other smoothers stay as they are.
   */
  void
  renew_smoother(dealii::TrilinosWrappers::PreconditionAMG &multigrid);
} // namespace moraine

#endif
