// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_console_report_h
#define moraine_run_console_report_h

#include <moraine/core/console.h>
#include <moraine/run/run_observer.h>
#include <moraine/run/simulation.h>

#include <deal.II/base/timer.h>

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

    /** What will be simulated, and what the user should know of it. */
    void
    describe(const std::vector<std::string> &notes);

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

    /** Say what became of domains and points in the last step. Collective. */
    void
    note_domains();

    /** ", about 3 min left"; nothing before the first step is done. */
    std::string
    time_left(const TimeControl &time) const;

    /** Of the largest step in a cell of typical size. */
    double
    courant_number(const TimeParameters &time) const;

    void
    describe_stage(const unsigned int k);

    void
    print_energy(const Summary &summary);

    void
    print_timings(const Summary &summary);

    void
    print_errors(const Summary &summary);

    const Scene<dim> &scene;
    const Model<dim> &model;
    const RunOptions  options;
    Console          &console;
    dealii::Timer     since_start;
    double            begun; ///< TimeControl::coordinate()
    unsigned int      n_returned      = 0;
    bool              has_far_domains = false;
  };
} // namespace moraine

#endif
