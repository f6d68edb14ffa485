// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_schwarz_preconditioner_h
#define moraine_solver_schwarz_preconditioner_h

#include <deal.II/lac/trilinos_precondition.h>

#include <moraine/core/linear_algebra.h>

namespace moraine
{
  /**
   * The additive Schwarz method
   *
   * @f[ M^{-1} = \sum_s R_s^T (R_s A R_s^T)^{-1} R_s @f]
   *
   * with one subdomain s for each rank, which takes some layers of the graph of
   * the matrix from other ranks, by Trilinos' Ifpack; each block is factorised.
   * On one rank it is the inverse.
   */
  class SchwarzPreconditioner
    : public dealii::TrilinosWrappers::PreconditionBase
  {
  public:
    /** @p dim, 2 or 3, chooses the layers. If a block cannot be factorised, all
     * is the identity. Collective. */
    SchwarzPreconditioner(const LA::SparseMatrix &matrix,
                          const unsigned int      dim);

    using PreconditionBase::vmult;

    /** @f$dst = M^{-1} src@f$. Collective. */
    void
    vmult(LA::Vector &dst, const LA::Vector &src) const override;
  };
} // namespace moraine

#endif
