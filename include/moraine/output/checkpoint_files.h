// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_checkpoint_files_h
#define moraine_output_checkpoint_files_h

#include <moraine/core/archive.h>
#include <moraine/points/point_fields.h>

#include <string>

namespace moraine
{
  /** What a checkpoint says of itself: data sets of its group "checkpoint". */
  struct CheckpointLabel
  {
    std::string  version, revision; ///< of the program
    std::string  scene;             ///< name of its file
    unsigned int dimension = 0;
    unsigned int step      = 0; ///< steps accepted by then
    double       t         = 0;
    unsigned int ranks     = 1;
    std::string  parameters; ///< all, with their values, as an input file

    void
    write(Archive &archive) const;

    /** @throws InputError, naming @p path, if it is of another format. */
    static CheckpointLabel
    read(const Archive &archive, const std::string &path);
  };

  /**
   * The folder "checkpoints" of a run: a.h5 and b.h5 in turn, and the file
   * "last", which names the last good one.
   */
  class CheckpointFiles
  {
  public:
    /** Of the run in @p folder. */
    CheckpointFiles(const std::string &folder, const MPI_Comm &communicator);

    /**
     * Write @p archive, which has a label, in place of the older checkpoint.
     * Collective.
     * @throws InputError if that fails; then the last good one stays.
     */
    void
    write(const Archive &archive) const;

    /**
     * The path of the last good checkpoint, or if @p from is not empty of the
     * one with that number of steps, or that time if it is no whole number.
     * Collective.
     * @throws InputError saying which there are.
     */
    std::string
    find(const std::string &from) const;

    /** Let the checkpoint in @p path be the last good one: it is not the next
     * to be replaced. Collective. */
    void
    make_last(const std::string &path) const;

    /** What find() could find beside @p path, as a hint; "" if nothing. On
     * rank 0. */
    std::string
    others(const std::string &path) const;

  private:
    /** The name in the file "last"; "" if there is none. */
    std::string
    last() const;

    std::string
    path_of(const std::string &name) const;

    std::string
    find_on_root(const std::string &from) const;

    const std::string folder;
    const MPI_Comm    communicator;
  };
} // namespace moraine

#endif
