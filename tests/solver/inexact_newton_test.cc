// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/newton.h>

#include <gtest/gtest.h>

#include <cmath>

#include "elasticity.h"

using namespace moraine;

namespace
{
  /** K x + c x^3 = rhs, node by node, K of a body. */
  class Hardening : public NonlinearSystem
  {
  public:
    Hardening(const double c)
      : problem(40)
      , c(c)
      , r(problem.rhs)
    {
      K->reinit(*problem.matrix);
    }

    void
    initial_guess(LA::Vector &x) const override
    {
      x.reinit(problem.rhs);
    }

    void
    assemble(const LA::Vector &x, const bool tangent) override
    {
      problem.matrix->residual(r, x, problem.rhs);
      if (tangent)
        K->copy_from(*problem.matrix);
      for (const auto i : x.locally_owned_elements())
        {
          const double value = x(i);
          r(i)               = r(i) - c * value * value * value;
          if (tangent)
            K->add(i, i, 3. * c * value * value);
        }
      r.compress(dealii::VectorOperation::insert);
      if (tangent)
        K->compress(dealii::VectorOperation::add);
    }

    std::shared_ptr<const LA::SparseMatrix>
    tangent() const override
    {
      return K;
    }

    const LA::Vector &
    residual() const override
    {
      return r;
    }

    std::vector<double>
    force_scales() const override
    {
      return {problem.rhs.l2_norm()};
    }

    bool
    symmetric() const override
    {
      return true;
    }

    const std::vector<LA::Vector> &
    near_null_space() const override
    {
      return problem.modes;
    }

    void
    apply_constraints(LA::Vector &) const override
    {}

  private:
    const testing_solver::Elasticity<2>     problem;
    const double                            c;
    LA::Vector                              r;
    const std::shared_ptr<LA::SparseMatrix> K =
      std::make_shared<LA::SparseMatrix>();
  };



  NewtonReport
  solve(const std::string &solver, const double c)
  {
    LinearSolverParameters parameters;
    parameters.solver = solver;
    LinearSolver linear_solver(parameters, 2);
    Hardening    system(c);
    LA::Vector   x;
    return Newton({}).solve(system, linear_solver, x);
  }



  /** Linear iterations if each correction is solved as the last one must be. */
  unsigned int
  iterations_of_exact_newton(const double c)
  {
    LinearSolverParameters parameters;
    parameters.solver = "amg-cg";
    LinearSolver linear_solver(parameters, 2);
    Hardening    system(c);
    LA::Vector   x;
    system.initial_guess(x);
    const double goal = 1e-9 * system.force_scales()[0];
    unsigned int sum  = 0;
    for (system.assemble(x, true); system.residual().l2_norm() > goal;
         system.assemble(x, true))
      {
        LA::Vector dx(x);
        linear_solver.set_up(system.tangent(), true, system.near_null_space());
        sum +=
          linear_solver.solve(dx, system.residual(), 0.1 * goal).iterations;
        x += dx;
      }
    return sum;
  }
} // namespace

TEST(InexactNewton, SavesLinearIterationsAndStaysQuadratic)
{
  const double       c       = 1e-3;
  const NewtonReport direct  = solve("direct", c);
  const NewtonReport inexact = solve("amg-cg", c);
  ASSERT_TRUE(direct.converged()) << direct.message;
  ASSERT_TRUE(inexact.converged()) << inexact.message;
  EXPECT_GE(direct.iterations, 4u);
  EXPECT_LE(inexact.iterations, direct.iterations + 1);
  EXPECT_GT(inexact.observed_order, 1.6);
  EXPECT_LE(inexact.linear_iterations, 0.75 * iterations_of_exact_newton(c));
}

TEST(InexactNewton, ALinearProblemCostsOneCorrection)
{
  const NewtonReport report = solve("amg-cg", 0.);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.iterations, 1u);
}
