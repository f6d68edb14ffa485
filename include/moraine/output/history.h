// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_history_h
#define moraine_output_history_h

#include <moraine/output/named_value.h>

#include <mpi.h>

#include <fstream>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * history.csv: one row for each accepted step, written and flushed at once.
   * The first row fixes the columns; the header gives names and units as
   * "u_y at A [length]", a unit "-" is left out. Numbers have 15 digits.
   */
  class History
  {
  public:
    History(const std::string &path, const MPI_Comm &communicator);

    /**
     * Write a row. Rank 0 writes, all ranks give the same columns. Collective.
     *
     * @throws InputError naming the file if it cannot be written.
     */
    void
    add_row(const std::vector<NamedValue> &row);

  private:
    void
    write_row(const std::vector<NamedValue> &row);

    std::string              path;
    MPI_Comm                 communicator;
    std::ofstream            file;
    std::vector<std::string> columns;
  };
} // namespace moraine

#endif
