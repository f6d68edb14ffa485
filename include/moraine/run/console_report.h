// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_console_report_h
#define moraine_run_console_report_h

#include <moraine/core/console.h>
#include <moraine/run/run_observer.h>
#include <moraine/run/simulation.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <string>
#include <vector>

namespace moraine
{
  /** Tells on the console what is simulated, each step, and where time went. */
  template <int dim>
  class ConsoleReport : public RunObserver<dim>, public StatePart
  {
  public:
    /** The folder of the results is empty if there are none. */
    ConsoleReport(const Scene<dim> &scene,
                  const Model<dim> &model,
                  const RunOptions &options,
                  Console          &console);

    /** The program and the title of the scene. */
    void
    introduce();

    /** What will be simulated. */
    void
    describe();

    /** A finding as it comes: in the log, with verbose on the console. */
    void
    finding(const Finding &finding);

    /** Its line on the console. */
    void
    print(const Finding &finding);

    StatePart *
    record() override
    {
      return this;
    }

    /** Data sets "console/...": what was told, and where the log ends.
     * Collective. */
    void
    write(Archive &archive) const override;

    /** Goes on with the log after what it had. */
    void
    read(const Archive &archive) override;

    void
    run_begins() override;

    void
    run_resumes(const TimeControl &time) override;

    void
    step_accepted(const AcceptedStep<dim> &step) override;

    /** A line with verbose, else progress on a terminal. */
    void
    newton_iteration(const NewtonIteration &iteration,
                     const TimeControl     &time) override;

    void
    step_rejected(const double t, const std::string &reason) override;

    void
    note(const std::string &text) override;

    void
    run_ends(const Summary &summary, const RunCounts &counts) override;

  private:
    void
    describe_method();

    void
    describe_bodies();

    void
    describe_conditions();

    /** ", about 3 min left"; nothing before the first step is done. */
    std::string
    time_left(const TimeControl &time) const;

    /** Of the largest step in a cell of typical size. */
    double
    courant_number(const TimeParameters &time) const;

    void
    describe_stage(const unsigned int k);

    /** Run @p print with the log alone, or with verbose on the console, too. */
    void
    in_detail(const std::function<void()> &print);

    const Scene<dim> &scene;
    const Model<dim> &model;
    const RunOptions  options;
    Console          &console;
    dealii::Timer     since_start;
    double            begun; ///< TimeControl::coordinate()
  };
} // namespace moraine

#endif
