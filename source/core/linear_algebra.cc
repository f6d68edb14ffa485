// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/linear_algebra.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace moraine
{
  namespace LA
  {
    using namespace dealii;
    using TrilinosWrappers::types::int_type;

    namespace
    {
      /** Numbers of columns on this rank: its own rows, then the others. */
      class Columns
      {
      public:
        Columns(const IndexSet &owned, const DynamicSparsityPattern &pattern)
          : n_owned(owned.n_elements())
          , first(n_owned > 0 ? *owned.begin() : 0)
        {
          for (const auto row : owned)
            {
              const auto end = pattern.end(row);
              for (auto entry = pattern.begin(row); entry != end; ++entry)
                if (!is_owned(entry->column()))
                  others.push_back(entry->column());
            }
          std::sort(others.begin(), others.end());
          others.erase(std::unique(others.begin(), others.end()), others.end());
        }

        bool
        is_owned(const types::global_dof_index dof) const
        {
          return dof >= first && dof < first + n_owned;
        }

        int
        number(const types::global_dof_index dof) const
        {
          return is_owned(dof) ?
                   dof - first :
                   n_owned +
                     (std::lower_bound(others.begin(), others.end(), dof) -
                      others.begin());
        }

        Epetra_Map
        map(const Epetra_Comm &communicator) const
        {
          std::vector<int_type> dofs(n_owned);
          std::iota(dofs.begin(), dofs.end(), static_cast<int_type>(first));
          dofs.insert(dofs.end(), others.begin(), others.end());
          return Epetra_Map(static_cast<int_type>(-1),
                            static_cast<int>(dofs.size()),
                            dofs.data(),
                            0,
                            communicator);
        }

      private:
        types::global_dof_index              n_owned, first;
        std::vector<types::global_dof_index> others;
      };



      /** Write where rows begin, and their columns in ascending order of
       * numbers, into a matrix that has nothing yet. */
      void
      write_rows(Epetra_CrsMatrix             &rows,
                 const IndexSet               &owned,
                 const DynamicSparsityPattern &pattern,
                 const Columns                &columns)
      {
        auto &offsets = rows.ExpertExtractIndexOffset();
        auto &numbers = rows.ExpertExtractIndices();
        offsets.Resize(owned.n_elements() + 1);
        int *offset = offsets.Values();
        *offset     = 0;
        for (const auto row : owned)
          {
            *(offset + 1) = *offset + static_cast<int>(pattern.row_length(row));
            ++offset;
          }
        numbers.Resize(*offset);
        int             *next = numbers.Values();
        std::vector<int> of_others;
        for (const auto row : owned)
          {
            of_others.clear();
            const auto end = pattern.end(row);
            for (auto entry = pattern.begin(row); entry != end; ++entry)
              if (columns.is_owned(entry->column()))
                *next++ = columns.number(entry->column());
              else
                of_others.push_back(columns.number(entry->column()));
            next = std::copy(of_others.begin(), of_others.end(), next);
          }
      }
    } // namespace



    void
    make_matrix(SparseMatrix                 &matrix,
                const IndexSet               &owned,
                const DynamicSparsityPattern &pattern,
                const MPI_Comm               &communicator)
    {
      Assert(owned.is_contiguous(), ExcInternalError());
      const Columns    columns(owned, pattern);
      const Epetra_Map map = owned.make_trilinos_map(communicator, false);
      Epetra_CrsMatrix rows(Copy, map, columns.map(map.Comm()), 0);
      write_rows(rows, owned, pattern, columns);
      const int error = rows.ExpertStaticFillComplete(map, map);
      AssertThrow(error >= 0,
                  TrilinosWrappers::SparseMatrix::ExcTrilinosError(error));
      matrix.reinit(rows, false);
    }
  } // namespace LA
} // namespace moraine
