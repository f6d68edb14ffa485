// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_pvd_history_h
#define moraine_output_pvd_history_h

#include <moraine/core/simulation_state.h>

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * A .pvd file: the list of times and VTU files that ParaView opens as one
   * animation. It is replaced as a whole at each step, so it is complete
   * whenever the run ends.
   */
  class PvdHistory : public StatePart
  {
  public:
    PvdHistory(const std::string &path, const MPI_Comm &communicator);

    /**
     * Add a step and write the file. Collective. The VTU @p file is named
     * relative to the folder of the .pvd file.
     *
     * @throws InputError naming the .pvd file if it cannot be written.
     */
    void
    add(const double time, const std::string &file);

    /** Data sets "output/<name of the file>/...". */
    void
    write(Archive &archive) const override;

    /** Writes the file with the entries of the archive. Collective. */
    void
    read(const Archive &archive) override;

  private:
    void
    write_file(
      const std::vector<std::pair<double, std::string>> &entries) const;

    std::string                                 path;
    MPI_Comm                                    communicator;
    std::vector<std::pair<double, std::string>> times_and_names;
  };
} // namespace moraine

#endif
