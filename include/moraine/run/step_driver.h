// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_step_driver_h
#define moraine_run_step_driver_h

#include <moraine/assembly/fading_forces.h>
#include <moraine/assembly/fictitious_stiffness.h>
#include <moraine/core/simulation_state.h>
#include <moraine/diagnostics/diagnostics.h>
#include <moraine/run/run_observer.h>
#include <moraine/state/node_values.h>

#include <functional>
#include <optional>
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
               Diagnostics<dim>                      &diagnostics,
               const std::vector<RunObserver<dim> *> &observers);

    /**
     * Step to the end, and call @p after_step when a step was accepted and the
     * observers know.
     * @return whether it was reached; not if the user interrupted the run.
     * @throws ComputationError where no smaller step helps.
     */
    bool
    run(const std::function<void()> &after_step = {});

    /** Go back to the last accepted step, after run() threw or where a step is
     * given up; bodies of a stage that failed as it began go back, too.
     * Collective. */
    void
    undo();

    /** The last accepted state and what observers recorded. Collective. */
    void
    write(Archive &archive) const
    {
      lasting.write(archive);
    }

    /** Counts, reports and what else the next steps or the summary need. */
    void
    write_progress(Archive &archive) const;

    /**
     * Go on after the last accepted step of what write() and write_progress()
     * wrote, in place of begin_first_step(). The model is as it was made.
     * Collective.
     */
    void
    read(const Archive &archive);

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

    /** Whether a run could go on from what write_progress() writes: not if it
     * failed while a stage began. */
    bool
    can_go_on() const
    {
      return stage_is_begun;
    }

    /** Ask the diagnostics of the end of the run. Collective. */
    void
    ask_at_end(const std::optional<double> &stress_error);

    const std::vector<Finding> &
    findings() const
    {
      return diagnostics.ledger.findings();
    }

    const Facts<dim> &
    facts() const
    {
      return diagnostics.facts();
    }

  private:
    /** Go over to the next stage. */
    void
    begin_next_stage();

    /** Of the points in @p archive, for what it has of nodes. Collective. */
    void
    find_stencils(const Archive &archive);

    /** Whether the user wants the run to end, and it can: not between the two
     * parts of a step, nor in one that gives empty parts of cells another
     * stiffness. Collective. */
    bool
    is_to_end() const;

    /** Of Newton's method, for the observers; ends a step that the user gives
     * up. */
    Newton::Watcher
    report_iteration() const;

    /** Give empty parts of cells @p fraction of the material's stiffness.
     * @return false if @p if_needed and there are none. */
    bool
    add_support(const double fraction, const bool if_needed);

    /** One step that must be accepted, with as many cuts as it takes. */
    void
    advance();

    /** Aim at the trial time and look for equilibrium. */
    NewtonReport
    solve(LA::Vector &x);

    /** Look for it along the path of equilibria, in a step that has begun.
     * @throw InputError if nothing depends on time. */
    NewtonReport
    follow_path(LA::Vector &x);

    /** The same by Newton::pseudo_transient() after a solution that @p failed.
     */
    NewtonReport
    pseudo_transient(const NewtonReport &failed, LA::Vector &x);

    /** Whether a step that cannot be cut may be continued in pseudo-time. */
    bool
    may_pass_limit_point(const NewtonReport &report) const;

    /** Add what a solve took to the sums. */
    void
    count(const NewtonReport &report);

    /**
     * Too few points may touch some nodes: give empty parts of cells a
     * stiffness from now on, or more of it.
     * @return whether that is new.
     * @throw ComputationError if a body is not held.
     */
    bool
    hold_empty_parts();

    /**
     * No stiffness of empty parts let the step end: go back to the one that
     * the last accepted step had.
     * @return whether that is another.
     */
    bool
    take_back_support();

    /** The step is accepted with the stiffness that empty parts have. */
    void
    keep_support();

    /** Whether empty parts have a stiffness that may still be raised. */
    bool
    may_support_more() const;

    /** A note for the observers. */
    void
    tell(const std::string &text) const;

    /** Estimated error that the step to @p x makes, in cell sizes. Collective.
     */
    double
    error_of_step(const LA::Vector &x) const;

    /** How much longer the step after the one to @p x may be. Collective. */
    double
    allowed_growth(const LA::Vector &x) const;

    /** Whether the iteration for the first matrix of a step failed that a
     * shorter step has, too. */
    bool
    shorter_is_no_cure(const NewtonReport &report) const;

    /** Why the solution @p x of a step cannot be accepted; empty if it can. */
    std::string
    reason_to_reject(const NewtonReport &report, const LA::Vector &x);

    /** Why a step in balance is too long for the tolerance of its error, which
     * is not for lack of support; or "". Collective. */
    std::string
    error_too_large(const NewtonReport &report, const LA::Vector &x) const;

    /** Count the share of a ghost term in the step that is to be accepted.
     * Collective. */
    void
    count_ghost_term();

    /** Ask the diagnostics; with the largest motions of nodes and points in the
     * last step. @throws ComputationError if the run cannot go on. */
    void
    ask(const When                   when,
        const std::optional<double> &stress_error = std::nullopt);

    void
    accept(const NewtonReport &report,
           const LA::Vector   &x,
           const bool          was_pseudo_transient);

    /**
     * After the @p n_rejections-th rejection in a row: shorten the next trial,
     * or repeat the step with more stiffness of empty parts and begin to count
     * anew.
     * @throw ComputationError if no smaller step is left.
     */
    void
    reject(const NewtonReport &report,
           const std::string  &reason,
           unsigned int       &n_rejections);

    /** A static step found no equilibrium: let forces that are out of balance
     * at its start, if any are, come in parts; see FadingForces. Collective. */
    void
    split_jump(const NewtonReport &report);

    /** Add what FadingForces has. */
    void
    add_fading_forces();

    /** Let observers know of the step that @p step, all of it or its second
     * part, ends; of a first part they do not. Collective. */
    void
    report_step(AcceptedStep<dim> step);

    struct LargestMotion
    {
      double of_nodes  = 0; ///< [length]
      double of_points = 0; ///< [length]
    };

    /** The first of two parts of a step. */
    struct FirstPart
    {
      double                t_start;
      NodeValuesRecord<dim> increment;
    };

    const Scene<dim>                     &scene;
    const MethodParameters<dim>          &method;
    Model<dim>                           &model;
    const std::vector<RunObserver<dim> *> observers;
    const MPI_Comm                        communicator;
    Newton                                newton;
    TimeControl                           time_control;
    std::optional<NodeValuesRecord<dim>>  last_increment; ///< along a path
    std::optional<FirstPart>              first_part;     ///< if accepted
    FadingForces<dim>                     fading;
    SimulationState                       lasting;
    RunCounts                             sums;
    std::vector<BoundaryReport<dim>>      last_reports;
    Diagnostics<dim>                     &diagnostics;
    LargestMotion                         motion; ///< in the last step
    /** Of empty parts of cells, since they were too little without. */
    FictitiousStiffness<dim> *support           = nullptr;
    double                    accepted_fraction = 0; ///< of the last step
    bool                      first_step        = true;
    bool                      stage_is_begun    = true;
    unsigned int              stage             = 0;
  };
} // namespace moraine

#endif
