// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/path_following.h>
#include <moraine/solver/residual_measure.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the radius; the length of a step is no result. */
    constexpr double tolerance_of_length = 1e-3;

    /** A step whose tangent is within an angle of this cosine of the step
     * before continues a smooth path. */
    constexpr double smooth_path = 0.9;

    /** Of the range of the parameter: the size of its differences. */
    constexpr double part_of_range = 1e-6;



    /** One step under way. */
    class PathIteration
    {
    public:
      PathIteration(const NewtonParameters &parameters,
                    PathSystem             &system,
                    LinearSolver           &linear_solver,
                    const PathStep         &step,
                    LA::Vector             &x,
                    const Newton::Watcher  &watcher)
        : parameters(parameters)
        , system(system)
        , linear_solver(linear_solver)
        , step(step)
        , x(x)
        , measure(system, parameters.tolerance, parameters.absolute_tolerance)
        , watcher(watcher)
      {}

      PathReport
      run()
      {
        report.t = step.t_start;
        weights  = system.path_weights();
        system.initial_guess(x);
        prescribed = x;
        if (!predict() || !settle())
          return report;
        while (system.augment(x, parameters.tolerance))
          {
            if (report.augmentations == parameters.maximum_augmentations)
              {
                stop(NewtonStatus::too_many_iterations,
                     "multipliers still change after " +
                       std::to_string(report.augmentations) + " updates");
                break;
              }
            ++report.augmentations;
            if (!settle())
              break;
          }
        report.condition_number = linear_solver.condition_number();
        return report;
      }

    private:
      bool
      stop(const NewtonStatus status, const std::string &message)
      {
        report.status  = status;
        report.message = message;
        return false;
      }

      bool
      assemble()
      {
        system.assemble(x, true);
        measure.update(x, true);
        if (measure.finite())
          return true;
        const std::string failure = system.failure();
        return stop(NewtonStatus::not_a_number,
                    failure.empty() ? "the residual is not a number" : failure);
      }

      double
      product(const LA::Vector &a, const LA::Vector &b) const
      {
        LA::Vector weighted(b);
        weighted.scale(weights);
        return a * weighted;
      }

      bool
      solve(const LA::Vector &rhs, LA::Vector &dx)
      {
        dx.reinit(x, true);
        const LinearReport linear = linear_solver.solve(dx, rhs);
        report.linear_solver      = linear.solver;
        linear_iterations += linear.iterations;
        report.ran_out_of_linear_iterations = linear.ran_out_of_iterations;
        if (!linear.converged)
          return stop(NewtonStatus::linear_solver_failed,
                      failure_of(linear, system));
        if (!linear.message.empty())
          report.message = linear.message;
        system.apply_constraints(dx);
        return true;
      }

      /**
       * With the tangent at hand, how x moves with t where the residual stays:
       * K rate = (r(x + dg, t + dt) - r(x, t)) / dt, with dg of what is
       * prescribed, and that on top.
       */
      bool
      find_rate()
      {
        linear_solver.set_up(system.tangent(),
                             system.symmetric(),
                             system.near_null_space());
        residual = system.residual();
        // Towards the inside of the range, where the scene has values.
        double dt = part_of_range * (step.t_max - step.t_min);
        if (report.t + dt > step.t_max)
          dt = -dt;
        LA::Vector moved(x), ahead;
        system.set_parameter(report.t + dt);
        system.initial_guess(ahead);
        ahead -= prescribed;
        moved += ahead;
        system.assemble(moved, false);
        LA::Vector change(system.residual());
        change -= residual;
        change /= dt;
        ahead /= dt;
        if (!solve(change, rate))
          return false;
        rate += ahead;
        return true;
      }

      /** To x + dx + dt rate, with what is prescribed at t + dt. */
      void
      move(const LA::Vector &dx, const double dt)
      {
        const double t = std::clamp(report.t + dt, step.t_min, step.t_max);
        // Rates of what is prescribed need not be constant.
        x += dx;
        x.add(t - report.t, rate);
        report.t = t;
        system.set_parameter(t);
        system.initial_guess(prescribed);
        x -= prescribed;
        system.apply_constraints(x);
        x += prescribed;
      }

      /** Along the tangent, or as in the step before where that does not lead
       * on.
       */
      bool
      predict()
      {
        if (!assemble())
          return false;
        const std::string not_held = system.why_not_held();
        if (!not_held.empty())
          return stop(NewtonStatus::not_held, not_held);
        if (!find_rate())
          return false;
        measure.start();
        const double length = std::sqrt(product(rate, rate));
        if (!(length > 0))
          {
            report.parameter_acts = false;
            return stop(NewtonStatus::diverged, "nothing changes with t");
          }
        LA::Vector   dx(x);
        double       dt = step.radius / length;
        const double last =
          step.before ? std::sqrt(product(step.before->x, step.before->x)) : 0.;
        dx = 0.;
        if (last > 0)
          {
            const double cosine =
              product(rate, step.before->x) / (length * last);
            if (cosine < 0)
              dt = -dt;
            if (std::abs(cosine) < smooth_path)
              {
                dx = step.before->x;
                dx *= step.radius / last;
                dt   = step.radius * step.before->dt_ds;
                rate = 0.;
              }
          }
        move(dx, dt);
        return true;
      }

      bool
      correct()
      {
        linear_iterations = 0;
        LA::Vector dx;
        if (!find_rate() || !solve(residual, dx))
          return false;
        const double gap =
          0.5 * (step.radius * step.radius - product(x, x)) - product(x, dx);
        const double slope = product(x, rate);
        const double dt    = gap / slope;
        if (!std::isfinite(dt))
          return stop(NewtonStatus::diverged,
                      "the path turns at a right angle to the step");
        move(dx, dt);
        ++report.iterations;
        report.linear_iterations += linear_iterations;
        return true;
      }

      /** Whether the length is that of the step, or t at an end of its range to
       * which the step went. */
      bool
      is_at_end() const
      {
        const double length = std::sqrt(product(x, x));
        return std::abs(length - step.radius) <=
                 tolerance_of_length * step.radius ||
               (length < step.radius && report.t != step.t_start &&
                (report.t == step.t_min || report.t == step.t_max));
      }

      /** Whether the step leads away from where the one before came from: that
       * is in equilibrium, too. */
      bool
      goes_on() const
      {
        return !step.before || product(x, step.before->x) > 0;
      }

      /** Correct until the residual is small at the end of the step. */
      bool
      settle()
      {
        for (unsigned int n = 0;; ++n)
          {
            if (!assemble())
              return false;
            report.residuals.push_back(measure.relative());
            if (watcher && n > 0)
              watcher({report.iterations,
                       report.residuals.back(),
                       linear_iterations,
                       1.});
            if (measure.distance() <= 1. && is_at_end())
              return goes_on() || stop(NewtonStatus::diverged,
                                       "the path came back on itself");
            if (n == parameters.maximum_iterations)
              return stop(NewtonStatus::too_many_iterations,
                          "no equilibrium after " + std::to_string(n) +
                            " iterations");
            if (!correct())
              return false;
          }
      }

      const NewtonParameters &parameters;
      PathSystem             &system;
      LinearSolver           &linear_solver;
      const PathStep          step;
      LA::Vector             &x;
      ResidualMeasure         measure;
      const Newton::Watcher   watcher;
      PathReport              report;
      LA::Vector              weights;
      LA::Vector              prescribed; ///< NonlinearSystem::initial_guess()
      LA::Vector              residual;
      LA::Vector              rate; ///< the derivative of x by t at r = const
      unsigned int            linear_iterations = 0; ///< of a correction
    };



  } // namespace



  PathReport
  follow_path(const NewtonParameters &parameters,
              PathSystem             &system,
              LinearSolver           &linear_solver,
              const PathStep         &step,
              LA::Vector             &x,
              const Newton::Watcher  &watcher)
  {
    return PathIteration(parameters, system, linear_solver, step, x, watcher)
      .run();
  }
} // namespace moraine
