// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/newton.h>
#include <moraine/solver/pseudo_transient.h>

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

    /**
     * A step of length s must reduce the residual by this times s (Armijo).
     */
    constexpr double sufficient_decrease = 1e-4;

    /**
     * With a kept tangent, a pass that leaves more than this part of the
     * residual calls for a new one.
     */
    constexpr double slow_pass = 0.1;

    /**
     * Residuals below this say more about round-off than about order.
     */
    constexpr double round_off = 1e-13;

    /**
     * What round-off leaves of the forces at the start of a step, which cancel
     * altogether where a step ends without stress.
     */
    constexpr double cancelled = 1e-14;



    double
    observed_order(const std::vector<double> &residuals)
    {
      std::size_t n = residuals.size();
      while (n > 0 && residuals[n - 1] < round_off)
        --n;
      if (n < 3)
        return 0.;
      const double last   = std::log(residuals[n - 1] / residuals[n - 2]);
      const double before = std::log(residuals[n - 2] / residuals[n - 3]);
      return last < 0. && before < 0. ? last / before : 0.;
    }



    /**
     * One solve under way.
     */
    class Iteration
    {
    public:
      Iteration(const NewtonParameters &parameters,
                NonlinearSystem        &system,
                LinearSolver           &linear_solver,
                LA::Vector             &x)
        : parameters(parameters)
        , system(system)
        , linear_solver(linear_solver)
        , x(x)
      {}

      NewtonReport
      run();

      /** From x, which @p found; the same report goes on. */
      NewtonReport
      go_on(const NewtonReport &found);

    private:
      NewtonReport
      end();

      const NewtonParameters &parameters;
      NonlinearSystem        &system;
      LinearSolver           &linear_solver;
      LA::Vector             &x;
      NewtonReport            report;
      double                  norm                  = 0.;
      double                  scale_at_start        = 0.;
      unsigned int            iterations_since_pass = 0;
      bool                    tangent_is_at_x       = false;
      bool                    tangent_is_factorised = false;

      void
      evaluate(const bool tangent);

      void
      factorise();

      /** The residual norm to reach. */
      double
      goal() const;

      bool
      small() const;

      void
      record();

      bool
      stop(const NewtonStatus status, const std::string &message);

      /** The system's word on a residual that is not finite, or @p otherwise.
       */
      std::string
      cause(const std::string &otherwise) const;

      bool
      correct(const bool line_search);

      bool
      take_step(const LA::Vector &dx, const bool line_search);

      bool
      iterate();

      bool
      iterate_with_kept_tangent();

      bool
      settle_multipliers();
    };



    void
    Iteration::evaluate(const bool tangent)
    {
      system.assemble(x, tangent);
      norm            = system.residual().l2_norm();
      tangent_is_at_x = tangent;
    }



    void
    Iteration::factorise()
    {
      if (!tangent_is_at_x)
        evaluate(true);
      linear_solver.set_up(system.tangent(),
                           system.symmetric(),
                           system.near_null_space());
      tangent_is_factorised = true;
    }



    double
    Iteration::goal() const
    {
      return std::max({parameters.tolerance * system.force_scale(),
                       parameters.absolute_tolerance,
                       cancelled * scale_at_start});
    }



    bool
    Iteration::small() const
    {
      return norm <= goal();
    }



    void
    Iteration::record()
    {
      const double scale = system.force_scale();
      report.residuals.push_back(scale > 0. ? norm / scale : norm);
    }



    bool
    Iteration::stop(const NewtonStatus status, const std::string &message)
    {
      report.status  = status;
      report.message = message;
      return false;
    }



    std::string
    Iteration::cause(const std::string &otherwise) const
    {
      const std::string fault = system.fault();
      return fault.empty() ? otherwise : fault;
    }



    /**
     * Solve for a correction with the factorisation at hand and take it.
     */
    bool
    Iteration::correct(const bool line_search)
    {
      if (iterations_since_pass == parameters.maximum_iterations)
        return stop(NewtonStatus::too_many_iterations,
                    "no equilibrium after " +
                      std::to_string(iterations_since_pass) + " iterations");
      LA::Vector         dx(system.residual());
      const LinearReport linear =
        linear_solver.solve(dx, system.residual(), small() ? 0. : 0.1 * goal());
      report.linear_solver = linear.solver;
      report.linear_iterations += linear.iterations;
      if (!linear.converged)
        return stop(NewtonStatus::linear_solver_failed,
                    linear.solver + ": " + linear.message);
      report.message = linear.message;
      system.apply_constraints(dx);
      ++report.iterations;
      ++iterations_since_pass;
      const bool taken = take_step(dx, line_search);
      record();
      return taken;
    }



    /**
     * Add dx, or, where that does not reduce the residual, half of it, a
     * quarter, ...
     */
    bool
    Iteration::take_step(const LA::Vector &dx, const bool line_search)
    {
      // A linearised residual is no measure for the true one.
      const double start =
        system.linearised() ? std::numeric_limits<double>::max() : norm;
      const LA::Vector   x_start(x);
      const unsigned int n_trials = line_search ? 1 + maximum_halvings : 1;
      double             factor   = 1.;
      for (unsigned int i = 0; i < n_trials; ++i, factor *= 0.5)
        {
          x = x_start;
          x.add(factor, dx);
          evaluate(false);
          const bool falls =
            norm <= (1. - sufficient_decrease * factor) * start;
          if (std::isfinite(norm) && (falls || small() || !line_search))
            return true;
        }
      if (!std::isfinite(norm))
        return stop(NewtonStatus::not_a_number,
                    cause("the residual is not a number after a correction"));
      return stop(NewtonStatus::diverged,
                  "no step along the correction reduces the residual");
    }



    bool
    Iteration::iterate()
    {
      while (!small())
        {
          factorise();
          if (!correct(parameters.line_search))
            return false;
        }
      return true;
    }



    /**
     * At least one correction with the factorisation at hand, more while they
     * help, then Newton's own if still needed.
     */
    bool
    Iteration::iterate_with_kept_tangent()
    {
      if (!tangent_is_factorised)
        factorise();
      double before;
      do
        {
          before = norm;
          if (!correct(false))
            return false;
        }
      while (!small() && norm < slow_pass * before);
      return iterate();
    }



    bool
    Iteration::settle_multipliers()
    {
      while (system.augment(x))
        {
          if (report.augmentations == parameters.maximum_augmentations)
            return stop(NewtonStatus::too_many_iterations,
                        "multipliers still change after " +
                          std::to_string(report.augmentations) + " updates");
          ++report.augmentations;
          iterations_since_pass = 0;
          evaluate(false);
          if (!iterate_with_kept_tangent())
            return false;
        }
      return true;
    }



    NewtonReport
    Iteration::end()
    {
      if (tangent_is_factorised)
        report.condition_number = linear_solver.condition_number();
      return report;
    }



    NewtonReport
    Iteration::run()
    {
      system.initial_guess(x);
      evaluate(true);
      scale_at_start = system.force_scale();
      record();
      if (!std::isfinite(norm))
        {
          stop(NewtonStatus::not_a_number,
               cause("the residual is not a number at the start of the step"));
          return report;
        }
      // The first residual may be a linearised one.
      if (system.linearised() && small())
        evaluate(false);
      const bool balanced   = iterate();
      report.observed_order = observed_order(report.residuals);
      if (balanced)
        settle_multipliers();
      return end();
    }



    NewtonReport
    Iteration::go_on(const NewtonReport &found)
    {
      report = found;
      evaluate(true);
      scale_at_start = system.force_scale();
      if (iterate())
        settle_multipliers();
      return end();
    }
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
    return Iteration(parameters, system, linear_solver, x).run();
  }



  NewtonReport
  Newton::jump(NonlinearSystem &system,
               LinearSolver    &linear_solver,
               LA::Vector      &x)
  {
    system.start_over();
    NewtonReport report = come_to_rest(parameters, system, linear_solver, x);
    if (report.converged())
      report = Iteration(parameters, system, linear_solver, x).go_on(report);
    return report;
  }



  void
  NewtonParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Tolerance",
                      tolerance,
                      "residual over the norm of the forces that balance",
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
                      "nearby: stop, or jump to the one at which the body "
                      "would come to rest in a viscous medium",
                      Patterns::Selection("stop|jump"));
    prm.add_parameter("Maximum augmentations",
                      maximum_augmentations,
                      "updates of the boundaries' reactions in one step",
                      Patterns::Integer(0));
  }
} // namespace moraine
