// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_output_directory_h
#define moraine_output_output_directory_h

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>

#include <memory>
#include <string>

namespace moraine
{
  /**
   * The folder a run writes into, and the names of what it writes:
   *
   * original.prm, parameters.prm, log.txt, history.csv, summary.json,
   * points.pvd with points/00000.vtu, ..., mesh.pvd with mesh/00000.vtu, ...,
   * checkpoints/last, a.h5, b.h5
   *
   * As long as it lives, other runs are kept out of the folder.
   */
  class OutputDirectory
  {
  public:
    /**
     * Make the folder, or check the one that is there. Collective.
     *
     * With @p overwrite the files of an earlier run are removed; only files
     * with the names above are. What a run left that failed before its first
     * step is removed in any case.
     *
     * @throws InputError on every rank if the folder holds results of an
     * earlier run and @p overwrite is not set, if a run is under way in it, or
     * if it cannot be made or written.
     */
    OutputDirectory(const std::string &path,
                    const bool         overwrite,
                    const MPI_Comm    &communicator);

    /** The folder of a run that goes on. */
    OutputDirectory(const std::string &path, const MPI_Comm &communicator);

    ~OutputDirectory();

    /** Whether folder @p path holds results of an earlier run. Collective. */
    static bool
    holds_results(const std::string &path, const MPI_Comm &communicator);

    /** Whether it holds the rows of a study. */
    static bool
    holds_study(const std::string &path);

    /** Remove what a study left, but for the folders of its cases. */
    static void
    remove_study(const std::string &path);

    /** Path of a file in the folder. */
    std::string
    file(const std::string &name) const;

    /** "points/00012.vtu": name of a VTU file relative to the folder. */
    static std::string
    vtu_name(const std::string &series, const unsigned int number);

    /** Remove VTU files with this number and later ones. Collective. */
    void
    remove_vtu_from(const unsigned int number) const;

    /**
     * Write parameters.prm: every parameter with its value and text.
     * Collective.
     * @throws InputError naming the file if it cannot be written.
     */
    void
    write_parameters(const dealii::ParameterHandler &prm) const;

    /**
     * Write original.prm, the file as given, and parameters.prm, every
     * parameter with its value and text. Collective.
     *
     * @throws InputError naming the file if it cannot be written.
     */
    void
    write_parameter_files(const std::string              &original_text,
                          const dealii::ParameterHandler &prm) const;

  private:
    class Lock;

    std::string           path;
    MPI_Comm              communicator;
    std::unique_ptr<Lock> lock; ///< on rank 0
  };
} // namespace moraine

#endif
