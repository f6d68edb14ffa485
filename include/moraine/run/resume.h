// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_resume_h
#define moraine_run_resume_h

#include <moraine/output/checkpoint_files.h>
#include <moraine/scene/scene.h>

#include <string>

namespace moraine
{
  /** A checkpoint from which a run goes on. */
  struct SavedRun
  {
    std::string     path;
    CheckpointLabel label;
    Archive         state;
  };

  /**
   * The last checkpoint of the run in @p folder, or the one that @p from names,
   * see CheckpointFiles::find(). Collective.
   * @throws InputError if there is none, or if it is damaged or of another
   * format.
   */
  SavedRun
  read_checkpoint(const std::string &folder,
                  const std::string &from,
                  const MPI_Comm    &communicator);

  /**
   * Compare @p scene, which @p input describes, with its @p parameters as an
   * input file, with that of the checkpoint.
   * @return keys that the program of the checkpoint did not have, and their
   * defaults, in words; "" if there are none.
   * @throws InputError naming all keys that a run cannot change on its way.
   */
  template <int dim>
  std::string
  check_changes(const SavedRun    &saved,
                const Scene<dim>  &scene,
                const InputFile   &input,
                const std::string &parameters);
} // namespace moraine

#endif
