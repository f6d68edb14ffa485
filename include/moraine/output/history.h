// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_history_h
#define moraine_output_history_h

#include <moraine/core/simulation_state.h>
#include <moraine/core/units.h>
#include <moraine/output/named_value.h>

#include <mpi.h>

#include <fstream>
#include <string>
#include <vector>

namespace moraine
{
  /** A text as a cell of a CSV file, in quotes if it needs them. */
  std::string
  csv_cell(const std::string &text);

  /**
   * history.csv: one row for each accepted step, written and flushed at once.
   * The first row fixes the columns; the header gives names and units as
   * "u_y at A [length]", or [m] if the scene has units; a unit "-" is left out.
   * Numbers have 15 digits.
   */
  class History : public StatePart
  {
  public:
    History(const std::string &path,
            const MPI_Comm    &communicator,
            const Units       &units = Units());

    /**
     * Write a row. Rank 0 writes, all ranks give the same columns. Collective.
     *
     * @throws InputError naming the file if it cannot be written.
     */
    void
    add_row(const std::vector<NamedValue> &row);

    /** Data sets "output/history/...": the columns and the rows so far. */
    void
    write(Archive &archive) const override;

    /** Writes the file with the rows of the archive. Collective. */
    void
    read(const Archive &archive) override;

  private:
    /** Write @p rows and, if they are the first, the columns before. */
    void
    write_rows(const std::vector<double> &rows, const bool first);

    std::string              path;
    MPI_Comm                 communicator;
    Units                    units;
    std::ofstream            file;
    std::vector<std::string> columns;
    std::vector<double>      values; ///< row by row
  };
} // namespace moraine

#endif
