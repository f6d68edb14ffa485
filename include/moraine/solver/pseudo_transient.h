// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_pseudo_transient_h
#define moraine_solver_pseudo_transient_h

#include <moraine/solver/newton.h>

namespace moraine
{
  /**
   * Find the equilibrium at which a body comes to rest that moves through a
   * viscous medium, D dx/dtau = r(x), D = |diag K|. Where the path of
   * equilibria ends (a limit point) that leads to the state behind the end, to
   * which Newton's method finds no way.
   *
   * Implicit Euler, one linearisation a step: (K + lambda D) dx = r with lambda
   * = 1/dtau, which ends as Newton's method (pseudo-transient continuation,
   * Kelley and Keyes 1998, doi 10.1137/S0036142996304796). They let lambda
   * follow the norm of the residual. That norm grows on the way through
   * unstable states, so here lambda follows the stiffness
   * c = (g_0 - g_1) / (dx D dx) found along the last correction, where g_0 and
   * g_1 are the work dx r per step before and after it.
   *
   * @param system the equations; its multipliers stay as they are
   * @param linear_solver left without a matrix
   * @param parameters the tolerances are those of Newton's method
   * @param x at the end the last iterate; it starts from
   * NonlinearSystem::initial_guess()
   * @param watcher called after each correction
   * @return converged, too_many_iterations or not_a_number
   */
  NewtonReport
  come_to_rest(const NewtonParameters &parameters,
               NonlinearSystem        &system,
               LinearSolver           &linear_solver,
               LA::Vector             &x,
               const Newton::Watcher  &watcher = {});
} // namespace moraine

#endif
