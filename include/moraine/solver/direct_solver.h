// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_direct_solver_h
#define moraine_solver_direct_solver_h

#include <moraine/core/linear_algebra.h>

#include <moraine/solver/linear_report.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** A factorisation by Amesos, kept for many right hand sides. */
  class DirectSolver
  {
  public:
    /**
     * Factorise. @p matrix must live as long as this; a failure is what solve()
     * reports. @p transposed: solve with the transpose of the matrix.
     */
    explicit DirectSolver(const LA::SparseMatrix &matrix,
                          const bool              transposed = false);

    ~DirectSolver();

    /** The same for new values of the matrix in the same pattern, unless they
     * are those that are factorised but for round-off. Collective. */
    void
    refactorise();

    /** Solve with iterative refinement; the report says how well. */
    LinearReport
    solve(LA::Vector &x, const LA::Vector &b);

    /** See LinearSolver::condition_number(). */
    double
    condition_number();

  private:
    struct Factors;

    const LA::SparseMatrix                        &matrix;
    const bool                                     transposed;
    double                                         matrix_norm;
    std::string                                    package;
    std::unique_ptr<Factors>                       factors;
    std::string                                    failure;
    std::optional<dealii::types::global_dof_index> loosest_unknown;
    std::vector<double> factorised; ///< values of the matrix, this rank's

    /** Whether the matrix differs by more than round-off from what is
     * factorised. Collective. */
    bool
    has_changed() const;

    /** The first one that is there; another one if KLU fails. */
    void
    choose_package();

    /** With the order of elimination that is there or, if new, another. */
    void
    factorise(const bool is_new);

    /** Whether factorise() gave good factors; if not, failure says why. */
    bool
    check_factors(const bool may_try_another);

    bool
    back_substitute(LA::Vector &x, const LA::Vector &b);

    bool
    singular(const bool or_inaccurate);

    /** That of the largest entry of @p x, the first of several. Collective. */
    dealii::types::global_dof_index
    unknown_of_largest(const LA::Vector &x) const;

    LA::Vector
    arbitrary_vector() const;
  };
} // namespace moraine

#endif
