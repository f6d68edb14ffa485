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

    /** Where a step is divided into two parts, 0 to 1, so that the matrices of
     * both are alike (Noh and Bathe 2019); 1 if it is not divided. */
    double
    first_part() const;
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
   *
   * Bathe's rule (Bathe and Baig 2005; with a spectral radius, Noh and Bathe
   * 2019) divides a step. The first part, to @f$t_n + s \Delta t@f$, is the
   * trapezoidal rule; then
   *
   * @f[ v_{n+1} = v_n + \Delta t\, (q_0 a_n + q_1 a_{n+s} + q_2 a_{n+1}), \quad
   *     u_{n+1} = u_n + \Delta t\, (q_0 v_n + q_1 v_{n+s} + q_2 v_{n+1}) @f]
   *
   * with @f$q_1 = (\rho + 1) / (2 s (\rho - 1) + 4)@f$, @f$q_0 = (s - 1) q_1 +
   * \tfrac12@f$ and @f$q_2 = \tfrac12 - s q_1@f$. Here either part is a step of
   * its own: the second has the formulas of Newmark with another term by the
   * acceleration @f$a_{n-1}@f$ at the start of the step before, of which
   * @f$v_n@f$ above follows by the trapezoidal rule.
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
    energy_momentum()
    {
      return {0.5, 1., 0., 0., true};
    }

    /** The second part of Bathe's rule, over the length of the first. */
    static TimeIntegrator
    second_part_of_bathe(const double spectral_radius, const double ratio);

    /** Of steps that are not divided, and of the first part of others. */
    explicit TimeIntegrator(const IntegratorParameters &parameters)
      : TimeIntegrator(parameters.integrator == "generalised-alpha" ?
                         generalised_alpha(parameters.spectral_radius) :
                       parameters.integrator == "energy-momentum" ?
                         energy_momentum() :
                       parameters.integrator == "Bathe" ?
                         newmark(0.25, 0.5) :
                         newmark(parameters.beta, parameters.gamma))
    {}

    /**
     * A rule of Newmark's as the balance of the means of both ends, @f$M (a_n +
     * a_{n+1}) = f_n + f_{n+1}@f$. It is the same rule, but takes a force that
     * acts over the whole step as one: the force of a constraint, of which the
     * rule determines the mean alone, cannot alternate from step to step.
     */
    TimeIntegrator
    with_means() const
    {
      TimeIntegrator rule(*this);
      rule.alpha_m = rule.alpha_f = 0.5;
      return rule;
    }

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

    /** Whether it asks for @f$a_{n-1}@f$. */
    bool
    looks_back() const
    {
      return velocity_before != 0;
    }

    /** @f$a_{n+1}@f$ from @f$\Delta u@f$, @f$v_n@f$, @f$a_n@f$ and, if
     * looks_back(), @f$a_{n-1}@f$. */
    template <class Value>
    Value
    acceleration(const double step_size,
                 const Value &du,
                 const Value &v,
                 const Value &a,
                 const Value &a_before) const
    {
      Value result =
        acceleration_by_increment(step_size) * (du - step_size * v) -
        of_start * a;
      if (looks_back())
        result -= of_before * a_before;
      return result;
    }

    /** @f$v_n@f$ by which acceleration() is @p a_end. */
    template <class Value>
    Value
    start_velocity(const double step_size,
                   const Value &du,
                   const Value &a,
                   const Value &a_before,
                   const Value &a_end) const
    {
      return (du -
              (a_end - acceleration(step_size, Value(), Value(), a, a_before)) /
                acceleration_by_increment(step_size)) /
             step_size;
    }

    /** @f$v_{n+1}@f$ from the accelerations of both ends and the one before. */
    template <class Value>
    Value
    velocity(const double step_size,
             const Value &v,
             const Value &a,
             const Value &a_before,
             const Value &a_end) const
    {
      Value mean = velocity_start * a + gamma * a_end;
      if (looks_back())
        mean += velocity_before * a_before;
      return v + step_size * mean;
    }

    /**
     * Estimated error of @f$\Delta u@f$ of a step whose accelerations at both
     * ends are known, @f$|\beta - \tfrac16| \Delta t^2 (a_{n+1} - a_n)@f$
     * (Zienkiewicz and Xie 1991): the factor of the difference. As they do for
     * Newmark's rule, that of the second part of Bathe's compares it with an
     * acceleration that is linear in time.
     */
    double
    error_of_increment(const double step_size) const
    {
      return std::abs(error) * step_size * step_size;
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

    /** Accelerations are those of this share of a step earlier, for their mean
     * is in balance with that of forces: @f$\alpha_f - \alpha_m@f$. */
    double
    delay_of_acceleration() const
    {
      return alpha_f - alpha_m;
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

    /** Of @f$a_n@f$ and @f$a_{n-1}@f$ in @f$-a_{n+1}@f$ and in
     * @f$(v_{n+1} - v_n)/\Delta t@f$. */
    double of_start, of_before = 0, velocity_start, velocity_before = 0;

    /** Of error_of_increment(), over @f$\Delta t^2@f$. */
    double error;
  };
} // namespace moraine

#endif
