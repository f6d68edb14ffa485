// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_block_factors_h
#define moraine_solver_block_factors_h

#include <memory>
#include <vector>

namespace moraine
{
  /**
   * Factors of a small sparse matrix of one rank, by UMFPACK. For use within a
   * preconditioner: without the iterative refinement that
   * dealii::SparseDirectUMFPACK always does, which takes most of its time.
   */
  class BlockFactors
  {
  public:
    /** Rows one after the other, columns in ascending order. */
    struct Rows
    {
      std::vector<int>    begins, columns;
      std::vector<double> values;
    };

    explicit BlockFactors(const Rows &rows);

    /** Whether the matrix is singular to working precision, and solve() cannot
     * be called. */
    bool
    is_singular() const
    {
      return factors == nullptr;
    }

    void
    solve(std::vector<double> &x, const std::vector<double> &b) const;

  private:
    std::shared_ptr<void>       factors;
    mutable std::vector<int>    indices; ///< what solve() works with
    mutable std::vector<double> values;
  };
} // namespace moraine

#endif
