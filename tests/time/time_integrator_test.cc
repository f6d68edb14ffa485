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
        const double a_0  = rule.acceleration(dt, zero, now.v, now.a);
        const double du =
          (-k * now.u * (1 + rule.start_forces()) - rule.end_inertia() * a_0 -
           rule.start_inertia() * now.a) /
          (rule.end_inertia() * rule.acceleration_by_increment(dt) + share * k);
        const double a = rule.acceleration(dt, du, now.v, now.a);
        now.v          = rule.velocity(dt, now.v, now.a, a);
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
             rule.end_inertia() * rule.acceleration(1., zero, v, a) -
             rule.start_inertia() * a) /
            (rule.end_inertia() * rule.acceleration_by_increment(1.) + k);
          const double a_end = rule.acceleration(1., du, v, a);
          v                  = rule.velocity(1., v, a, a_end);
          a                  = a_end;
          u += du;
          before = after;
          after  = std::abs(a);
        }
      EXPECT_LE(after, before * (rho + 0.05) + 1e-300) << rho;
    }
}
