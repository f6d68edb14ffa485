// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_checkpoints_h
#define moraine_run_checkpoints_h

#include <moraine/run/resume.h>
#include <moraine/run/run_observer.h>
#include <moraine/run/step_driver.h>

#include <deal.II/base/timer.h>

#include <string>

namespace moraine
{
  /** Writes the checkpoints of a run. All functions are collective. */
  template <int dim>
  class Checkpoints
  {
  public:
    /**
     * Of a run of @p model in @p folder. @p label says what does not change;
     * @p observer hears of checkpoints that could not be written; @p timer gets
     * the time.
     */
    Checkpoints(const CheckpointTimes &times,
                const std::string     &folder,
                const CheckpointLabel &label,
                Model<dim>            &model,
                RunObserver<dim>      &observer,
                dealii::TimerOutput   &timer);

    /** Or one is written only when the user stops the run. */
    bool
    are_asked_for() const
    {
      return !times.never();
    }

    /** The run goes on from @p saved. */
    void
    go_on(const SavedRun &saved);

    /** Write one after an accepted step if it is time for it. */
    void
    after_step(const StepDriver<dim> &driver);

    /**
     * Write one unless there is one of this step, or none was accepted. What
     * the model keeps to go on faster is forgotten, so that the run goes on as
     * one that starts from here.
     * @return whether there is one.
     */
    bool
    write(const StepDriver<dim> &driver);

  private:
    bool
    due(const TimeControl &time) const;

    const CheckpointTimes times;
    const CheckpointFiles files;
    CheckpointLabel       label;
    Model<dim>           &model;
    RunObserver<dim>     &observer;
    dealii::TimerOutput  &timer;
    dealii::Timer         since_last;
    unsigned int          last_step = 0;
  };
} // namespace moraine

#endif
