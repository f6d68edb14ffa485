// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_simulation_h
#define moraine_run_simulation_h

#include <moraine/core/console.h>
#include <moraine/output/summary.h>
#include <moraine/run/scene.h>

#include <string>

namespace moraine
{
  /** How `moraine run` was called. */
  struct RunOptions
  {
    std::string output_directory; ///< overrides the scene's
    bool        overwrite    = false;
    bool        write_output = true; ///< studies keep the summary only
  };

  /**
   * Set up a scene, step to the end and write the results.
   * @return the summary, also when the run ended early; its status says so.
   * @throws InputError for mistakes that show only now: empty or overlapping
   * bodies, bodies outside the mesh, boundaries that touch no body.
   */
  template <int dim>
  Summary
  simulate(Scene<dim>       &scene,
           const InputFile  &input,
           const RunOptions &options,
           const MPI_Comm   &communicator,
           Console          &console);

  /** Set up a scene and say what would be simulated. */
  template <int dim>
  void
  describe(const Scene<dim> &scene,
           const MPI_Comm   &communicator,
           Console          &console);
} // namespace moraine

#endif
