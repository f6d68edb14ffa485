// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <moraine/solver/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace moraine;

namespace
{
  using Values   = std::vector<double>;
  using Residual = std::function<Values(const Values &)>;
  using Tangent  = std::function<dealii::FullMatrix<double>(const Values &)>;

  /**
   * A few equations given as functions, their rows spread over the ranks.
   */
  class SmallSystem : public NonlinearSystem
  {
  public:
    SmallSystem(const Values   &start,
                const Residual &r,
                const Tangent  &k,
                const double    scale = 1.)
      : start(start)
      , r(r)
      , k(k)
      , scale(scale)
    {
      using namespace dealii;
      const unsigned int n = start.size();
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const unsigned int n_ranks =
        Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      owned = IndexSet(n);
      owned.add_range(n * rank / n_ranks, n * (rank + 1) / n_ranks);
      DynamicSparsityPattern pattern(n);
      for (const auto i : owned)
        for (unsigned int j = 0; j < n; ++j)
          pattern.add(i, j);
      matrix->reinit(owned, owned, pattern, MPI_COMM_WORLD);
      rhs.reinit(owned, MPI_COMM_WORLD);
    }

    void
    initial_guess(LA::Vector &x) const override
    {
      x.reinit(owned, MPI_COMM_WORLD);
      for (const auto i : owned)
        x(i) = start[i];
      x.compress(dealii::VectorOperation::insert);
    }

    void
    assemble(const LA::Vector &x, const bool tangent) override
    {
      const Values values   = everywhere(x);
      const Values residual = r(values);
      for (const auto i : owned)
        rhs(i) = residual[i];
      rhs.compress(dealii::VectorOperation::insert);
      ++n_residuals;
      if (!tangent)
        return;
      ++n_tangents;
      const auto full = k(values);
      for (const auto i : owned)
        for (unsigned int j = 0; j < full.n(); ++j)
          matrix->set(i, j, full(i, j));
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
      return rhs;
    }

    std::vector<double>
    force_scales() const override
    {
      return {scale};
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

    static Values
    everywhere(const LA::Vector &x)
    {
      Values values(x.size(), 0.);
      for (const auto i : x.locally_owned_elements())
        values[i] = x(i);
      dealii::Utilities::MPI::sum(values, MPI_COMM_WORLD, values);
      return values;
    }

    unsigned int n_residuals = 0;
    unsigned int n_tangents  = 0;

  private:
    const Values                            start;
    const Residual                          r;
    const Tangent                           k;
    const double                            scale;
    dealii::IndexSet                        owned;
    const std::shared_ptr<LA::SparseMatrix> matrix =
      std::make_shared<LA::SparseMatrix>();
    LA::Vector              rhs;
    std::vector<LA::Vector> modes;
  };



  dealii::FullMatrix<double>
  two_by_two(const double a, const double b, const double c, const double d)
  {
    dealii::FullMatrix<double> k(2, 2);
    k(0, 0) = a;
    k(0, 1) = b;
    k(1, 0) = c;
    k(1, 1) = d;
    return k;
  }

  struct Outcome
  {
    NewtonReport report;
    Values       x;
    unsigned int n_set_ups;
  };

  Outcome
  solve(NonlinearSystem        &system,
        const NewtonParameters &parameters = NewtonParameters())
  {
    LinearSolver linear_solver(LinearSolverParameters(), 2);
    LA::Vector   x;
    Outcome      outcome;
    outcome.report    = Newton(parameters).solve(system, linear_solver, x);
    outcome.x         = SmallSystem::everywhere(x);
    outcome.n_set_ups = linear_solver.n_set_ups();
    return outcome;
  }

  /** x^2 + y^2 = 5, x y = 2 near (2, 1): an unsymmetric tangent. */
  SmallSystem
  circle_and_hyperbola()
  {
    return SmallSystem(
      {3., 0.5},
      [](const Values &x) {
        return Values{5. - x[0] * x[0] - x[1] * x[1], 2. - x[0] * x[1]};
      },
      [](const Values &x) {
        return two_by_two(2. * x[0], 2. * x[1], x[1], x[0]);
      });
  }

  /** atan(x) = 0 twice; the plain iteration runs away from 2. */
  SmallSystem
  two_atans()
  {
    return SmallSystem(
      {2., -3.},
      [](const Values &x) {
        return Values{-std::atan(x[0]), -std::atan(x[1])};
      },
      [](const Values &x) {
        return two_by_two(1. / (1. + x[0] * x[0]),
                          0.,
                          0.,
                          1. / (1. + x[1] * x[1]));
      });
  }

  SmallSystem
  not_a_number()
  {
    return SmallSystem(
      {1., 1.},
      [](const Values &) {
        return Values{std::numeric_limits<double>::quiet_NaN(), 0.};
      },
      [](const Values &) { return two_by_two(1., 0., 0., 1.); });
  }

  SmallSystem
  linear(const double load = 1.)
  {
    return SmallSystem(
      {0., 0.},
      [load](const Values &x) {
        return Values{load - 2. * x[0] + x[1], load + x[0] - 3. * x[1]};
      },
      [](const Values &) { return two_by_two(2., -1., -1., 3.); });
  }
} // namespace

TEST(Newton, ConvergesQuadratically)
{
  SmallSystem system  = circle_and_hyperbola();
  const auto  outcome = solve(system);
  EXPECT_TRUE(outcome.report.converged());
  EXPECT_NEAR(outcome.x[0], 2., 1e-9);
  EXPECT_NEAR(outcome.x[1], 1., 1e-9);
  EXPECT_GT(outcome.report.observed_order, 1.8);
  EXPECT_LT(outcome.report.observed_order, 2.3);
  EXPECT_EQ(outcome.report.residuals.size(), outcome.report.iterations + 1);
  EXPECT_LE(outcome.report.iterations, 6u);
}

TEST(Newton, TellsEachCorrection)
{
  SmallSystem                  system = circle_and_hyperbola();
  std::vector<NewtonIteration> seen;
  Newton                       newton{NewtonParameters()};
  newton.watch([&](const NewtonIteration &one) { seen.push_back(one); });
  LinearSolver       linear_solver(LinearSolverParameters(), 2);
  LA::Vector         x;
  const NewtonReport report = newton.solve(system, linear_solver, x);
  ASSERT_EQ(seen.size(), report.iterations);
  for (unsigned int i = 0; i < seen.size(); ++i)
    {
      EXPECT_EQ(seen[i].number, i + 1);
      EXPECT_EQ(seen[i].residual, report.residuals[i + 1]);
    }
}

TEST(Newton, FewResidualsShowNoOrder)
{
  SmallSystem system = linear();
  EXPECT_EQ(solve(system).report.observed_order, 0.);
}

TEST(Newton, ALinearProblemCostsOneSolve)
{
  SmallSystem system  = linear();
  const auto  outcome = solve(system);
  EXPECT_TRUE(outcome.report.converged());
  EXPECT_NEAR(outcome.x[0], 0.8, 1e-14);
  EXPECT_NEAR(outcome.x[1], 0.6, 1e-14);
  EXPECT_EQ(outcome.report.iterations, 1u);
  EXPECT_EQ(outcome.n_set_ups, 1u);
  EXPECT_EQ(system.n_tangents, 1u);
  EXPECT_EQ(system.n_residuals, 2u);
}

TEST(Newton, NoLoadCostsNoSolve)
{
  SmallSystem system  = linear(0.);
  const auto  outcome = solve(system);
  EXPECT_TRUE(outcome.report.converged());
  EXPECT_EQ(outcome.report.iterations, 0u);
  EXPECT_EQ(outcome.n_set_ups, 0u);
}

TEST(Newton, NeedsTheLineSearchForAtan)
{
  SmallSystem with    = two_atans();
  const auto  outcome = solve(with);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  EXPECT_NEAR(outcome.x[0], 0., 1e-9);
  EXPECT_NEAR(outcome.x[1], 0., 1e-9);

  SmallSystem      without = two_atans();
  NewtonParameters plain;
  plain.line_search = false;
  EXPECT_FALSE(solve(without, plain).report.converged());
}

TEST(Newton, TakesAGoodStepAlthoughTheResidualGrows)
{
  // A point on a stiff circle is pulled along it. Each correction leaves the
  // circle a little, and the residual is 40 times as large as before.
  const double k = 1e4, pull = 8e-3;
  SmallSystem  system(
    {1., 0.},
    [=](const Values &x) {
      const double off = 0.5 * (x[0] * x[0] + x[1] * x[1] - 1.);
      return Values{-k * off * x[0], -k * off * x[1] - x[1] + pull};
    },
    [=](const Values &x) {
      const double off = 0.5 * (x[0] * x[0] + x[1] * x[1] - 1.);
      return two_by_two(k * (off + x[0] * x[0]),
                        k * x[0] * x[1],
                        k * x[0] * x[1],
                        k * (off + x[1] * x[1]) + 1.);
    });
  const auto outcome = solve(system);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  EXPECT_GT(outcome.report.residuals[1], 30 * outcome.report.residuals[0]);
  EXPECT_LE(outcome.report.iterations, 6u);
  EXPECT_NEAR(outcome.x[1], pull, 1e-9);
  EXPECT_NEAR(outcome.x[0], std::sqrt(1. - pull * pull), 1e-12);
}

TEST(Newton, StepsBackFromAStateThatDoesNotExist)
{
  // log(x) + 1 = 0 from 3: the full correction leads to negative x.
  const auto equations = [](const Values &x) {
    return Values{-std::log(x[0]) - 1., -x[1]};
  };
  const auto derivative = [](const Values &x) {
    return two_by_two(1. / x[0], 0., 0., 1.);
  };
  SmallSystem with({3., 0.}, equations, derivative);
  const auto  outcome = solve(with);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  EXPECT_NEAR(outcome.x[0], std::exp(-1.), 1e-9);

  SmallSystem      without({3., 0.}, equations, derivative);
  NewtonParameters plain;
  plain.line_search = false;
  const auto failed = solve(without, plain);
  EXPECT_EQ(failed.report.status, NewtonStatus::not_a_number);
}

TEST(Newton, ReportsWhatWentWrong)
{
  SmallSystem undefined = not_a_number();
  EXPECT_EQ(solve(undefined).report.status, NewtonStatus::not_a_number);

  SmallSystem singular(
    {0., 0.},
    [](const Values &) {
      return Values{1., 0.};
    },
    [](const Values &) { return two_by_two(1., 1., 1., 1.); });
  const auto unsolved = solve(singular);
  EXPECT_EQ(unsolved.report.status, NewtonStatus::linear_solver_failed);
  EXPECT_NE(unsolved.report.message.find("singular"), std::string::npos);

  // The tangent has the wrong sign: no step along it helps.
  SmallSystem backwards(
    {1., 1.},
    [](const Values &x) {
      return Values{-x[0], -x[1]};
    },
    [](const Values &) { return two_by_two(-1., 0., 0., -1.); });
  EXPECT_EQ(solve(backwards).report.status, NewtonStatus::diverged);

  SmallSystem      slow = circle_and_hyperbola();
  NewtonParameters few;
  few.maximum_iterations = 2;
  const auto unfinished  = solve(slow, few);
  EXPECT_EQ(unfinished.report.status, NewtonStatus::too_many_iterations);
  EXPECT_EQ(unfinished.report.iterations, 2u);
}

namespace
{
  /** A stiff and a soft spring that know nothing of each other. */
  class TwoParts : public SmallSystem
  {
  public:
    TwoParts()
      : SmallSystem(
          {0., 0.},
          [](const Values &x) {
            return Values{1e9 * (1. - x[0]), 2. - x[1] - std::pow(x[1], 3)};
          },
          [](const Values &x) {
            return two_by_two(1e9, 0., 0., 1. + 3. * x[1] * x[1]);
          })
    {
      LA::Vector x;
      initial_guess(x);
      for (const auto i : x.locally_owned_elements())
        parts.push_back(i);
    }

    std::vector<double>
    force_scales() const override
    {
      return {1e9, 1.};
    }

    const std::vector<unsigned int> &
    part_of_unknown() const override
    {
      return parts;
    }

  private:
    std::vector<unsigned int> parts;
  };
} // namespace

TEST(Newton, ASoftPartIsNotForgivenForAStiffOne)
{
  TwoParts   system;
  const auto outcome = solve(system);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  EXPECT_NEAR(outcome.x[0], 1., 1e-12);
  EXPECT_NEAR(outcome.x[1], 1., 1e-8);
}

TEST(Newton, NoThresholdHasAUnit)
{
  for (const double unit : {1e-25, 1e-6, 1., 1e20})
    {
      SmallSystem system(
        {0., 0.},
        [unit](const Values &x) {
          return Values{unit * (1. - std::sinh(x[0])), unit * (1. - x[1])};
        },
        [unit](const Values &x) {
          return two_by_two(unit * std::cosh(x[0]), 0., 0., unit);
        },
        unit);
      const auto outcome = solve(system);
      EXPECT_TRUE(outcome.report.converged()) << unit;
      EXPECT_NEAR(outcome.x[0], std::asinh(1.), 1e-9) << unit;
      EXPECT_EQ(outcome.report.iterations, 4u) << unit;
    }
}

TEST(Newton, MeasuresTheResidualAgainstTheForces)
{
  // The same equations in units a million times smaller.
  SmallSystem system(
    {0., 0.},
    [](const Values &x) {
      return Values{1e-6 - 1e-6 * std::sinh(x[0]), 1e-6 - 1e-6 * x[1]};
    },
    [](const Values &x) {
      return two_by_two(1e-6 * std::cosh(x[0]), 0., 0., 1e-6);
    },
    1e-6);
  const auto outcome = solve(system);
  EXPECT_TRUE(outcome.report.converged());
  EXPECT_NEAR(outcome.x[0], std::asinh(1.), 1e-9);
  EXPECT_NEAR(outcome.report.residuals[0], std::sqrt(2.), 1e-12);
}

namespace
{
  /**
   * x_0 + c x_0^3 = load, held to x_1 = g by a penalty b and a carried
   * multiplier: a spring of stiffness 1 between x_0 and x_1.
   */
  class Augmented : public SmallSystem
  {
  public:
    Augmented(const double c, double &multiplier)
      : SmallSystem(
          {0., 0.},
          [c, &multiplier](const Values &x) {
            const double spring = x[1] - x[0];
            return Values{1. - x[0] - c * x[0] * x[0] * x[0] + spring,
                          -spring + multiplier + b * (g - x[1])};
          },
          [c](const Values &x) {
            return two_by_two(2. + 3. * c * x[0] * x[0], -1., -1., 1. + b);
          })
      , multiplier(multiplier)
    {}

    bool
    augment(const LA::Vector &x, const double) override
    {
      const double gap = g - everywhere(x)[1];
      if (std::abs(gap) < 1e-13)
        return false;
      multiplier += b * gap;
      return true;
    }

    void
    start_over() override
    {
      multiplier = 0.;
    }

    static constexpr double b = 1e3;
    static constexpr double g = 0.1;

  private:
    double &multiplier;
  };
} // namespace

TEST(Newton, AugmentsALinearProblemWithOneFactorisation)
{
  double     multiplier = 0.;
  Augmented  system(0., multiplier);
  const auto outcome = solve(system);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  EXPECT_NEAR(outcome.x[1], 0.1, 1e-13);
  EXPECT_NEAR(outcome.x[0], 0.55, 1e-13);
  EXPECT_NEAR(multiplier, 0.1 - 0.55, 1e-10);
  EXPECT_EQ(outcome.n_set_ups, 1u);
  EXPECT_EQ(system.n_tangents, 1u);
  EXPECT_GE(outcome.report.augmentations, 3u);
  EXPECT_EQ(outcome.report.iterations, 1 + outcome.report.augmentations);
  // Each pass: once with the new multiplier, once after the correction.
  EXPECT_EQ(system.n_residuals, 2 + 2 * outcome.report.augmentations);
}

TEST(Newton, AugmentsANonlinearProblemWithoutNewTangents)
{
  double     multiplier = 0.;
  Augmented  system(0.5, multiplier);
  const auto outcome = solve(system);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  const double x = outcome.x[0];
  EXPECT_NEAR(outcome.x[1], 0.1, 1e-13);
  EXPECT_NEAR(1. - x - 0.5 * x * x * x + 0.1 - x, 0., 1e-9);
  // Tangents for Newton's own iterations only.
  EXPECT_EQ(outcome.n_set_ups, system.n_tangents);
  EXPECT_LT(outcome.n_set_ups + 2, outcome.report.iterations);
}

TEST(Newton, DoesNotAcceptMultipliersThatStillChange)
{
  double           multiplier = 0.;
  Augmented        system(0., multiplier);
  NewtonParameters parameters;
  parameters.maximum_augmentations = 1;
  const auto outcome               = solve(system, parameters);
  EXPECT_EQ(outcome.report.status, NewtonStatus::too_many_iterations);
  EXPECT_EQ(outcome.report.message, "multipliers still change after 1 updates");
}

TEST(Newton, ReadsItsKeys)
{
  NewtonParameters         newton;
  LinearSolverParameters   linear_solver;
  dealii::ParameterHandler prm;
  prm.enter_subsection("Newton");
  newton.add_parameters(prm);
  prm.leave_subsection();
  prm.enter_subsection("Linear solver");
  linear_solver.add_parameters(prm);
  prm.leave_subsection();
  const auto read = [&prm](const std::string &section,
                           const std::string &line) {
    prm.parse_input_from_string("subsection " + section + "\n" + line +
                                "\nend\n");
  };
  EXPECT_ANY_THROW(read("Linear solver", "set Solver = magic"));
  EXPECT_ANY_THROW(read("Newton", "set Tolerance = nan"));
  EXPECT_ANY_THROW(read("Newton", "set Tolerance = -1"));
  read("Newton", "set Tolerance = 1e-6");
  read("Linear solver", "set Solver = gmres");
  EXPECT_EQ(newton.tolerance, 1e-6);
  EXPECT_EQ(linear_solver.solver, "gmres");
}

namespace
{
  /**
   * A spring with the force x_0^3 - x_0 under a load; another one of stiffness
   * 2 hangs on it. Without load it stands at -1, 0 or 1.
   */
  SmallSystem
  snap_through(const double load)
  {
    return SmallSystem(
      {-0.6, -0.6},
      [load](const Values &x) {
        return Values{load - x[0] * x[0] * x[0] + x[0] - 2. * (x[0] - x[1]),
                      -2. * (x[1] - x[0])};
      },
      [](const Values &x) {
        return two_by_two(3. * x[0] * x[0] + 1., -2., -2., 2.);
      });
  }

  Outcome
  pseudo_transient(NonlinearSystem &system)
  {
    LinearSolver linear_solver(LinearSolverParameters(), 2);
    LA::Vector   x;
    Outcome      outcome;
    unsigned int n_seen = 0;
    Newton       newton({});
    newton.watch([&n_seen](const NewtonIteration &) { ++n_seen; });
    outcome.report = newton.pseudo_transient(system, linear_solver, x);
    EXPECT_EQ(n_seen, outcome.report.iterations);
    outcome.x         = SmallSystem::everywhere(x);
    outcome.n_set_ups = linear_solver.n_set_ups();
    return outcome;
  }
} // namespace

TEST(Newton, PseudoTransientWhereThePathEnds)
{
  // Beyond 2 / sqrt(27) = 0.3849 there is no equilibrium with x < 0.
  SmallSystem near_the_end = snap_through(0.3848);
  EXPECT_TRUE(solve(near_the_end).report.converged());
  SmallSystem system = snap_through(0.39);
  EXPECT_FALSE(solve(system).report.converged());
  SmallSystem again   = snap_through(0.39);
  const auto  outcome = pseudo_transient(again);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  const double x = outcome.x[0];
  EXPECT_GT(x, 1.);
  EXPECT_NEAR(x * x * x - x, 0.39, 1e-8);
  EXPECT_NEAR(outcome.x[1], x, 1e-8);
  EXPECT_LT(outcome.report.iterations, 60u);
}

TEST(Newton, PseudoTransientEndsAtTheNearestRest)
{
  // An equilibrium on the way is where a viscous body stops.
  SmallSystem system  = snap_through(0.3);
  const auto  outcome = pseudo_transient(system);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  EXPECT_LT(outcome.x[0], -1. / std::sqrt(3.));
  EXPECT_NEAR(std::pow(outcome.x[0], 3) - outcome.x[0], 0.3, 1e-8);
}

TEST(Newton, PseudoTransientSaysWhenThereIsNoRest)
{
  // A load of twice what the spring can carry, however far it goes.
  SmallSystem system(
    {0., 0.},
    [](const Values &x) {
      return Values{1. - 0.5 * std::sin(x[0]), -x[1]};
    },
    [](const Values &x) {
      return two_by_two(0.5 * std::cos(x[0]), 0., 0., 1.);
    });
  const auto outcome = pseudo_transient(system);
  EXPECT_FALSE(outcome.report.converged());
  EXPECT_NE(outcome.report.message.find("at rest"), std::string::npos)
    << outcome.report.message;

  SmallSystem undefined = not_a_number();
  EXPECT_EQ(pseudo_transient(undefined).report.status,
            NewtonStatus::not_a_number);
}

TEST(Newton, PseudoTransientAugmentsToo)
{
  double     multiplier = 0.;
  Augmented  system(0.5, multiplier);
  const auto outcome = pseudo_transient(system);
  EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
  EXPECT_NEAR(outcome.x[1], 0.1, 1e-13);
}

TEST(Newton, NoTangentNoConditionNumber)
{
  LinearSolverParameters parameters;
  parameters.estimate_condition_number = true;
  LinearSolver linear_solver(parameters, 2);
  LA::Vector   x;
  SmallSystem  loaded = linear(), free = linear(0.);
  Newton       newton({});
  EXPECT_TRUE(newton.solve(loaded, linear_solver, x).condition_number);
  EXPECT_FALSE(newton.solve(free, linear_solver, x).condition_number);
}

TEST(Newton, PseudoTransientForgetsMultipliersThatFailed)
{
  const auto residuals = [](const double left_by_failure) {
    double     multiplier = left_by_failure;
    Augmented  system(0.5, multiplier);
    const auto outcome = pseudo_transient(system);
    EXPECT_TRUE(outcome.report.converged()) << outcome.report.message;
    return outcome.report.residuals;
  };
  EXPECT_EQ(residuals(-300.), residuals(0.));
}
