// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_linear_solver_h
#define moraine_solver_linear_solver_h

#include <moraine/core/linear_algebra.h>
#include <moraine/core/simulation_state.h>

#include <moraine/solver/linear_report.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** Keys of linear solvers, in the section "Solver". */
  struct LinearSolverParameters
  {
    /** auto, direct, amg-cg, gmres or schwarz. */
    std::string solver = "auto";

    /** Of iterative solvers: norm of b - A x over norm of b. */
    double relative_tolerance = 1e-10;

    /** Of iterative solvers. */
    unsigned int maximum_iterations = 500;

    /** In 2D, auto solves directly up to this many unknowns. */
    unsigned int direct_limit_2d = 20000;

    /** In 3D, auto solves directly up to this many unknowns. */
    unsigned int direct_limit_3d = 5000;

    /** Whether LinearSolver::condition_number() gives one. */
    bool estimate_condition_number = false;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };



  /**
   * Solves K dx = r by a factorisation or by a preconditioned Krylov method.
   * What set_up() builds is kept until the next set_up() or clear(), so that
   * many right hand sides can be solved with it.
   *
   * Failures (a singular matrix, no convergence) are reported, not thrown: the
   * residual is always recomputed from the solution, and an answer that is not
   * finite or does not satisfy the equations is never called converged.
   */
  class LinearSolver : public StatePart
  {
  public:
    /**
     * @p dim, 2 or 3, only chooses the limit of auto.
     */
    LinearSolver(const LinearSolverParameters &parameters,
                 const unsigned int            dim);

    ~LinearSolver() override;

    /**
     * Factorise @p matrix or build its preconditioner. A matrix that is set up
     * again with other values in the same pattern keeps its order of
     * elimination and, while the iteration does not suffer, the coarse levels
     * of the multigrid hierarchy and its estimates of eigenvalues.
     *
     * The rigid-body modes @p near_null_space are for algebraic multigrid; they
     * may be empty.
     */
    void
    set_up(const std::shared_ptr<const LA::SparseMatrix> &matrix,
           const bool                                     symmetric,
           const std::vector<LA::Vector>                 &near_null_space);

    /**
     * Solve with what set_up() built. The start value of @p x is not used; if
     * the report says not converged, @p x is zero. Iterative solvers may stop
     * at a residual norm of @p enough, and measure it with the residual's
     * entries times @p weights (positive) unless that is null. Where auto
     * solves directly what it began with an iterative solver, the report says
     * so. It goes on directly while that is cheaper, see doc/topics/solvers.md.
     */
    LinearReport
    solve(LA::Vector       &x,
          const LA::Vector &b,
          const double      enough  = 0.,
          const LA::Vector *weights = nullptr);

    /**
     * An estimate of the condition number of the matrix given to set_up(), in
     * the 2-norm: the ratio of its largest to its smallest singular value.
     * Power iterations with K^T K and with its inverse approach both from
     * inside, so the estimate is a lower bound, as a rule within a few per
     * cent. Costs up to a few hundred back substitutions, and a factorisation
     * if K is solved iteratively. Infinite if K is singular; nothing if the
     * parameters do not ask for it or no matrix is set up.
     */
    std::optional<double>
    condition_number() const;

    /** Whether a factorisation solves, by choice or because auto fell back. */
    bool
    solves_directly() const;

    /** Forget what set_up() built, and the matrix. */
    void
    clear();

    /** Data sets "solver/...": what auto goes by, and what it chose so far.
     * What set_up() built is not among them. */
    void
    write(Archive &archive) const override;

    /** The same, and clear(). */
    void
    read(const Archive &archive) override;

    /** What solved first, and each change that auto made, with its reason. */
    const std::vector<std::string> &
    choices() const;

    /** How many times set_up() was called. */
    unsigned int
    n_set_ups() const;

    /** Wall time spent in set_up() so far. */
    double
    set_up_seconds() const;

    /** Wall time spent in solve() so far. */
    double
    solve_seconds() const;

    /** Wall time spent in condition_number() so far. */
    double
    condition_seconds() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace moraine

#endif
