// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_linear_report_h
#define moraine_solver_linear_report_h

#include <deal.II/base/types.h>

#include <optional>
#include <string>

namespace moraine
{
  /** The outcome of one linear solve. */
  struct LinearReport
  {
    bool converged = false;

    /** Iterations of CG or GMRES; for a direct solver 0. */
    unsigned int iterations = 0;

    /** Whether CG or GMRES would have needed more iterations than allowed. */
    bool ran_out_of_iterations = false;

    /** Norm of b - A x over norm of b, recomputed from the solution. */
    double relative_residual = 0.;

    /** What solved it in the end, for example "direct (Mumps)". */
    std::string solver;

    /** Why it failed, or why auto fell back. Empty if all went well. */
    std::string message;

    /** The unknown that a matrix which is singular holds least. */
    std::optional<dealii::types::global_dof_index> loosest_unknown;
  };



  /** Of a residual's norm; the norm itself if the right hand side is zero. */
  inline double
  relative_to(const double value, const double reference)
  {
    return reference > 0. ? value / reference : value;
  }
} // namespace moraine

#endif
