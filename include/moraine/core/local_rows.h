// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_local_rows_h
#define moraine_core_local_rows_h

#include <moraine/core/linear_algebra.h>

#include <deal.II/base/types.h>

namespace moraine
{
  namespace LA
  {
    /**
     * The rows of this rank of a matrix as they lie in memory, for sums of very
     * many small matrices. Columns of a row are in ascending order of their
     * numbers on this rank. Valid as long as the matrix has its pattern.
     */
    class LocalRows
    {
    public:
      static constexpr int none = -1;

      LocalRows() = default;

      /** There are no rows if the matrix does not keep them in one piece. */
      explicit LocalRows(SparseMatrix &matrix);

      /** The number of a row on this rank; none if it is another's. */
      int
      row(const dealii::types::global_dof_index dof) const;

      /** The number of a column on this rank; none if no row has it. */
      int
      column(const dealii::types::global_dof_index dof) const;

      unsigned int
      row_length(const int row) const
      {
        return offsets[row + 1] - offsets[row];
      }

      /** The numbers of the columns of a row. */
      const int *
      columns(const int row) const
      {
        return all_columns + offsets[row];
      }

      double *
      values(const int row) const
      {
        return all_values + offsets[row];
      }

    private:
      const SparseMatrix *matrix      = nullptr;
      const int          *offsets     = nullptr;
      const int          *all_columns = nullptr;
      double             *all_values  = nullptr;
    };
  } // namespace LA
} // namespace moraine

#endif
