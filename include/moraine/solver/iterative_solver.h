// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_iterative_solver_h
#define moraine_solver_iterative_solver_h

#include <moraine/core/linear_algebra.h>

#include <moraine/solver/linear_report.h>

#include <memory>
#include <vector>

namespace dealii
{
  namespace TrilinosWrappers
  {
    class PreconditionAMG;
  }
} // namespace dealii

namespace moraine
{
  /**
   * CG or GMRES with algebraic multigrid or SchwarzPreconditioner, which is
   * kept while later values of the matrix do not take many more iterations than
   * those it was made of.
   */
  class IterativeSolver
  {
  public:
    /** Which of both, and how it is set up. */
    struct Options
    {
      bool         conjugate_gradients;
      bool         schwarz;            ///< or multigrid
      bool         symmetric;          ///< the matrix
      unsigned int dim;                ///< 2 or 3
      double       relative_tolerance; ///< norm of b - A x over norm of b
    };

    /** Make a hierarchy. @p matrix must live as long as this; the rigid-body
     * modes @p near_null_space may be empty. Collective, as the rest. */
    IterativeSolver(const LA::SparseMatrix        &matrix,
                    const Options                 &options,
                    const std::vector<LA::Vector> &near_null_space);

    ~IterativeSolver();

    /** For new values of the matrix in the same pattern.
     * @return whether that took a new hierarchy. */
    bool
    renew(const std::vector<LA::Vector> &near_null_space);

    /** Of the values that the matrix has now. */
    void
    make_hierarchy();

    /** Whether the hierarchy is made of the values of the matrix. */
    bool
    hierarchy_is_new() const
    {
      return is_new;
    }

    /**
     * Solve, to a residual norm of @p enough or the relative tolerance,
     * measured with the residual's entries times @p weights unless that is
     * null, in at most @p most iterations: an old hierarchy has to do it at
     * about what a new one would cost.
     */
    LinearReport
    solve(LA::Vector        &x,
          const LA::Vector  &b,
          const double       enough,
          const LA::Vector  *weights,
          const unsigned int most) const;

    /** Compare with the iterations that a new hierarchy took. */
    void
    watch(const LinearReport &report);

  private:
    /** CG or GMRES. @throws dealii::SolverControl::NoConvergence */
    template <typename Control, typename Matrix, typename Preconditioner>
    void
    iterate(Control              &control,
            const Matrix         &A,
            const Preconditioner &P,
            LA::Vector           &x,
            const LA::Vector     &b) const;

    unsigned int
    allowed_iterations(const double reduction, const unsigned int most) const;

    /** What rounding in A x leaves of a residual. */
    LA::Vector
    round_off(const LA::Vector &x) const;

    const LA::SparseMatrix                                     &matrix;
    const Options                                               options;
    std::vector<LA::Vector>                                     near_null_space;
    std::unique_ptr<dealii::TrilinosWrappers::PreconditionBase> preconditioner;
    bool                                                        is_new = false;
    /** Iterations for a digit with the values of its set-up; 0: not known. */
    double iterations_per_digit = 0;
    /** Iterations that later values took on top of that. */
    double extra_iterations = 0;
  };
} // namespace moraine

#endif
