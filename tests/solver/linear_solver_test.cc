// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include "elasticity.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <moraine/solver/linear_solver.h>
#include <moraine/solver/multigrid_options.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using namespace moraine;
using moraine::testing_solver::Elasticity;

namespace
{
  LinearSolverParameters
  use(const std::string &solver)
  {
    LinearSolverParameters parameters;
    parameters.solver = solver;
    return parameters;
  }

  /** |b - A x| / |b| */
  template <int dim>
  double
  true_residual(const Elasticity<dim> &problem, const LA::Vector &x)
  {
    LA::Vector residual(problem.rhs);
    return problem.matrix->residual(residual, x, problem.rhs) /
           problem.rhs.l2_norm();
  }

  template <int dim>
  LA::Vector
  solve(const Elasticity<dim> &problem,
        const std::string     &name,
        const bool             symmetric = true)
  {
    LinearSolver solver(use(name), dim);
    solver.set_up(problem.matrix, symmetric, problem.modes);
    LA::Vector         x(problem.rhs);
    const LinearReport report = solver.solve(x, problem.rhs);
    EXPECT_TRUE(report.converged) << name << ": " << report.message;
    EXPECT_EQ(report.message, "");
    const double residual = true_residual(problem, x);
    EXPECT_LT(residual, 1e-9) << name;
    EXPECT_NEAR(report.relative_residual, residual, 1e-3 * residual);
    return x;
  }

  template <int dim>
  unsigned int
  multigrid_iterations(const unsigned int n, const unsigned int n_modes)
  {
    Elasticity<dim> problem(n);
    problem.modes.resize(n_modes);
    LinearSolver solver(use("amg-cg"), dim);
    solver.set_up(problem.matrix, true, problem.modes);
    LA::Vector         x(problem.rhs);
    const LinearReport report = solver.solve(x, problem.rhs);
    EXPECT_TRUE(report.converged) << report.message;
    return report.iterations;
  }

  template <int dim>
  void
  expect_same_answers(const unsigned int n)
  {
    const Elasticity<dim> symmetric(n);
    const LA::Vector      direct = solve(symmetric, "direct");
    for (const char *name : {"auto", "amg-cg", "gmres", "schwarz"})
      {
        LA::Vector difference(solve(symmetric, name));
        difference -= direct;
        EXPECT_LT(difference.l2_norm(), 1e-8 * direct.l2_norm()) << name;
      }

    const Elasticity<dim> convected(n, true, 1.);
    const LA::Vector      reference = solve(convected, "direct", false);
    for (const char *name : {"gmres", "schwarz"})
      {
        LA::Vector difference(solve(convected, name, false));
        difference -= reference;
        EXPECT_LT(difference.l2_norm(), 1e-8 * reference.l2_norm()) << name;
      }
  }



  /** Of CG with the Schwarz preconditioner at a Poisson ratio. */
  template <int dim>
  unsigned int
  schwarz_iterations(const unsigned int n, const double poisson)
  {
    const Elasticity<dim> problem(n, true, 0., 0., poisson);
    LinearSolver          solver(use("schwarz"), dim);
    solver.set_up(problem.matrix, true, problem.modes);
    LA::Vector         x(problem.rhs);
    const LinearReport report = solver.solve(x, problem.rhs);
    EXPECT_TRUE(report.converged) << report.message;
    EXPECT_EQ(report.solver, "schwarz");
    // Round-off, which grows with the condition number.
    EXPECT_LT(true_residual(problem, x), 1e-8);
    return report.iterations;
  }
} // namespace

TEST(LinearSolver, AllSolversAgreeIn2d)
{
  expect_same_answers<2>(24);
}

TEST(LinearSolver, AllSolversAgreeIn3d)
{
  expect_same_answers<3>(6);
}

TEST(LinearSolver, MultigridIterationsStayBounded)
{
  const unsigned int coarse = multigrid_iterations<2>(32, 3);
  const unsigned int fine   = multigrid_iterations<2>(128, 3);
  EXPECT_LE(fine, 1.6 * coarse);
  EXPECT_LE(fine, 25u);
}

TEST(LinearSolver, RotationsInTheNearNullSpacePay)
{
  EXPECT_LT(multigrid_iterations<2>(48, 3),
            0.8 * multigrid_iterations<2>(48, 2));
  EXPECT_LT(multigrid_iterations<3>(8, 6), 0.8 * multigrid_iterations<3>(8, 3));
}

TEST(LinearSolver, SchwarzIterationsStayBoundedWhereVolumeIsKeptIn2d)
{
  EXPECT_LE(schwarz_iterations<2>(48, 0.4999),
            2 * schwarz_iterations<2>(48, 0.3));
}

TEST(LinearSolver, SchwarzIterationsStayBoundedWhereVolumeIsKeptIn3d)
{
  const unsigned int n = 14, few = schwarz_iterations<3>(n, 0.3);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      EXPECT_GT(few, 10u) << "several subdomains";
    }
  EXPECT_LE(schwarz_iterations<3>(n, 0.4999), 2 * few);
}

TEST(LinearSolver, SchwarzWithoutRigidBodyModes)
{
  Elasticity<2> problem(24);
  problem.modes.clear();
  solve(problem, "schwarz");
}

// Newmark's method, average acceleration: 4 / (time step)^2 times the mass.
TEST(LinearSolver, InertiaNeedsNoSmoothCoarseSpace)
{
  const unsigned int n         = 12;
  const auto         is_smooth = [](const Elasticity<3> &problem) {
    const MultigridOptions options(*problem.matrix, true, problem.modes, 3);
    return options.list.get<double>("aggregation: damping factor") > 0;
  };
  for (const double courant : {2., 9., 20., 80.})
    {
      const double        steps = 1.346 * n * n / (courant * courant);
      const Elasticity<3> problem(n, true, 0., 4. * steps);
      EXPECT_EQ(is_smooth(problem), courant > 12) << courant;
      solve(problem, "amg-cg");
    }
  EXPECT_TRUE(is_smooth(Elasticity<3>(8)));
}

TEST(LinearSolver, KeepsTheFactorisation)
{
  const Elasticity<2> problem(16);
  LinearSolver        solver(use("direct"), 2);
  solver.set_up(problem.matrix, true, problem.modes);
  LA::Vector x(problem.rhs), b(problem.rhs), exact(problem.rhs);
  for (unsigned int k = 1; k <= 3; ++k)
    {
      for (const auto i : exact.locally_owned_elements())
        exact(i) = std::sin(1. * k * i);
      exact.compress(dealii::VectorOperation::insert);
      problem.matrix->vmult(b, exact);
      EXPECT_TRUE(solver.solve(x, b).converged);
      x -= exact;
      EXPECT_LT(x.linfty_norm(), 1e-12);
    }
  EXPECT_EQ(solver.n_set_ups(), 1u);
}

TEST(LinearSolver, NothingToSolve)
{
  const Elasticity<2> problem(4);
  for (const char *name : {"direct", "amg-cg", "gmres", "schwarz"})
    {
      LinearSolver solver(use(name), 2);
      solver.set_up(problem.matrix, true, problem.modes);
      LA::Vector x(problem.rhs), b(problem.rhs);
      b                         = 0.;
      const LinearReport report = solver.solve(x, b);
      EXPECT_TRUE(report.converged) << name;
      EXPECT_EQ(report.iterations, 0u);
      EXPECT_EQ(x.l2_norm(), 0.);
    }
}

TEST(LinearSolver, SaysThatABodyIsNotHeld)
{
  // Under its weight a free body cannot be in equilibrium.
  const Elasticity<2> free_2d(24, false);
  const Elasticity<3> free_3d(5, false);
  for (const char *name : {"direct", "amg-cg", "gmres", "schwarz", "auto"})
    {
      LinearSolver solver(use(name), 2);
      solver.set_up(free_2d.matrix, true, free_2d.modes);
      LA::Vector         x(free_2d.rhs);
      const LinearReport report = solver.solve(x, free_2d.rhs);
      EXPECT_FALSE(report.converged) << name;
      EXPECT_NE(report.message, "");
      EXPECT_EQ(x.l2_norm(), 0.);
    }
  for (const char *name : {"direct", "schwarz"}) // of one subdomain
    {
      LinearSolver solver(use(name), 3);
      solver.set_up(free_3d.matrix, true, free_3d.modes);
      LA::Vector x(free_3d.rhs);
      EXPECT_FALSE(solver.solve(x, free_3d.rhs).converged) << name;
    }
}

TEST(LinearSolver, SaysThatABodyIsNotHeldEvenIfTheLoadBalances)
{
  const Elasticity<2> problem(16, false);
  LA::Vector          displacement(problem.rhs), b(problem.rhs), x(problem.rhs);
  for (const auto i : displacement.locally_owned_elements())
    displacement(i) = std::sin(0.1 * i);
  displacement.compress(dealii::VectorOperation::insert);
  problem.matrix->vmult(b, displacement);
  LinearSolver solver(use("direct"), 2);
  solver.set_up(problem.matrix, true, problem.modes);
  const LinearReport report = solver.solve(x, b);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.message, "the matrix is singular to working precision");
  // Held least is where the motion that is free is largest: its components are
  // linear as those of the rotation are, so that is at an edge of the square.
  ASSERT_TRUE(report.loosest_unknown);
  double from_edge = 0;
  if (problem.modes[2].in_local_range(*report.loosest_unknown))
    {
      const double turn = std::abs(problem.modes[2](*report.loosest_unknown));
      from_edge         = std::min(turn, 1 - turn);
    }
  EXPECT_LT(from_edge, 1e-10);
}

TEST(LinearSolver, StiffRowsAreNotSingular)
{
  // Terms 1e12 stiffer than the rest, as a boundary enforced in a thin band.
  Elasticity<2> problem(16);
  for (const auto i : problem.rhs.locally_owned_elements())
    if (i % 7 == 0)
      problem.matrix->add(i, i, 1e12);
  problem.matrix->compress(dealii::VectorOperation::add);
  LinearSolver solver(use("direct"), 2);
  solver.set_up(problem.matrix, true, problem.modes);
  LA::Vector         x(problem.rhs);
  const LinearReport report = solver.solve(x, problem.rhs);
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_LT(true_residual(problem, x), 1e-11);
}

TEST(LinearSolver, EstimatesTheConditionNumber)
{
  // Blocks s (1 a; 0 1): the singular values of one are s (r + a/2) and
  // s (r - a/2), r^2 = 1 + a^2/4. The eigenvalues, all s, would tell less.
  // (Not held, so that the pattern has both components of every node.)
  const Elasticity<2> problem(12, false);
  const auto          matrix = std::make_shared<LA::SparseMatrix>();
  matrix->reinit(*problem.matrix);
  const double a = 3, r = std::sqrt(1 + a * a / 4), largest_s = 1e5;
  for (const auto i : problem.rhs.locally_owned_elements())
    {
      const double s = i / 2 == 7 ? largest_s : 1 + 0.5 * std::sin(i / 2);
      matrix->set(i, i, i / 2 == 20 ? 0.1 : s);
      if (i % 2 == 0)
        matrix->set(i, i + 1, a * (i / 2 == 20 ? 0.1 : s));
    }
  matrix->compress(dealii::VectorOperation::insert);
  const double exact = largest_s / 0.1 * (r + a / 2) / (r - a / 2);
  for (const char *name : {"direct", "gmres"})
    {
      LinearSolverParameters parameters    = use(name);
      parameters.estimate_condition_number = true;
      LinearSolver solver(parameters, 2);
      EXPECT_FALSE(solver.condition_number().has_value());
      solver.set_up(matrix, false, problem.modes);
      EXPECT_NEAR(solver.condition_number().value() / exact, 1, 1e-3) << name;
    }

  const Elasticity<2>    not_held(12, false);
  LinearSolverParameters parameters    = use("direct");
  parameters.estimate_condition_number = true;
  LinearSolver solver(parameters, 2);
  solver.set_up(not_held.matrix, true, not_held.modes);
  EXPECT_FALSE(std::isfinite(solver.condition_number().value()));
}

TEST(LinearSolver, ReportsANumberThatIsNone)
{
  Elasticity<2> problem(8);
  // deal.II's debug mode lets no such entry in; overflow makes some.
  *problem.matrix *= 1e200;
  *problem.matrix *= 1e200;
  for (const char *name : {"direct", "amg-cg", "gmres", "schwarz", "auto"})
    {
      LinearSolver solver(use(name), 2);
      solver.set_up(problem.matrix, true, problem.modes);
      LA::Vector         x(problem.rhs);
      const LinearReport report = solver.solve(x, problem.rhs);
      EXPECT_FALSE(report.converged);
      EXPECT_EQ(report.message, "the matrix has entries that are not numbers");
    }
}

TEST(LinearSolver, AutoChoosesBySizeAndFallsBack)
{
  const Elasticity<2>    problem(32);
  LinearSolverParameters parameters;
  LA::Vector             x(problem.rhs);

  LinearSolver by_default(parameters, 2);
  by_default.set_up(problem.matrix, true, problem.modes);
  EXPECT_EQ(by_default.solve(x, problem.rhs).solver.substr(0, 6), "direct");

  parameters.direct_limit_2d = 100;
  LinearSolver large(parameters, 2);
  large.set_up(problem.matrix, true, problem.modes);
  EXPECT_EQ(large.solve(x, problem.rhs).solver, "amg-cg");
  large.set_up(problem.matrix, false, problem.modes);
  EXPECT_EQ(large.solve(x, problem.rhs).solver, "gmres");

  parameters.maximum_iterations = 3;
  LinearSolver impatient(parameters, 2);
  impatient.set_up(problem.matrix, true, problem.modes);
  const LinearReport report = impatient.solve(x, problem.rhs);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.solver.substr(0, 6), "direct");
  EXPECT_EQ(report.message,
            "direct from linear system 1 on, 2178 unknowns: amg-cg did not "
            "converge in 3 iterations");
  EXPECT_EQ(report.iterations, 3u);
  EXPECT_LT(true_residual(problem, x), 1e-11);
  // It does not try again at once, and said why.
  impatient.set_up(problem.matrix, true, problem.modes);
  const LinearReport next = impatient.solve(x, problem.rhs);
  EXPECT_EQ(next.message, "");
  EXPECT_EQ(next.iterations, 0u);
  ASSERT_EQ(impatient.choices().size(), 2u);
  EXPECT_EQ(impatient.choices()[0],
            "amg-cg from linear system 1 on, 2178 unknowns");
  EXPECT_EQ(impatient.choices()[1], report.message);

  parameters.solver = "amg-cg";
  LinearSolver stubborn(parameters, 2);
  stubborn.set_up(problem.matrix, true, problem.modes);
  EXPECT_FALSE(stubborn.solve(x, problem.rhs).converged);
}

namespace
{
  /** Row and column i of a symmetric matrix by factors of 1 to @p spread. */
  void
  scale_symmetrically(LA::SparseMatrix &matrix, const double spread)
  {
    const auto factor = [spread](const unsigned int i) {
      return 1 + (spread - 1) * 0.5 * (1 + std::sin(0.7 * (i / 2)));
    };
    for (const auto i : matrix.locally_owned_range_indices())
      for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
        entry->value() = entry->value() * factor(i) * factor(entry->column());
    matrix.compress(dealii::VectorOperation::insert);
  }
} // namespace

TEST(LinearSolver, NewValuesInTheSamePattern)
{
  for (const char *name : {"direct", "amg-cg", "gmres", "schwarz"})
    {
      const Elasticity<2> problem(24);
      LinearSolver        solver(use(name), 2);
      LA::Vector          x(problem.rhs);
      for (const double spread : {1., 1.1, 3., 30.})
        {
          scale_symmetrically(*problem.matrix, spread);
          solver.set_up(problem.matrix, true, problem.modes);
          const LinearReport report = solver.solve(x, problem.rhs);
          EXPECT_TRUE(report.converged) << name << ": " << report.message;
          EXPECT_LT(true_residual(problem, x), 1e-9) << name << ", " << spread;
        }
    }
}

TEST(LinearSolver, PivotsThatAreGoodNoLonger)
{
  // (a 1; 1 0) blocks: with a = 0 elimination has to change its order.
  const Elasticity<2> problem(12, false);
  const auto          matrix = std::make_shared<LA::SparseMatrix>();
  matrix->reinit(*problem.matrix);
  LinearSolver solver(use("direct"), 2);
  LA::Vector   x(problem.rhs), b(problem.rhs), exact(problem.rhs);
  for (const auto i : exact.locally_owned_elements())
    exact(i) = std::sin(1. * i);
  exact.compress(dealii::VectorOperation::insert);
  for (const double a : {1., 1e-17, 0.})
    {
      for (const auto i : exact.locally_owned_elements())
        {
          matrix->set(i, i, i % 2 == 0 ? a : 0);
          matrix->set(i, i % 2 == 0 ? i + 1 : i - 1, 1);
        }
      matrix->compress(dealii::VectorOperation::insert);
      matrix->vmult(b, exact);
      solver.set_up(matrix, false, problem.modes);
      const LinearReport report = solver.solve(x, b);
      EXPECT_TRUE(report.converged) << report.message;
      x -= exact;
      EXPECT_LT(x.linfty_norm(), 1e-12) << a;
    }
}

TEST(LinearSolver, KeepsTheHierarchyWhileItServes)
{
  LA::Vector x(Elasticity<2>(48).rhs);
  const auto iterations = [&x](LinearSolver &solver, const auto &problem) {
    solver.set_up(problem.matrix, true, problem.modes);
    return solver.solve(x, problem.rhs).iterations;
  };
  // Scaled values suffer under the hierarchy of the old ones: it is replaced.
  const Elasticity<2> problem(48), same(48);
  LinearSolver        keeps(use("amg-cg"), 2), fresh(use("amg-cg"), 2);
  iterations(keeps, problem);
  scale_symmetrically(*problem.matrix, 1.1);
  scale_symmetrically(*same.matrix, 1.1);
  const unsigned int best  = iterations(fresh, same);
  const unsigned int first = iterations(keeps, problem);
  EXPECT_GT(first, best) << first << ' ' << best;
  unsigned int n = 0, last = first;
  for (; n < 20 && last > best; ++n)
    last = iterations(keeps, problem);
  EXPECT_EQ(last, best);
  EXPECT_LT(n, 10u);
}

namespace
{
  /** Add springs across lines at an angle to all nodes at y = 0. */
  template <int dim>
  void
  add_rollers(const Elasticity<dim> &problem,
              const double           degrees,
              const double           stiffness)
  {
    dealii::Tensor<1, dim> normal;
    normal[0] = std::sin(degrees * dealii::numbers::PI / 180);
    normal[1] = std::cos(degrees * dealii::numbers::PI / 180);
    std::set<dealii::types::global_dof_index> done;
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        {
          const auto i = cell->vertex_dof_index(v, 0);
          if (cell->vertex(v)[1] == 0. && problem.rhs.in_local_range(i) &&
              !problem.constraints.is_constrained(i) && done.insert(i).second)
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                problem.matrix->add(i + c,
                                    i + d,
                                    stiffness * normal[c] * normal[d]);
        }
    problem.matrix->compress(dealii::VectorOperation::add);
  }



  /** Iterations of gmres for a cell's moduli of one and rollers with a hundred.
   * The second number: after rollers along the mesh, with what they left. */
  template <int dim>
  std::pair<unsigned int, unsigned int>
  iterations_of_rollers(const unsigned int n, const double degrees)
  {
    const double    stiffness = 100. * std::pow(1. / n, dim - 2);
    Elasticity<dim> problem(n), other(n);
    LA::Vector      x(problem.rhs);
    LinearSolver    fresh(use("gmres"), dim), kept(use("gmres"), dim);
    const auto      solve = [&x](LinearSolver &solver, auto &held) {
      solver.set_up(held.matrix, false, held.modes);
      const LinearReport report = solver.solve(x, held.rhs);
      EXPECT_TRUE(report.converged) << report.message;
      return report.iterations;
    };
    add_rollers(problem, degrees, stiffness);
    add_rollers(other, 0., stiffness);
    const unsigned int first = solve(fresh, problem);
    solve(kept, other);
    add_rollers(other, 0., -stiffness);
    add_rollers(other, degrees, stiffness);
    return {first, solve(kept, other)};
  }
} // namespace

TEST(LinearSolver, RollersAtAnAngle)
{
  const auto compare = [](const auto &along, const auto &across) {
    EXPECT_LE(across.first, 1.25 * along.first);
    EXPECT_LE(across.second, 2.5 * across.first);
  };
  compare(iterations_of_rollers<2>(48, 0.), iterations_of_rollers<2>(48, 45.));
  compare(iterations_of_rollers<3>(10, 0.), iterations_of_rollers<3>(10, 45.));
}

TEST(LinearSolver, StopsAtWhatIsEnough)
{
  const Elasticity<2> problem(48);
  for (const char *name : {"amg-cg", "gmres"})
    {
      LinearSolver solver(use(name), 2);
      solver.set_up(problem.matrix, true, problem.modes);
      LA::Vector         x(problem.rhs);
      const double       enough = 1e-4 * problem.rhs.l2_norm();
      const LinearReport report = solver.solve(x, problem.rhs, enough);
      EXPECT_TRUE(report.converged) << report.message;
      EXPECT_LT(true_residual(problem, x), 1e-3);
      EXPECT_GT(true_residual(problem, x), 1e-7);
    }
}

TEST(LinearSolver, TheSameSizeSplitAnotherWay)
{
  // Two springs in a row of nodes with two components, spread over the ranks
  // in two ways.
  const unsigned int n = 80;
  LinearSolver       solver(use("amg-cg"), 2);
  for (const unsigned int shift : {0, 8})
    {
      const unsigned int rank =
        dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const auto border = [=](const unsigned int r) {
        return r == 0 || r == n_ranks ? n * r / n_ranks :
                                        n * r / n_ranks / 4 * 4 + shift;
      };
      dealii::IndexSet owned(n);
      owned.add_range(border(rank), border(rank + 1));
      dealii::DynamicSparsityPattern pattern(n);
      for (const auto i : owned)
        for (const unsigned int j :
             {i, i >= 2 ? i - 2 : i, i + 2 < n ? i + 2 : i})
          pattern.add(i, j);
      const auto matrix = std::make_shared<LA::SparseMatrix>();
      matrix->reinit(owned, owned, pattern, MPI_COMM_WORLD);
      std::vector<LA::Vector> modes(2, LA::Vector(owned, MPI_COMM_WORLD));
      LA::Vector              b(owned, MPI_COMM_WORLD), x(b), residual(b);
      for (const auto i : owned)
        {
          matrix->set(i, i, 2.);
          if (i >= 2)
            matrix->set(i, i - 2, -1.);
          if (i + 2 < n)
            matrix->set(i, i + 2, -1.);
          modes[i % 2](i) = 1.;
          b(i)            = std::sin(1. * i);
        }
      matrix->compress(dealii::VectorOperation::insert);
      for (auto *vector : {&modes[0], &modes[1], &b})
        vector->compress(dealii::VectorOperation::insert);
      solver.set_up(matrix, true, modes);
      const LinearReport report = solver.solve(x, b);
      EXPECT_TRUE(report.converged) << report.message;
      EXPECT_LT(matrix->residual(residual, x, b), 1e-9 * b.l2_norm());
    }
}
