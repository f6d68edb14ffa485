// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <moraine/solver/path_following.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace moraine;

namespace
{
  /**
   * A spring that snaps through and pulls another one along:
   * t - f(x_0) = 0, f(x) = 2 x^3 - 9 x^2 + 12 x, with limit points at x = 1,
   * f = 5, and x = 2, f = 4; and x_0 - g(x_1) = 0, g(x) = x + x^3 / 10.
   */
  class Springs : public PathSystem
  {
  public:
    explicit Springs(const std::vector<double> &start = {0., 0.},
                     const double               t     = 0.)
      : start(start)
      , t(t)
    {
      using namespace dealii;
      const bool first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      const bool alone = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
      owned            = IndexSet(2);
      if (first)
        owned.add_index(0);
      if (!first || alone)
        owned.add_index(1);
      DynamicSparsityPattern pattern(2);
      for (const auto i : owned)
        for (unsigned int j = 0; j < 2; ++j)
          pattern.add(i, j);
      matrix->reinit(owned, owned, pattern, MPI_COMM_WORLD);
      forces.reinit(owned, MPI_COMM_WORLD);
    }

    static double
    force(const double x)
    {
      return x * (12 - x * (9 - 2 * x));
    }

    void
    set_parameter(const double new_t) override
    {
      t = new_t;
    }

    LA::Vector
    path_weights() const override
    {
      LA::Vector weights(forces);
      weights = 0.5;
      return weights;
    }

    void
    initial_guess(LA::Vector &x) const override
    {
      x.reinit(owned, MPI_COMM_WORLD);
    }

    void
    assemble(const LA::Vector &x, const bool tangent) override
    {
      std::vector<double> u = values(x);
      for (unsigned int i = 0; i < 2; ++i)
        u[i] += start[i];
      const double r[] = {t - force(u[0]),
                          u[0] - u[1] - u[1] * u[1] * u[1] / 10};
      for (const auto i : owned)
        forces(i) = r[i];
      forces.compress(dealii::VectorOperation::insert);
      if (!tangent)
        return;
      const double K[2][2] = {{12 + u[0] * (6 * u[0] - 18), 0.},
                              {-1., 1 + 0.3 * u[1] * u[1]}};
      for (const auto i : owned)
        for (unsigned int j = 0; j < 2; ++j)
          matrix->set(i, j, K[i][j]);
      matrix->compress(dealii::VectorOperation::insert);
    }

    std::shared_ptr<const LA::SparseMatrix>
    tangent() const override
    {
      return matrix;
    }

    const LA::Vector &
    residual() const override
    {
      return forces;
    }

    std::vector<double>
    force_scales() const override
    {
      return {1.};
    }

    bool
    symmetric() const override
    {
      return false;
    }

    const std::vector<LA::Vector> &
    near_null_space() const override
    {
      return modes;
    }

    void
    apply_constraints(LA::Vector &) const override
    {}

    static std::vector<double>
    values(const LA::Vector &x)
    {
      std::vector<double> all(2, 0.);
      for (const auto i : x.locally_owned_elements())
        all[i] = x(i);
      dealii::Utilities::MPI::sum(all, MPI_COMM_WORLD, all);
      return all;
    }

  private:
    const std::vector<double>               start;
    double                                  t;
    dealii::IndexSet                        owned;
    const std::shared_ptr<LA::SparseMatrix> matrix =
      std::make_shared<LA::SparseMatrix>();
    LA::Vector              forces;
    std::vector<LA::Vector> modes;
  };



  PathReport
  follow(Springs &system, const PathStep &step, LA::Vector &x)
  {
    LinearSolverParameters direct;
    direct.solver = "direct";
    LinearSolver solver(direct, 2);
    return follow_path(NewtonParameters(), system, solver, step, x);
  }
} // namespace

TEST(PathFollowing, PassesBothLimitPoints)
{
  std::vector<double> u{0., 0.};
  double              largest = 0., smallest = 10.;
  PathStep            step{0.1, 0., -20., 20., {}};
  for (unsigned int n = 1; n <= 30; ++n)
    {
      Springs          system(u, step.t_start);
      LA::Vector       x;
      const PathReport report = follow(system, step, x);
      ASSERT_TRUE(report.converged()) << n << ": " << report.message;
      EXPECT_LE(report.iterations, 7u);
      const auto dx = Springs::values(x);
      EXPECT_NEAR(std::sqrt((dx[0] * dx[0] + dx[1] * dx[1]) / 2), 0.1, 1.1e-4);
      u[0] += dx[0];
      u[1] += dx[1];
      EXPECT_NEAR(report.t, Springs::force(u[0]), 1e-8);
      EXPECT_NEAR(u[0], u[1] + u[1] * u[1] * u[1] / 10, 1e-8);
      if (u[0] < 1.5)
        largest = std::max(largest, report.t);
      else
        smallest = std::min(smallest, report.t);
      step.before.emplace(
        PathStep::Before{x, (report.t - step.t_start) / step.radius});
      step.t_start = report.t;
    }
  EXPECT_NEAR(largest, 5., 0.02);
  EXPECT_NEAR(smallest, 4., 0.02);
  EXPECT_GT(step.t_start, 5.);
}

TEST(PathFollowing, ConvergesQuadratically)
{
  Springs          system({0.5, 0.5}, Springs::force(0.5));
  LA::Vector       x;
  const PathReport report =
    follow(system, {0.5, Springs::force(0.5), -20., 20., {}}, x);
  ASSERT_TRUE(report.converged()) << report.message;
  // log r / log r of the iteration before, while neither is round-off.
  const auto &r    = report.residuals;
  double      best = 0.;
  for (std::size_t k = 1; k < r.size(); ++k)
    if (r[k] > 1e-13 && r[k - 1] < 1e-1)
      best = std::max(best, std::log(r[k]) / std::log(r[k - 1]));
  EXPECT_GT(best, 1.7);
}

TEST(PathFollowing, EndsWhereTheParameterMayNotGoOn)
{
  Springs          system;
  LA::Vector       x;
  const PathReport report = follow(system, {0.5, 0., -3., 3., {}}, x);
  ASSERT_TRUE(report.converged()) << report.message;
  EXPECT_EQ(report.t, 3.);
  const double x_0 = Springs::values(x)[0];
  EXPECT_NEAR(Springs::force(x_0), 3., 1e-8);
  EXPECT_LT(x_0, 0.5);
}

TEST(PathFollowing, DoesNotComeBack)
{
  // A step before that seems to have come from larger x, with t as if it fell:
  // what is found ahead of it is taken, what lies behind is not.
  Springs    system({0.5, 0.488}, Springs::force(0.5));
  LA::Vector x, before;
  system.initial_guess(before);
  before = -0.1;
  PathStep step{0.1, Springs::force(0.5), -20., 20., {}};
  step.before.emplace(PathStep::Before{before, 100.});
  const PathReport report = follow(system, step, x);
  if (report.converged())
    EXPECT_LT(Springs::values(x)[0], 0.);
  else
    EXPECT_EQ(report.message, "the path came back on itself");
}
