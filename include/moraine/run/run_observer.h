// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_run_observer_h
#define moraine_run_run_observer_h

#include <moraine/output/summary.h>
#include <moraine/run/model.h>

#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** What the steps of a run took so far, rejected ones included. */
  struct RunCounts
  {
    unsigned int          newton_iterations  = 0;
    unsigned int          linear_iterations  = 0;
    unsigned int          n_pseudo_transient = 0;
    std::optional<double> condition_number;
    /** What solved the last linear system. */
    std::string linear_solver;
    /**
     * Values of the stiffness of empty parts, smallest first, that the last
     * accepted step had or that were tried since, because a matrix was singular
     * or steps failed.
     */
    unsigned int n_fictitious_stiffness = 0;
    /** If the scene has a ghost term. */
    std::optional<GhostShares> ghost_term;
  };

  /** A step that was just accepted. */
  template <int dim>
  struct AcceptedStep
  {
    const TimeControl                      &time;
    double                                  t_start;
    const NewtonReport                     &newton;
    const std::vector<BoundaryReport<dim>> &reports;
    std::vector<dealii::Tensor<1, dim>>     increments; ///< of the nodes
    /** Largest increment of a step that ended by Newton::pseudo_transient(). */
    std::optional<double> pseudo_transient;
  };

  /**
   * Is told how a run goes. Every rank has the same observers and tells them
   * the same, so that they may do what is collective. They see the model as the
   * last accepted step left it.
   */
  template <int dim>
  class RunObserver
  {
  public:
    virtual ~RunObserver() = default;

    /** What it has written so far, from which it can go on; nullptr: nothing.
     * It lives as long as the observer. */
    virtual StatePart *
    record()
    {
      return nullptr;
    }

    virtual void
    run_begins()
    {}

    /** In place of run_begins(), after record() was read: it goes on from @p
     * time. */
    virtual void
    run_resumes(const TimeControl & /*time*/)
    {}

    virtual void
    step_accepted(const AcceptedStep<dim> &)
    {}

    /** In the step from time.time() to time.trial_time(). */
    virtual void
    newton_iteration([[maybe_unused]] const NewtonIteration &iteration,
                     [[maybe_unused]] const TimeControl     &time)
    {}

    /** The step to @p t, for @p reason. */
    virtual void
    step_rejected([[maybe_unused]] const double       t,
                  [[maybe_unused]] const std::string &reason)
    {}

    /** Something to know about the step under way. */
    virtual void
    note(const std::string &)
    {}

    /** All went well, or the run ended early with what was accepted. */
    virtual void
    run_ends(const Summary &, const RunCounts &)
    {}

    /** The run ends with an error, which is thrown next. */
    virtual void
    run_fails(const Summary &)
    {}
  };
} // namespace moraine

#endif
