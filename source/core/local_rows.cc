// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/local_rows.h>

#include <Epetra_CrsMatrix.h>

namespace moraine
{
  namespace LA
  {
    using dealii::TrilinosWrappers::types::int_type;

    LocalRows::LocalRows(SparseMatrix &matrix_)
    {
      int *row_starts = nullptr, *column_numbers = nullptr;
      if (matrix_.trilinos_matrix().ExtractCrsDataPointers(row_starts,
                                                           column_numbers,
                                                           all_values) != 0)
        return;
      matrix      = &matrix_;
      offsets     = row_starts;
      all_columns = column_numbers;
    }



    int
    LocalRows::row(const dealii::types::global_dof_index dof) const
    {
      return matrix ?
               matrix->trilinos_matrix().LRID(static_cast<int_type>(dof)) :
               none;
    }



    int
    LocalRows::column(const dealii::types::global_dof_index dof) const
    {
      return matrix ?
               matrix->trilinos_matrix().LCID(static_cast<int_type>(dof)) :
               none;
    }
  } // namespace LA
} // namespace moraine
