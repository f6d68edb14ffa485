// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_time_time_integrator_h
#define moraine_time_time_integrator_h

#include <cmath>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** Keys of the section "Time" that choose a TimeIntegrator. */
  struct IntegratorParameters
  {
    std::string  integrator      = "quasi-static";
    double       beta            = 0.25;
    double       gamma           = 0.5;
    double       spectral_radius = 0.8;
    std::string  mass            = "consistent";
    std::string  transfer        = "APIC";
    double       flip_share      = 0.95;
    unsigned int fmpm_order      = 4;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** @throws InputError, naming @p section, for an unstable integrator. */
    void
    check(const std::string &section) const;

    bool
    dynamic() const
    {
      return integrator != "quasi-static";
    }
  };



  /**
   * How velocity and acceleration at the end of a step follow from the
   * increment of the displacement (Newmark 1959):
   *
   * @f[ a_{n+1} = \frac{\Delta u}{\beta \Delta t^2} - \frac{v_n}{\beta \Delta
   * t}
   *     - \Bigl(\frac{1}{2\beta} - 1\Bigr) a_n, \quad
   *     v_{n+1} = v_n + \Delta t\, ((1 - \gamma) a_n + \gamma a_{n+1}) @f]
   *
   * and where in the step the balance of momentum holds (generalised-alpha,
   * Chung and Hulbert 1993), with forces f of everything but inertia:
   *
   * @f[ M \bigl((1 - \alpha_m) a_{n+1} + \alpha_m a_n\bigr)
   *     = (1 - \alpha_f) f_{n+1} + \alpha_f f_n . @f]
   *
   * The equations are solved divided by @f$1 - \alpha_f@f$, so that terms need
   * not know of it. Newmark's have @f$\alpha_m = \alpha_f = 0@f$. Knows no
   * physics.
   *
   * The rule of energy and momentum (Simo and Tarnow 1992, Gonzalez 2000) has
   * @f$(v_n + v_{n+1})/2 = \Delta u/\Delta t@f$ and @f$M (v_{n+1} -
   * v_n)/\Delta t = f@f$ with forces in the middle of the step: Newmark's
   * formulas with @f$\beta = 1/2@f$, @f$\gamma = 1@f$ and the mean acceleration
   * of the step for @f$a_{n+1}@f$.
   */
  class TimeIntegrator
  {
  public:
    static TimeIntegrator
    newmark(const double beta, const double gamma);

    /** By its spectral radius at infinite frequency, 0 to 1. */
    static TimeIntegrator
    generalised_alpha(const double spectral_radius);

    /** With forces in the middle of the step. */
    static TimeIntegrator
    energy_momentum();

    explicit TimeIntegrator(const IntegratorParameters &parameters);

    /** Whether the balance of momentum holds for forces in the middle of the
     * step, by velocities there; else for those at its end. */
    bool
    forces_in_the_middle() const
    {
      return in_the_middle;
    }

    /** @f$\partial a_{n+1} / \partial \Delta u@f$ [1/time^2] */
    double
    acceleration_by_increment(const double step_size) const
    {
      return 1 / (beta * step_size * step_size);
    }

    /** @f$\partial v_{n+1} / \partial \Delta u@f$ [1/time] */
    double
    velocity_by_increment(const double step_size) const
    {
      return gamma / (beta * step_size);
    }

    /** @f$a_{n+1}@f$ from @f$\Delta u@f$, @f$v_n@f$ and @f$a_n@f$. */
    template <class Value>
    Value
    acceleration(const double step_size,
                 const Value &du,
                 const Value &v,
                 const Value &a) const
    {
      return acceleration_by_increment(step_size) * (du - step_size * v) -
             (0.5 / beta - 1) * a;
    }

    /** @f$v_{n+1}@f$ from the accelerations of both ends. */
    template <class Value>
    Value
    velocity(const double step_size,
             const Value &v,
             const Value &a,
             const Value &a_end) const
    {
      return v + step_size * ((1 - gamma) * a + gamma * a_end);
    }

    /**
     * Estimated error of @f$\Delta u@f$ of a step whose accelerations at both
     * ends are known, @f$|\beta - \tfrac16| \Delta t^2 (a_{n+1} - a_n)@f$
     * (Zienkiewicz and Xie 1991): the factor of the difference.
     */
    double
    error_of_increment(const double step_size) const
    {
      const double coefficient = in_the_middle ? 0.25 : beta;
      return std::abs(coefficient - 1. / 6) * step_size * step_size;
    }

    /** The factor of @f$M a_{n+1}@f$: @f$(1-\alpha_m)/(1-\alpha_f)@f$. */
    double
    end_inertia() const
    {
      return (1 - alpha_m) / (1 - alpha_f);
    }

    /** The factor of @f$M a_n@f$: @f$\alpha_m/(1-\alpha_f)@f$. */
    double
    start_inertia() const
    {
      return alpha_m / (1 - alpha_f);
    }

    /** The factor of @f$f_n@f$: @f$\alpha_f/(1-\alpha_f)@f$. */
    double
    start_forces() const
    {
      return alpha_f / (1 - alpha_f);
    }

    /** What the equations are divided by, @f$1 - \alpha_f@f$. */
    double
    divisor() const
    {
      return 1 - alpha_f;
    }

  private:
    TimeIntegrator(const double beta,
                   const double gamma,
                   const double alpha_m,
                   const double alpha_f,
                   const bool   in_the_middle = false);

    double beta, gamma, alpha_m, alpha_f;
    bool   in_the_middle;
  };
} // namespace moraine

#endif
