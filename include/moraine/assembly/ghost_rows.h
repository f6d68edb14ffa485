// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_ghost_rows_h
#define moraine_assembly_ghost_rows_h

#include <moraine/core/local_rows.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/types.h>

#include <map>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * Rows of a matrix that other ranks own, for what this rank adds to them.
   * Where their entries lie on their owners is found once; only values are
   * sent.
   */
  class GhostRows
  {
  public:
    /** The first of some rows that follow each other, and the columns that
     * each of them has. */
    using Block = std::pair<dealii::types::global_dof_index,
                            std::vector<dealii::types::global_dof_index>>;

    GhostRows() = default;

    /**
     * Of @p n_rows rows each are the @p blocks, their columns in ascending
     * order of the numbers in @p rows, which has all of them as columns. Valid
     * as long as these are. Collective.
     */
    GhostRows(const std::vector<Block> &blocks,
              const unsigned int        n_rows,
              const LA::LocalRows      &rows,
              const dealii::IndexSet   &owned,
              const MPI_Comm           &communicator);

    /** Number of columns of a block. */
    unsigned int
    row_length(const unsigned int block) const
    {
      return offsets[block + 1] - offsets[block];
    }

    /** The numbers of the columns of a block on this rank. */
    const int *
    columns(const unsigned int block) const
    {
      return all_columns.data() + offsets[block];
    }

    /** The values of a block, row by row. */
    double *
    values(const unsigned int block)
    {
      return all_values.data() + n_rows * offsets[block];
    }

    void
    set_zero();

    /** Collective. */
    void
    add_to_owners();

  private:
    unsigned int              n_rows = 0;
    std::vector<unsigned int> offsets;
    std::vector<unsigned int> owners; ///< ranks, by block
    std::vector<int>          all_columns;
    std::vector<double>       all_values;
    std::map<unsigned int, std::vector<double *>>
             places; ///< here, of the values that a rank sends
    MPI_Comm communicator = MPI_COMM_SELF;
  };
} // namespace moraine

#endif
