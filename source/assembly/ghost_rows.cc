// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/ghost_rows.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Where the values of @p blocks lie, row by row. */
    std::vector<double *>
    find_values(const std::vector<GhostRows::Block> &blocks,
                const unsigned int                   n_rows,
                const LA::LocalRows                 &rows)
    {
      std::vector<double *> places;
      for (const auto &[first_row, columns] : blocks)
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            const int  row   = rows.row(first_row + r);
            const int *begin = rows.columns(row);
            const int *end   = begin + rows.row_length(row);
            for (const auto dof : columns)
              {
                const int  column = rows.column(dof);
                const int *found  = std::lower_bound(begin, end, column);
                AssertThrow(found != end && *found == column,
                            ExcInternalError());
                places.push_back(rows.values(row) + (found - begin));
              }
          }
      return places;
    }
  } // namespace



  GhostRows::GhostRows(const std::vector<Block> &blocks,
                       const unsigned int        n_rows,
                       const LA::LocalRows      &rows,
                       const IndexSet           &owned,
                       const MPI_Comm           &communicator)
    : n_rows(n_rows)
    , offsets(1, 0)
    , communicator(communicator)
  {
    IndexSet first_rows(owned.size());
    for (const auto &[first_row, columns] : blocks)
      {
        first_rows.add_index(first_row);
        for (const auto dof : columns)
          all_columns.push_back(rows.column(dof));
        offsets.push_back(all_columns.size());
      }
    all_values.resize(n_rows * all_columns.size());
    const std::vector<unsigned int> owners_of_rows =
      Utilities::MPI::compute_index_owner(owned, first_rows, communicator);
    std::map<unsigned int, std::vector<Block>> of_owners;
    for (const Block &block : blocks)
      {
        owners.push_back(
          owners_of_rows[first_rows.index_within_set(block.first)]);
        of_owners[owners.back()].push_back(block);
      }
    for (const auto &[rank, received] :
         Utilities::MPI::some_to_some(communicator, of_owners))
      places[rank] = find_values(received, n_rows, rows);
  }



  void
  GhostRows::set_zero()
  {
    std::fill(all_values.begin(), all_values.end(), 0.);
  }



  void
  GhostRows::add_to_owners()
  {
    std::map<unsigned int, std::vector<double>> of_owners;
    for (unsigned int block = 0; block < owners.size(); ++block)
      {
        std::vector<double> &sent  = of_owners[owners[block]];
        const double        *begin = values(block);
        sent.insert(sent.end(), begin, begin + n_rows * row_length(block));
      }
    for (const auto &[rank, received] :
         Utilities::MPI::some_to_some(communicator, of_owners))
      {
        const std::vector<double *> &of_rank = places.at(rank);
        AssertDimension(received.size(), of_rank.size());
        for (std::size_t i = 0; i < received.size(); ++i)
          *of_rank[i] += received[i];
      }
  }
} // namespace moraine
