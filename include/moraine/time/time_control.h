// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_time_time_control_h
#define moraine_time_time_control_h

#include <moraine/core/simulation_state.h>
#include <moraine/time/time_integrator.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** Keys of the section "Time". */
  struct TimeParameters
  {
    double start_time = 0.;

    double end_time = 1.;

    /** Equal steps from start to end; their ends are always hit exactly. */
    unsigned int n_steps = 1;

    /** Length of a step along the path of equilibria, with time as an unknown:
     * root mean square of the displacement; 0: steps are of time. */
    double arc_length = 0.;

    /** As a fraction of one step; a cut below it ends the run. */
    double smallest_step = 1e-3;

    /** As a fraction of one step, at most 1; also the first size tried. */
    double largest_step = 1.;

    /** Factor on the size after an easy step. */
    double growth = 2.;

    /** Factor on the size after a rejected step. */
    double cut = 0.5;

    /** Of the estimated error of a step in dynamics, over the cell size; 0:
     * any.
     */
    double error_tolerance = 0.;

    /** A step with at most this many Newton iterations is easy. */
    unsigned int easy_iterations = 5;

    IntegratorParameters integrator;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Throws InputError, naming @p section, if values contradict each other.
     */
    void
    check(const std::string &section = "Time") const;

    bool
    follows_path() const
    {
      return arc_length > 0.;
    }

    /** A path ends here, too: as far before the start as the end is behind. */
    double
    earliest_time() const
    {
      return follows_path() ? 2 * start_time - end_time : start_time;
    }

    /** One of the user's, of time or along the path. */
    double
    one_step() const
    {
      return follows_path() ? arc_length : (end_time - start_time) / n_steps;
    }
  };



  /**
   * Where the run is in time, and how far the next step goes.
   *
   * A run is one interval or several, its stages, each with parameters of its
   * own. An interval is divided by stops: the ends of the user's steps and the
   * times asked for. Between two stops, what remains is split into equal parts
   * no larger than the current size, so that stops are hit exactly and no
   * sliver of a step is left over. An integrator may divide each of these
   * steps once more; then its first part is accepted before the second is
   * tried, and only the second may be the end of a step.
   *
   * The last interval may follow a path of equilibria. Then what is divided is
   * its length, and the solver finds the time; the run ends after the user's
   * steps, or where time reaches the end of the interval or falls as far below
   * its start.
   *
   *     while (!time.finished())
   *       {
   *         time.next();
   *         // solve for time.trial_time()
   *         if (converged)
   *           time.accept(iterations);
   *         else if (!time.reject(reason))
   *           throw ComputationError(time.message());
   *       }
   */
  class TimeControl : public StatePart
  {
  public:
    /** Times in @p stops that lie within the interval are hit exactly, in any
     * order; others are ignored. */
    explicit TimeControl(const TimeParameters      &parameters,
                         const std::vector<double> &stops = {});

    /** The same for stages, each of which starts where the one before ends. */
    explicit TimeControl(const std::vector<TimeParameters> &stages,
                         const std::vector<double>         &stops = {});

    /** Whether the next step follows a path of equilibria. */
    bool
    follows_path() const
    {
      return parameters().follows_path();
    }

    /** Of the trial step, along the path. */
    double
    trial_length() const
    {
      return trial - current;
    }

    /** Of the path so far; 0 without one. */
    double
    path_length() const
    {
      return follows_path() ? current - parameters().start_time : 0.;
    }

    /** Change of time per length in the last accepted step along a path. */
    double
    path_rate() const
    {
      return rate;
    }

    /** Whether the first of two parts of a step is the last that was accepted.
     */
    bool
    between_parts() const
    {
      return parts.first > 0.;
    }

    /** Of the trial step. */
    TimeIntegrator
    integrator() const;

    /** Of a trial step along a path: where it ends. */
    void
    set_trial_time(const double t)
    {
      Assert(follows_path(), dealii::ExcMessage("Steps of time have theirs."));
      found_time = t;
    }

    /** What is divided into steps: time, or where a path begins, its length on
     * top of that. It always grows. */
    double
    coordinate() const
    {
      return current;
    }

    /** Of the end, unless a path ends before. */
    double
    last_coordinate() const
    {
      return stops.back().time;
    }

    /** To which the next step belongs; the last one at the end. */
    unsigned int
    stage() const
    {
      return stops[std::min<std::size_t>(next_stop, stops.size() - 1)].stage;
    }

    /** Choose the next trial time. */
    void
    next();

    /**
     * The trial time becomes the time. The size grows after an easy step, and
     * after several in a row without a cut, however hard; but to no more than
     * @p allowed_growth times that of the step. A stage begins with its own.
     */
    void
    accept(
      const unsigned int iterations,
      const double allowed_growth = std::numeric_limits<double>::infinity());

    /** Data sets "time/...": where the run is, and the size of its steps. */
    void
    write(Archive &archive) const override;

    /** Steps from here on may be others than at the time of writing, and end
     * elsewhere. */
    void
    read(const Archive &archive) override;

    /** Forget the trial time, and cuts since the last accepted step. */
    void
    undo() override;

    /** Whether the trial step may be cut if it fails. */
    bool
    can_cut() const;

    /** Forget the trial time and cut the size, by the factor @p wanted if it is
     * below 1. False if a cut would fall below the smallest size: then
     * message() tells the story. */
    bool
    reject(const std::string &reason, const double wanted = 1.);

    /** After reject(): the next trial has the size of the first one since the
     * last accepted step, because something else than its size was mended. */
    void
    take_back_cuts()
    {
      size      = accepted_size;
      parts.cut = 1.;
    }

    bool
    finished() const
    {
      return path_ended || next_stop == stops.size();
    }

    /** Of the last accepted step. */
    double
    time() const
    {
      return current_time;
    }

    double
    trial_time() const
    {
      return found_time;
    }

    /** Whether time() ends one of the user's steps. */
    bool
    at_step_end() const
    {
      return on_step_end;
    }

    /** The user's steps completed. */
    unsigned int
    n_completed_steps() const
    {
      return completed_steps;
    }

    /** Those in two parts count once. */
    unsigned int
    n_accepted() const
    {
      return accepted;
    }

    unsigned int
    n_rejected() const
    {
      return rejected;
    }

    const std::string &
    message() const
    {
      return text;
    }

  private:
    struct Stop
    {
      double       time; ///< or coordinate()
      bool         ends_step;
      unsigned int stage;
    };

    /** Of a step that the integrator divides. */
    struct Parts
    {
      double first = 0; ///< length of the first if the second is to come
      double end   = 0; ///< of both
      double cut   = 1; ///< of the second, in this step
      /** Whether trials of the first were. */
      bool rejected = false;
    };

    /** After the second part of a step, or all of it. */
    void
    choose_size(const double       taken,
                const unsigned int iterations,
                const double       allowed_growth);

    /** Whether the trial step is the first of two parts. */
    bool
    tries_first_part() const
    {
      return !between_parts() && parameters().integrator.first_part() < 1.;
    }

    /** Of the trial step, in the first of two parts that of both. */
    double
    trial_size() const
    {
      return (tries_first_part() ? parts.end : trial) - current;
    }

    /** Of the stage of the next step. */
    const TimeParameters &
    parameters() const
    {
      return stages[stage()];
    }

    bool
    path_leaves_interval(const double t) const
    {
      return t <= parameters().earliest_time() || t >= parameters().end_time;
    }

    void
    add_stops(const unsigned int stage, const std::vector<double> &asked);

    const std::vector<TimeParameters> stages;
    std::vector<Stop>                 stops;
    unsigned int                      next_stop = 0;
    double                            current; ///< coordinate()
    double                            trial;
    double                            current_time;
    double                            found_time; ///< of the trial step
    double                            size;
    double       accepted_size; ///< after the last accepted step
    Parts        parts;
    bool         trial_is_stop   = false;
    bool         on_step_end     = false;
    bool         path_ended      = false;
    double       rate            = 0; ///< path_rate()
    unsigned int completed_steps = 0;
    unsigned int accepted        = 0;
    unsigned int rejected        = 0;
    unsigned int rejected_before = 0; ///< the last accepted step
    unsigned int in_a_row        = 0; ///< accepted at one size
    std::string  text;
  };



  /** After which accepted steps checkpoints are written. */
  struct CheckpointTimes
  {
    unsigned int steps   = 0; ///< after every so many, unless 0
    double       minutes = 0; ///< of wall time, unless 0

    bool
    never() const
    {
      return steps == 0 && minutes == 0;
    }

    /**
     * From "10 steps", "30 minutes" or "never".
     * @throws InputError naming the key for anything else.
     */
    static CheckpointTimes
    from_text(const std::string &text);
  };



  /** Keys that say after which accepted steps results are written. */
  struct OutputTimes
  {
    /** steps, all or end. */
    std::string when = "steps";

    /** With steps: after every n-th of the user's steps, and at the end. */
    unsigned int every = 1;

    /** As CheckpointTimes::from_text() reads it. */
    std::string checkpoint_every = "never";

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** Whether the start is written too. */
    bool
    at_start() const
    {
      return when != "end";
    }

    /** Whether results are due at @p time, just after TimeControl::accept(). */
    bool
    due(const TimeControl &time) const;
  };
} // namespace moraine

#endif
