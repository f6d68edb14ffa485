// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/pseudo_transient.h>
#include <moraine/solver/residual_measure.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int maximum_steps = 200;

    /** Where lambda is to grow, it is at least this. */
    constexpr double least_resistance = 1e-4;



    double
    more_resistance(const double lambda)
    {
      return std::max(least_resistance, 4 * lambda);
    }



    /**
     * The resistance of the next step. Twice a negative stiffness keeps K +
     * lambda D positive along the way; one that turned the residual round was
     * too small.
     */
    double
    next_resistance(const double lambda,
                    const double work_before,
                    const double work_after,
                    const double stiffness)
    {
      if (stiffness < 0)
        return std::max(0.5 * lambda, -2 * stiffness);
      if (work_after < -0.5 * work_before)
        return std::max(least_resistance, 2 * lambda);
      return (std::abs(work_after) < 0.1 * work_before ? 0.1 : 0.5) * lambda;
    }



    /** |diag A| */
    LA::Vector
    resistances(const LA::SparseMatrix &A, const LA::Vector &like)
    {
      LA::Vector d(like);
      for (const auto i : d.locally_owned_elements())
        d(i) = std::abs(A.diag_element(i));
      d.compress(VectorOperation::insert);
      return d;
    }



    void
    add_resistance(const double      lambda,
                   const LA::Vector &d,
                   LA::SparseMatrix &A)
    {
      for (const auto i : d.locally_owned_elements())
        A.add(i, i, lambda * d(i));
      A.compress(VectorOperation::add);
    }
  } // namespace



  NewtonReport
  come_to_rest(const NewtonParameters &parameters,
               NonlinearSystem        &system,
               LinearSolver           &linear_solver,
               LA::Vector             &x,
               const Newton::Watcher  &watcher)
  {
    NewtonReport report;
    const auto   fail = [&](const NewtonStatus status, const std::string &why) {
      report.status  = status;
      report.message = why;
    };
    ResidualMeasure measure(system,
                            parameters.tolerance,
                            parameters.absolute_tolerance);
    const auto      assemble = [&]() {
      system.assemble(x, true);
      measure.update(x, true);
      return measure.finite();
    };
    const auto at_rest = [&]() {
      return !system.linearised() && measure.distance() <= 1.;
    };
    const auto record = [&]() {
      report.residuals.push_back(measure.relative());
    };

    system.initial_guess(x);
    if (!assemble())
      fail(NewtonStatus::not_a_number,
           "the residual is not a number at the start of the step");
    record();
    // One object, so that the linear solver may keep what it can.
    const auto damped = std::make_shared<LA::SparseMatrix>();
    double     lambda = 1;
    for (unsigned int n = 0; report.converged() && !at_rest(); ++n)
      {
        if (n == maximum_steps)
          {
            fail(NewtonStatus::too_many_iterations,
                 "nothing at rest after " + std::to_string(maximum_steps) +
                   " steps through a viscous medium");
            break;
          }
        const LA::Vector d = resistances(*system.tangent(), x);
        damped->copy_from(*system.tangent());
        add_resistance(lambda, d, *damped);
        linear_solver.set_up(damped,
                             system.symmetric(),
                             system.near_null_space());
        LA::Vector         dx(x);
        const LinearReport linear = linear_solver.solve(dx, system.residual());
        report.linear_solver      = linear.solver;
        report.linear_iterations += linear.iterations;
        system.apply_constraints(dx);
        const double work_before = dx * system.residual();
        if (!linear.converged || !(work_before > 0))
          {
            lambda = more_resistance(lambda);
            continue;
          }

        const LA::Vector x_start(x);
        x += dx;
        if (!assemble())
          {
            x      = x_start;
            lambda = more_resistance(lambda);
            // Not linearised any more, what was finite may not be.
            if (!assemble())
              fail(NewtonStatus::not_a_number,
                   "the residual is not a number on the way to rest");
            continue;
          }
        ++report.iterations;
        record();
        if (watcher)
          watcher({report.iterations,
                   report.residuals.back(),
                   linear.iterations,
                   1.});
        const double work_after = dx * system.residual();
        LA::Vector   d_dx(dx);
        d_dx.scale(d);
        lambda = next_resistance(lambda,
                                 work_before,
                                 work_after,
                                 (work_before - work_after) / (dx * d_dx));
      }
    linear_solver.clear();
    return report;
  }
} // namespace moraine
