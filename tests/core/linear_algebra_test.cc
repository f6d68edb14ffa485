// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/linear_algebra.h>
#include <moraine/core/local_rows.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace dealii;
using namespace moraine;

namespace
{
  constexpr unsigned int n = 29;

  /** Rows that follow each other; the last of several ranks has none. */
  IndexSet
  rows_of_this_rank()
  {
    const unsigned int n_ranks =
                         Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                       rank  = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                       parts = std::max(1u, n_ranks - 1);
    IndexSet owned(n);
    if (rank < parts)
      owned.add_range(n * rank / parts, n * (rank + 1) / parts);
    return owned;
  }

  /** Neighbours, and the other end of the numbers. */
  DynamicSparsityPattern
  couplings(const IndexSet &rows)
  {
    DynamicSparsityPattern pattern(n, n, rows);
    for (const auto row : rows)
      for (const unsigned int column : {unsigned(row),
                                        unsigned(row + 1) % n,
                                        unsigned(row + n - 1) % n,
                                        unsigned(n - 1 - row)})
        pattern.add(row, column);
    return pattern;
  }

  double
  entry(const unsigned int row, const unsigned int column)
  {
    return 1. + row + 0.01 * column;
  }
} // namespace



TEST(MakeMatrix, HasTheRowsOfThePatternInAscendingOrder)
{
  const IndexSet               owned   = rows_of_this_rank();
  const DynamicSparsityPattern pattern = couplings(owned);
  LA::SparseMatrix             matrix;
  LA::make_matrix(matrix, owned, pattern, MPI_COMM_WORLD);

  const LA::LocalRows rows(matrix);
  for (const auto dof : owned)
    {
      const int  row   = rows.row(dof);
      const int *begin = rows.columns(row);
      const int *end   = begin + rows.row_length(row);
      ASSERT_EQ(rows.row_length(row), pattern.row_length(dof));
      EXPECT_TRUE(std::is_sorted(begin, end));
      for (unsigned int k = 0; k < pattern.row_length(dof); ++k)
        {
          const int column = rows.column(pattern.column_number(dof, k));
          EXPECT_TRUE(std::binary_search(begin, end, column));
          EXPECT_EQ(rows.values(row)[k], 0.);
        }
    }
}



TEST(MakeMatrix, MultipliesWithColumnsOfOtherRanks)
{
  const IndexSet               owned   = rows_of_this_rank();
  const DynamicSparsityPattern pattern = couplings(owned);
  LA::SparseMatrix             matrix;
  LA::make_matrix(matrix, owned, pattern, MPI_COMM_WORLD);
  for (const auto row : owned)
    for (unsigned int k = 0; k < pattern.row_length(row); ++k)
      matrix.add(row,
                 pattern.column_number(row, k),
                 entry(row, pattern.column_number(row, k)));
  matrix.compress(VectorOperation::add);

  LA::Vector x(owned, MPI_COMM_WORLD), Ax(owned, MPI_COMM_WORLD);
  for (const auto dof : owned)
    x[dof] = 1. / (1. + dof);
  x.compress(VectorOperation::insert);
  matrix.vmult(Ax, x);
  for (const auto row : owned)
    {
      double sum = 0;
      for (unsigned int k = 0; k < pattern.row_length(row); ++k)
        {
          const auto column = pattern.column_number(row, k);
          sum += entry(row, column) / (1. + column);
        }
      EXPECT_NEAR(Ax[row], sum, 1e-13 * sum);
    }
}
