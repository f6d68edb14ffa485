// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/newton.h>
#include <moraine/solver/pseudo_transient.h>
#include <moraine/solver/residual_measure.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int maximum_halvings = 8;

    /** Of full steps after which other forces act, between two passes. */
    constexpr unsigned int maximum_free_steps = 12;

    /** A step of length s must reduce the residual by this times s (Armijo). */
    constexpr double sufficient_decrease = 1e-4;

    /**
     * Or, after a whole correction, the next with the same tangent must be
     * shorter by this (Deuflhard 2004, restricted natural monotonicity test).
     * Parts of corrections would lead past limit points.
     */
    constexpr double sufficient_shortening = 0.25;

    /** With a kept tangent, a pass that leaves more than this part of the
     * residual calls for a new one. */
    constexpr double slow_pass = 0.1;

    /** A correction that leaves less of the residual is no play of rounding. */
    constexpr double still_falls = 0.5;

    /**
     * An iterative solver solves the linear equations to this part of the
     * square of what the last correction left of the residual, which keeps the
     * order 2 (Eisenstat and Walker 1996, choice 2), and at least to the other.
     */
    constexpr double forcing_factor  = 0.9;
    constexpr double largest_forcing = 0.1;

    /** ... but no further than to this part of what Newton's method needs. */
    constexpr double goal_of_linear_solver = 0.1;

    /** Residuals below this say more about round-off than about order. */
    constexpr double share_of_round_off = 1e-11;

    /** Where this part of the first residual is left, Newton's method shows the
     * order with which it ends. */
    constexpr double already_near = 0.1;



    double
    observed_order(const std::vector<double> &residuals)
    {
      std::size_t n = residuals.size();
      while (n > 0 && residuals[n - 1] < share_of_round_off)
        --n;
      if (n < 4 || residuals[n - 3] > already_near * residuals[0])
        return 0.;
      const double last   = std::log(residuals[n - 1] / residuals[n - 2]);
      const double before = std::log(residuals[n - 2] / residuals[n - 3]);
      return last < 0. && before < 0. ? last / before : 0.;
    }



    /** One solve under way. */
    class Iteration
    {
    public:
      Iteration(const NewtonParameters &parameters,
                NonlinearSystem        &system,
                LinearSolver           &linear_solver,
                LA::Vector             &x,
                const Newton::Watcher  &watcher = {})
        : parameters(parameters)
        , system(system)
        , linear_solver(linear_solver)
        , x(x)
        , measure(system, parameters.tolerance, parameters.absolute_tolerance)
        , watcher(watcher)
      {}

      NewtonReport
      run()
      {
        system.initial_guess(x);
        evaluate(true);
        measure.start();
        record();
        if (!is_number_at_start())
          return report;
        const std::string not_held = system.why_not_held();
        if (!not_held.empty())
          {
            stop(NewtonStatus::not_held, not_held);
            return report;
          }
        // The first residual may be a linearised one.
        if (system.linearised() && small())
          evaluate(false);
        if (!is_number_at_start())
          return report;
        const bool balanced   = iterate();
        report.observed_order = observed_order(report.residuals);
        if (balanced)
          settle_multipliers();
        return end();
      }

      /** From x, which @p found; the same report goes on. */
      NewtonReport
      go_on(const NewtonReport &found)
      {
        report = found;
        evaluate(true);
        measure.start();
        if (iterate())
          settle_multipliers();
        return end();
      }

    private:
      NewtonReport
      end()
      {
        if (tangent_is_factorised)
          report.condition_number = linear_solver.condition_number();
        return report;
      }

      const NewtonParameters &parameters;
      NonlinearSystem        &system;
      LinearSolver           &linear_solver;
      LA::Vector             &x;
      ResidualMeasure         measure;
      const Newton::Watcher   watcher;
      NewtonReport            report;
      double                  length                = 1.;
      unsigned int            iterations_since_pass = 0;
      unsigned int            free_steps            = 0;
      bool                    tangent_is_at_x       = false;
      bool                    tangent_is_factorised = false;

      void
      evaluate(const bool tangent)
      {
        system.assemble(x, tangent);
        measure.update(x, tangent);
        tangent_is_at_x = tangent;
      }

      void
      factorise()
      {
        if (!tangent_is_at_x)
          evaluate(true);
        linear_solver.set_up(system.tangent(),
                             system.symmetric(),
                             system.near_null_space());
        tangent_is_factorised = true;
      }



      bool
      small() const
      {
        return measure.distance() <= 1.;
      }

      void
      record()
      {
        report.residuals.push_back(measure.relative());
      }

      bool
      stop(const NewtonStatus status, const std::string &message)
      {
        report.status  = status;
        report.message = message;
        return false;
      }

      /** The system's word on a residual that is not finite, or @p otherwise.
       */
      std::string
      cause(const std::string &otherwise) const
      {
        const std::string failure = system.failure();
        return failure.empty() ? otherwise : failure;
      }

      bool
      is_number_at_start()
      {
        return measure.finite() ||
               stop(NewtonStatus::not_a_number,
                    cause(
                      "the residual is not a number at the start of the step"));
      }

      /** Solve for a correction with the factorisation at hand and take it. @p
       * enough: the distance that the linear equations may leave. */
      bool
      correct(const bool   line_search,
              const double enough = goal_of_linear_solver)
      {
        if (iterations_since_pass == parameters.maximum_iterations)
          return stop(NewtonStatus::too_many_iterations,
                      "no equilibrium after " +
                        std::to_string(iterations_since_pass) + " iterations");
        LA::Vector         dx(system.residual());
        const LinearReport linear =
          linear_solver.solve(dx,
                              system.residual(),
                              small() ? 0. : measure.weighted_norm(enough),
                              measure.weights());
        report.linear_solver = linear.solver;
        report.linear_iterations += linear.iterations;
        report.ran_out_of_linear_iterations = linear.ran_out_of_iterations;
        if (!linear.converged)
          return stop(NewtonStatus::linear_solver_failed,
                      failure_of(linear, system));
        if (!linear.message.empty())
          report.message = linear.message;
        system.apply_constraints(dx);
        ++report.iterations;
        ++iterations_since_pass;
        const bool taken = take_step(dx, line_search);
        record();
        if (watcher)
          watcher({report.iterations,
                   report.residuals.back(),
                   linear.iterations,
                   length});
        return taken;
      }

      /** Add dx if that reduces the residual or the next correction, else half
       * of it, a quarter, ..., the first that reduces the residual. */
      bool
      take_step(const LA::Vector &dx, const bool line_search)
      {
        // A linearised residual is no measure for the true one.
        const bool          any_will_do = system.linearised() || !line_search;
        const ResidualParts start       = measure.parts();
        const LA::Vector    x_start(x);
        const unsigned int  n_trials = line_search ? 1 + maximum_halvings : 1;
        double              factor   = 1.;
        for (unsigned int i = 0; i < n_trials; ++i, factor *= 0.5)
          {
            length = factor;
            x      = x_start;
            x.add(factor, dx);
            evaluate(false);
            if (measure.finite() &&
                (any_will_do || small() || acts_otherwise() ||
                 measure.ratio_to(start) <= 1. - sufficient_decrease * factor ||
                 (i == 0 && next_is_shorter(dx))))
              return true;
          }
        if (!measure.finite())
          return stop(NewtonStatus::not_a_number,
                      cause("the residual is not a number after a correction"));
        return stop(NewtonStatus::diverged,
                    "no step along the correction reduces the residual");
      }

      /** Whether a step counts as good because other forces act after it, which
       * the next one will know; not for ever, lest they come and go. */
      bool
      acts_otherwise()
      {
        return free_steps < maximum_free_steps && length == 1. &&
               system.acts_otherwise() && ++free_steps > 0;
      }

      /**
       * Whether the tangent that gave dx has a shorter correction for the
       * residual after it. Where a stiff part of the material, as the volume of
       * a nearly incompressible one, meets a rotation for the first time, the
       * residual grows although the step is a good one: displacements do not.
       */
      bool
      next_is_shorter(const LA::Vector &dx)
      {
        LA::Vector         next(dx);
        const LinearReport linear =
          linear_solver.solve(next,
                              system.residual(),
                              measure.weighted_norm(largest_forcing *
                                                    measure.distance()),
                              measure.weights());
        report.linear_iterations += linear.iterations;
        if (!linear.message.empty())
          report.message = linear.message;
        system.apply_constraints(next);
        return linear.converged &&
               next.l2_norm() <= (1. - sufficient_shortening) * dx.l2_norm();
      }

      bool
      iterate()
      {
        // The first as well as needed in the end: the problem may be linear.
        double forcing = 0.;
        while (!small())
          {
            factorise();
            const ResidualParts before = measure.parts();
            if (!correct(parameters.line_search,
                         std::max(goal_of_linear_solver,
                                  forcing * measure.distance())))
              return false;
            const double ratio = measure.ratio_to(before);
            forcing = std::min(largest_forcing, forcing_factor * ratio * ratio);
          }
        go_on_below_rounding();
        return true;
      }

      /**
       * What rounding may leave is an estimate, and much too large where a
       * point is crushed, or was by the start of a step: go on while the
       * residual falls.
       */
      void
      go_on_below_rounding()
      {
        for (bool falls = true; falls && measure.much_is_forgiven();)
          {
            const LA::Vector    found(x);
            const ResidualParts before  = measure.parts();
            const std::string   message = report.message;
            factorise();
            const double ratio = correct(false) ? measure.ratio_to(before) : 2.;
            falls              = ratio < still_falls;
            if (ratio <= 1.)
              continue;
            report.status  = NewtonStatus::converged;
            report.message = message;
            x              = found;
            evaluate(false);
          }
      }

      /** At least one correction with the factorisation at hand, more while
       * they help, then Newton's own if still needed. */
      bool
      iterate_with_kept_tangent()
      {
        if (!tangent_is_factorised)
          factorise();
        ResidualParts before;
        do
          {
            before = measure.parts();
            if (!correct(false))
              return false;
          }
        while (!small() && measure.ratio_to(before) < slow_pass);
        return iterate();
      }

      bool
      settle_multipliers()
      {
        while (system.augment(x, parameters.tolerance))
          {
            if (report.augmentations == parameters.maximum_augmentations)
              return stop(NewtonStatus::too_many_iterations,
                          "multipliers still change after " +
                            std::to_string(report.augmentations) + " updates");
            ++report.augmentations;
            iterations_since_pass = free_steps = 0;
            evaluate(false);
            if (!iterate_with_kept_tangent())
              return false;
          }
        return true;
      }
    };



  } // namespace



  std::string
  to_string(const NewtonStatus status)
  {
    switch (status)
      {
        case NewtonStatus::converged:
          return "converged";
        case NewtonStatus::diverged:
          return "diverged";
        case NewtonStatus::linear_solver_failed:
          return "linear solver failed";
        case NewtonStatus::too_many_iterations:
          return "too many iterations";
        case NewtonStatus::not_a_number:
          return "not a number";
        case NewtonStatus::not_held:
          return "not held";
      }
    Assert(false, ExcInternalError());
    return "";
  }



  Newton::Newton(const NewtonParameters &parameters)
    : parameters(parameters)
  {}



  NewtonReport
  Newton::solve(NonlinearSystem &system,
                LinearSolver    &linear_solver,
                LA::Vector      &x)
  {
    return Iteration(parameters, system, linear_solver, x, watcher).run();
  }



  void
  Newton::watch(const Watcher &new_watcher)
  {
    watcher = new_watcher;
  }



  NewtonReport
  Newton::pseudo_transient(NonlinearSystem &system,
                           LinearSolver    &linear_solver,
                           LA::Vector      &x)
  {
    system.start_over();
    NewtonReport report =
      come_to_rest(parameters, system, linear_solver, x, watcher);
    if (report.converged())
      report =
        Iteration(parameters, system, linear_solver, x, watcher).go_on(report);
    return report;
  }



  void
  NewtonParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Tolerance",
                      tolerance,
                      "residual over the norm of the forces that balance, of "
                      "each body",
                      Patterns::Double(1e-15, 1e-2));
    prm.add_parameter("Absolute tolerance",
                      absolute_tolerance,
                      "residual (force) that counts as zero at any load",
                      Patterns::Double(0.));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "corrections before the step is given up",
                      Patterns::Integer(1));
    prm.add_parameter("Line search",
                      line_search,
                      "shorten corrections that do not reduce the residual");
    prm.add_parameter("Limit points",
                      limit_points,
                      "where even the smallest step finds no equilibrium "
                      "nearby: stop, or go on at the one at which the body "
                      "would come to rest in a viscous medium "
                      "(pseudo-transient continuation). auto: the latter at "
                      "rest with a material whose flow is not associated, "
                      "without 'Arc length', and without strength reduction of "
                      "points that move.",
                      Patterns::Selection("auto|stop|pseudo-transient"));
    prm.add_parameter("Maximum augmentations",
                      maximum_augmentations,
                      "updates of the boundaries' reactions in one step",
                      Patterns::Integer(0));
  }
} // namespace moraine
