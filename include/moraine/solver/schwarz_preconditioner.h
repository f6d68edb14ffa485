// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_schwarz_preconditioner_h
#define moraine_solver_schwarz_preconditioner_h

#include <deal.II/lac/trilinos_precondition.h>

#include <moraine/core/linear_algebra.h>

#include <moraine/solver/coarse_space.h>
#include <moraine/solver/overlapping_rows.h>
#include <moraine/solver/subdomains.h>

#include <memory>
#include <vector>

namespace moraine
{
  /**
   * The additive Schwarz method of two levels,
   *
   *   M^-1 = P A_0^-1 P^T + sum_s R_s^T (R_s A R_s^T)^-1 R_s,
   *
   * with subdomains s that overlap by two layers of the graph of the matrix,
   * all factorised, and the CoarseSpace P. Iterations depend little on
   * Poisson's ratio up to 0.5, where those of algebraic multigrid do not end
   * (Dohrmann and Widlund 2009, doi 10.1137/080724320).
   */
  class SchwarzPreconditioner
    : public dealii::TrilinosWrappers::PreconditionBase
  {
  public:
    /**
     * @p modes are the rigid-body modes, or none. The unknowns of a node are
     * the @p block that follow each other; @p dim is 2 or 3. Collective.
     */
    SchwarzPreconditioner(const LA::SparseMatrix        &matrix,
                          const std::vector<LA::Vector> &modes,
                          const unsigned int             dim,
                          const unsigned int             block);

    using PreconditionBase::vmult;

    /** dst = M^-1 src. Collective. */
    void
    vmult(LA::Vector &dst, const LA::Vector &src) const override;

  private:
    /** Unknowns, as rows, and the factors of their block of the matrix. */
    struct Overlapping
    {
      std::vector<unsigned int> unknowns;
      BlockFactors              factors;
    };

    const OverlappingRows       rows;
    const Subdomains            subdomains;
    const CoarseSpace           coarse_space;
    std::vector<Overlapping>    overlapping;
    mutable std::vector<double> source, target;
  };
} // namespace moraine

#endif
