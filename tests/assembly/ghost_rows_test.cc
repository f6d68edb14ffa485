// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/ghost_rows.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace dealii;
using namespace moraine;



/** Each rank owns four rows and adds to the first two of the next rank, which
 * have its last two columns and the first two of the next. */
TEST(GhostRows, AreAddedToThoseOfTheirOwners)
{
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                     rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  IndexSet owned(4 * n_ranks);
  owned.add_range(4 * rank, 4 * rank + 4);
  DynamicSparsityPattern pattern(4 * n_ranks, 4 * n_ranks, owned);
  for (const auto row : owned)
    for (unsigned int column = 0; column < 4 * n_ranks; ++column)
      pattern.add(row, column);
  LA::SparseMatrix matrix;
  LA::make_matrix(matrix, owned, pattern, MPI_COMM_WORLD);
  LA::LocalRows                 rows(matrix);
  std::vector<GhostRows::Block> blocks;
  const unsigned int            next = 4 * (rank + 1);
  if (rank + 1 < n_ranks)
    blocks.push_back({next, {next - 2, next - 1, next, next + 1}});
  GhostRows ghosts(blocks, 2, rows, owned, MPI_COMM_WORLD);

  for (unsigned int round = 1; round <= 2; ++round)
    {
      matrix = 0;
      ghosts.set_zero();
      if (!blocks.empty())
        {
          ASSERT_EQ(ghosts.row_length(0), 4u);
          for (unsigned int k = 0; k < 4; ++k)
            EXPECT_EQ(ghosts.columns(0)[k], rows.column(next - 2 + k));
          for (unsigned int k = 0; k < 8; ++k)
            ghosts.values(0)[k] = round * (10. * (rank + 1) + k);
        }
      ghosts.add_to_owners();
      for (const auto row : owned)
        for (unsigned int column = 0; column < 4 * n_ranks; ++column)
          {
            const unsigned int first   = 4 * rank;
            const bool         is_sent = rank > 0 && row < first + 2 &&
                                 column + 2 >= first && column < first + 2;
            const double expected = is_sent ?
                                      round * (10. * rank + 4 * (row - first) +
                                               (column + 2 - first)) :
                                      0.;
            EXPECT_EQ(matrix(row, column), expected);
          }
    }
}
