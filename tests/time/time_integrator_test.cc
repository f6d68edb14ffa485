// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// An oscillator of mass 1 and period 1: periods and amplitudes against theory.

#include <moraine/time/time_integrator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace moraine;

namespace
{
  struct Oscillation
  {
    double u = 1, v = 0, a = 0, period = 0;
  };

  /** Until @p n_periods are over; periods by interpolated zeros of u. */
  Oscillation
  oscillate(const TimeIntegrator &rule,
            const double          steps_in_period,
            const unsigned int    n_periods)
  {
    const double k = 4 * M_PI * M_PI, dt = 1 / steps_in_period;
    const double share = rule.forces_in_the_middle() ? 0.5 : 1.;
    Oscillation  now;
    now.a              = -k * now.u;
    double       first = 0, last = 0;
    unsigned int n = 0;
    for (double t = 0; n <= 2 * n_periods; t += dt)
      {
        const double zero = 0;
        const double a_0  = rule.acceleration(dt, zero, now.v, now.a, zero);
        const double du =
          (-k * now.u * (1 + rule.start_forces()) - rule.end_inertia() * a_0 -
           rule.start_inertia() * now.a) /
          (rule.end_inertia() * rule.acceleration_by_increment(dt) + share * k);
        const double a = rule.acceleration(dt, du, now.v, now.a, zero);
        now.v          = rule.velocity(dt, now.v, now.a, zero, a);
        now.a          = a;
        if (now.u * (now.u + du) < 0)
          {
            last = t + dt * now.u / -du;
            if (n++ == 0)
              first = last;
          }
        now.u += du;
      }
    now.period = (last - first) / n_periods;
    return now;
  }
} // namespace

// Of means of both ends or of the end, the same rule.
TEST(TimeIntegrator, MeansOfBothEndsAreTheSameRule)
{
  for (const auto &rule : {TimeIntegrator::newmark(0.25, 0.5),
                           TimeIntegrator::newmark(0.3025, 0.6)})
    {
      const Oscillation of_end   = oscillate(rule, 20, 5),
                        of_means = oscillate(rule.with_means(), 20, 5);
      EXPECT_NEAR(of_means.period, of_end.period, 1e-12);
      EXPECT_NEAR(of_means.u, of_end.u, 1e-11);
      EXPECT_NEAR(of_means.v, of_end.v, 1e-11);
    }
}

// Theory: omega' dt = acos(...) of the amplification matrix.
TEST(TimeIntegrator, AverageAccelerationHasThePeriodOfTheory)
{
  // That of energy and momentum does the same to what is linear.
  for (const auto &rule :
       {TimeIntegrator::newmark(0.25, 0.5), TimeIntegrator::energy_momentum()})
    {
      EXPECT_NEAR(oscillate(rule, 20, 200).period, 1.00817124, 1e-5);
      EXPECT_NEAR(oscillate(rule, 50, 200).period, 1.00131456, 1e-5);
    }
}

TEST(TimeIntegrator, AverageAccelerationKeepsTheEnergy)
{
  for (const auto &rule :
       {TimeIntegrator::newmark(0.25, 0.5), TimeIntegrator::energy_momentum()})
    {
      const auto   end = oscillate(rule, 20, 200);
      const double k   = 4 * M_PI * M_PI;
      EXPECT_NEAR((end.v * end.v + k * end.u * end.u) / k, 1., 1e-10);
    }
}

TEST(TimeIntegrator, GeneralisedAlphaHasThePeriodOfTheory)
{
  const auto rule = TimeIntegrator::generalised_alpha(0.8);
  EXPECT_NEAR(oscillate(rule, 20, 20).period, 1.00862328, 1e-4);
  EXPECT_NEAR(oscillate(rule, 50, 50).period, 1.00138755, 1e-4);
}

TEST(TimeIntegrator, SpectralRadiusIsThatAskedFor)
{
  // Far above the frequencies of interest a step leaves rho of the amplitude.
  for (const double rho : {0., 0.5, 0.8, 1.})
    {
      const auto   rule = TimeIntegrator::generalised_alpha(rho);
      const double k    = 1e12;
      double       u = 1, v = 0, a = -k;
      double       before = 0, after = 0;
      for (unsigned int n = 0; n < 60; ++n)
        {
          const double zero = 0;
          const double du =
            (-k * u * (1 + rule.start_forces()) -
             rule.end_inertia() * rule.acceleration(1., zero, v, a, zero) -
             rule.start_inertia() * a) /
            (rule.end_inertia() * rule.acceleration_by_increment(1.) + k);
          const double a_end = rule.acceleration(1., du, v, a, zero);
          v                  = rule.velocity(1., v, a, zero, a_end);
          a                  = a_end;
          u += du;
          before = after;
          after  = std::abs(a);
        }
      EXPECT_LE(after, before * (rho + 0.05) + 1e-300) << rho;
    }
}

namespace
{
  /** One oscillator of stiffness k under Bathe's rule. */
  struct Bathe
  {
    double k, u, v, a, before = 0;

    /** Step by @p dt with @p rule. */
    void
    step(const TimeIntegrator &rule, const double dt)
    {
      const double zero = 0;
      const double du   = (-k * u - rule.acceleration(dt, zero, v, a, before)) /
                        (rule.acceleration_by_increment(dt) + k);
      const double end = rule.acceleration(dt, du, v, a, before);
      v                = rule.velocity(dt, v, a, before, end);
      before           = a;
      a                = end;
      u += du;
    }

    /** Both parts of a step by @p dt, the first to @p s. */
    void
    step(const double rho, const double s, const double dt)
    {
      step(TimeIntegrator::newmark(0.25, 0.5), s * dt);
      step(TimeIntegrator::second_part_of_bathe(rho, (1 - s) / s),
           (1 - s) * dt);
    }
  };

  double
  first_part(const double rho)
  {
    IntegratorParameters parameters;
    parameters.integrator      = "Bathe";
    parameters.spectral_radius = rho;
    return parameters.first_part();
  }
} // namespace

// With the published formulas, from the start of the whole step.
TEST(TimeIntegrator, PartsOfBathesRuleAreThoseOfThePaper)
{
  for (const double rho : {0., 0.4, 0.8, 1.})
    for (const double s : {0.2, first_part(rho), 0.9})
      {
        const double dt = 0.3, k = 7;
        Bathe        now{k, 0.4, -0.7, -k * 0.4};
        const double u_0 = now.u, v_0 = now.v, a_0 = now.a;
        now.step(TimeIntegrator::newmark(0.25, 0.5), s * dt);
        const double v_s = now.v, a_s = now.a;
        now.step(TimeIntegrator::second_part_of_bathe(rho, (1 - s) / s),
                 (1 - s) * dt);
        const double q_1 = (rho + 1) / (2 * s * (rho - 1) + 4);
        const double q_0 = (s - 1) * q_1 + 0.5, q_2 = 0.5 - s * q_1;
        EXPECT_NEAR(now.v,
                    v_0 + dt * (q_0 * a_0 + q_1 * a_s + q_2 * now.a),
                    1e-14);
        EXPECT_NEAR(now.u,
                    u_0 + dt * (q_0 * v_0 + q_1 * v_s + q_2 * now.v),
                    1e-14);
        EXPECT_NEAR(now.a, -k * now.u, 1e-13);
      }
}

// Of both parts, where the step is divided as it is by default.
TEST(TimeIntegrator, MatricesOfBathesPartsAreAlike)
{
  for (const double rho : {0., 0.4, 0.8, 1.})
    {
      const double s    = first_part(rho);
      const auto second = TimeIntegrator::second_part_of_bathe(rho, 1 / s - 1);
      EXPECT_NEAR(
        second.acceleration_by_increment(1 - s) /
          TimeIntegrator::newmark(0.25, 0.5).acceleration_by_increment(s),
        1.,
        1e-12);
    }
}

TEST(TimeIntegrator, BathesRuleConvergesWithTheSquareOfTheStep)
{
  const double k = 4 * M_PI * M_PI;
  for (const double rho : {0., 0.8, 1.})
    {
      double error[2];
      for (unsigned int n = 0; n < 2; ++n)
        {
          Bathe          now{k, 1, 0, -k};
          const unsigned steps = 20 << n;
          for (unsigned int i = 0; i < steps; ++i)
            now.step(rho, first_part(rho), 1. / steps);
          error[n] = std::hypot(now.u - 1, now.v / std::sqrt(k));
        }
      EXPECT_NEAR(std::log2(error[0] / error[1]), 2., 0.15) << rho;
    }
}

TEST(TimeIntegrator, BathesRuleLeavesTheRadiusOfHighFrequencies)
{
  for (const double rho : {0., 0.5, 0.8, 1.})
    for (const double s : {0.3, first_part(rho), 0.8})
      {
        const double k = 1e12;
        Bathe        now{k, 1, 0, -k};
        now.step(rho, s, 1.);
        EXPECT_NEAR(std::abs(now.u), rho, 1e-5) << s;
      }
}

// An acceleration that is linear in time: what is wrong is what is estimated.
TEST(TimeIntegrator, ErrorOfBathesSecondPartIsThatOfALinearAcceleration)
{
  const double rho = 0.6, first = 0.2, size = 0.3, slope = 0.7, a = 0.4;
  const auto   rule = TimeIntegrator::second_part_of_bathe(rho, size / first);
  const double v = 0.1, end = a + slope * size;
  // The increment that gives the acceleration at the end.
  const double zero = 0, before = a - slope * first;
  const double du = (end - rule.acceleration(size, zero, v, a, before)) /
                    rule.acceleration_by_increment(size);
  const double exact =
    size * v + size * size / 2 * a + size * size * size / 6 * slope;
  EXPECT_NEAR(std::abs(du - exact),
              rule.error_of_increment(size) * (end - a),
              1e-15);
}
