// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_step_driver_h
#define moraine_run_step_driver_h

#include <moraine/run/run_observer.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Takes a model from step to step: solve, accept or reject, tell the
   * observers. Knows no files and no console.
   */
  template <int dim>
  class StepDriver
  {
  public:
    /** The model is ready for its first step, see begin_first_step(). */
    StepDriver(const Scene<dim>                      &scene,
               Model<dim>                            &model,
               const std::vector<RunObserver<dim> *> &observers);

    /**
     * Step to the end.
     * @return whether it was reached; not if the user interrupted the run.
     * @throws ComputationError where no smaller step helps.
     */
    bool
    run();

    const TimeControl &
    time() const
    {
      return time_control;
    }

    const RunCounts &
    counts() const
    {
      return sums;
    }

    /** Of the boundaries and grid conditions in the last accepted step. */
    const std::vector<BoundaryReport<dim>> &
    reports() const
    {
      return last_reports;
    }

  private:
    /** One step that must be accepted, with as many cuts as it takes. */
    void
    advance();

    /** Aim at the trial time and look for equilibrium. */
    NewtonReport
    solve(LA::Vector &x);

    /** The same by Newton::jump() after a solution that @p failed. */
    NewtonReport
    jump(const NewtonReport &failed, LA::Vector &x);

    /** Whether a step that cannot be cut may jump. */
    bool
    may_jump(const NewtonReport &report) const;

    /** Add what a solve took to the sums. */
    void
    count(const NewtonReport &report);

    /**
     * A matrix that cannot be factorised, because too few points touch some
     * nodes: give empty parts of cells a stiffness from now on.
     * @return whether that is new.
     * @throw ComputationError if a body is not held.
     */
    bool
    hold_empty_parts(const NewtonReport &report);

    /** Why the solution @p x of a step cannot be accepted; empty if it can. */
    std::string
    reason_to_reject(const NewtonReport &report, const LA::Vector &x);

    void
    accept(const NewtonReport &report, const LA::Vector &x, const bool jumped);

    /** @throw ComputationError if no smaller step is left. */
    void
    reject(const NewtonReport &report, const std::string &reason);

    /** @throw ComputationError naming the point that the step pushes out. */
    void
    check_that_points_stay(const LA::Vector &x);

    const NewtonParameters                newton_parameters;
    const double                          empty_stiffness;
    Model<dim>                           &model;
    const std::vector<RunObserver<dim> *> observers;
    const MPI_Comm                        communicator;
    Newton                                newton;
    TimeControl                           time_control;
    RunCounts                             sums;
    std::vector<BoundaryReport<dim>>      last_reports;
    bool                                  first_step = true;
  };
} // namespace moraine

#endif
