// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_simulation_h
#define moraine_run_simulation_h

#include <moraine/core/console.h>
#include <moraine/core/input_file.h>
#include <moraine/output/summary.h>
#include <moraine/run/model.h>

#include <functional>
#include <string>

namespace moraine
{
  /** What the console shows: the end; each step; each Newton iteration. */
  enum class Verbosity
  {
    quiet,
    normal,
    verbose
  };

  struct SavedRun;

  /** How `moraine run` or `moraine resume` was called. */
  struct RunOptions
  {
    std::string output_directory; ///< overrides the scene's
    bool        overwrite    = false;
    bool        write_output = true; ///< studies keep the summary only
    Verbosity   verbosity    = Verbosity::normal;
    /** What the run in the output directory goes on from; nullptr: it begins.
     * Its state is gone when it was read. */
    SavedRun *saved = nullptr;
  };

  /** What is done with a model after its last step. */
  template <int dim>
  using AfterRun = std::function<void(Model<dim> &)>;

  /**
   * Read a scene, set it up, step to the end and write the results. Whatever
   * fails, nothing of an earlier run in the output directory is left once the
   * directory may be written over: before anything is computed its files are
   * removed, and a run that fails leaves a summary.json that says so. A run
   * that goes on removes what it wrote after the checkpoint. @p after_run is
   * called if the run reached its end.
   *
   * @return the summary, also when the run ended early; its status says so.
   * @throws InputError for mistakes, also those that show only in the set-up:
   * empty or overlapping bodies, boundaries that touch no body.
   */
  template <int dim>
  Summary
  simulate(const InputFile     &input,
           const RunOptions    &options,
           const MPI_Comm      &communicator,
           Console             &console,
           const AfterRun<dim> &after_run = {});

  /** Set up a scene and print what would be simulated, with the findings of
   * the diagnostics. @return whether there are any. */
  template <int dim>
  bool
  describe(const InputFile &input,
           const MPI_Comm  &communicator,
           Console         &console);
} // namespace moraine

#endif
