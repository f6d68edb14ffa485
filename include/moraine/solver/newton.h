// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_newton_h
#define moraine_solver_newton_h

#include <moraine/solver/linear_solver.h>
#include <moraine/solver/nonlinear_system.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** Keys of the section "Solver" that steer Newton's method. */
  struct NewtonParameters
  {
    /** Norm of the residual over NonlinearSystem::force_scales(); what is small
     * besides that says ResidualMeasure. */
    double tolerance = 1e-9;

    /** A residual norm (force) below this is zero whatever the scale. */
    double absolute_tolerance = 0.;

    unsigned int maximum_iterations = 25;

    bool line_search = true;

    /** stop, or pseudo-transient: go on at another equilibrium. */
    std::string limit_points = "auto";

    /** Updates of carried multipliers in one step. */
    unsigned int maximum_augmentations = 50;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };



  enum class NewtonStatus
  {
    converged,
    diverged,
    linear_solver_failed,
    too_many_iterations,
    not_a_number,
    not_held ///< a body, before the first iteration
  };

  /** The status in words, for messages. */
  std::string
  to_string(const NewtonStatus status);



  /** What one nonlinear solve did. */
  struct NewtonReport
  {
    NewtonStatus status = NewtonStatus::converged;

    /** Corrections computed, those of augmentations included. */
    unsigned int iterations = 0;

    unsigned int linear_iterations = 0;

    /** Of the linear solver, which is why it failed. */
    bool ran_out_of_linear_iterations = false;

    unsigned int augmentations = 0;

    /** Of the last tangent, if the linear solver is to estimate it. */
    std::optional<double> condition_number;

    /** Relative residual at the start and after each correction. */
    std::vector<double> residuals;

    /**
     * Slope of log(residual) over the last three residuals above round-off
     * before the first augmentation. Zero where that says nothing: unless all
     * three, and one before them, come after the first two digits are won.
     */
    double observed_order = 0.;

    /** The linear solver's name. */
    std::string linear_solver;

    /** One sentence on what went wrong, or what the linear solver noted. */
    std::string message;

    bool
    converged() const
    {
      return status == NewtonStatus::converged;
    }
  };



  /** One correction, for who watches Newton's method. */
  struct NewtonIteration
  {
    unsigned int number;            ///< from 1 on in each step
    double       residual;          ///< after it, over the forces
    unsigned int linear_iterations; ///< of this correction alone
    double       length;            ///< 1 unless the line search cut it
  };



  /**
   * Newton's method with backtracking. A step that does not converge is a
   * status in the report, never an exception. A linear problem costs one
   * tangent, one linear solve and one more residual.
   */
  class Newton
  {
  public:
    explicit Newton(const NewtonParameters &parameters);

    /** Solve r(x) = 0 from system.initial_guess(). On return @p x is the last
     * iterate; it is a solution only if the report says converged. */
    NewtonReport
    solve(NonlinearSystem &system, LinearSolver &linear_solver, LA::Vector &x);

    /**
     * The same, but along come_to_rest(): to an equilibrium that may be far
     * away, where a path of equilibria ends. Begins with start_over(), for a
     * solution that failed leaves its multipliers.
     */
    NewtonReport
    pseudo_transient(NonlinearSystem &system,
                     LinearSolver    &linear_solver,
                     LA::Vector      &x);

    using Watcher = std::function<void(const NewtonIteration &)>;

    /** Call @p watcher after each correction. */
    void
    watch(const Watcher &watcher);

  private:
    const NewtonParameters parameters;
    Watcher                watcher;
  };
} // namespace moraine

#endif
