// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_overlapping_rows_h
#define moraine_solver_overlapping_rows_h

#include <deal.II/base/index_set.h>

#include <moraine/core/linear_algebra.h>

#include <moraine/solver/block_factors.h>

#include <memory>
#include <vector>

class Epetra_Import;
class Epetra_Map;

namespace moraine
{
  /**
   * A copy of the rows that a rank owns and of those of other ranks around
   * them, numbered from 0 on: its own first, in their order, then the others.
   */
  class OverlappingRows
  {
  public:
    /** @p layers: how many times the columns of all rows that are there become
     * rows. Collective. */
    OverlappingRows(const LA::SparseMatrix &matrix, const unsigned int layers);

    ~OverlappingRows();

    unsigned int
    n_owned() const
    {
      return n_owned_rows;
    }

    unsigned int
    n_rows() const
    {
      return begins.size() - 1;
    }

    /** Entries of row i are those from begin(i) to begin(i + 1). */
    std::size_t
    begin(const unsigned int row) const
    {
      return begins[row];
    }

    /** Of an entry, in the numbers of rows; columns that are no rows here are
     * left out. */
    unsigned int
    column(const std::size_t entry) const
    {
      return columns[entry];
    }

    double
    value(const std::size_t entry) const
    {
      return values[entry];
    }

    /** The block of the matrix that has these rows and columns, in the order of
     * @p unknowns. If it is singular, as that of a body which nothing holds,
     * its diagonal gets a little larger. */
    BlockFactors
    factorise(const std::vector<unsigned int> &unknowns) const;

    /** Of each vector, values of the rank's own rows to those of all rows.
     * Collective. */
    std::vector<std::vector<double>>
    import(const std::vector<std::vector<double>> &owned) const;

    /** Values of the rank's own rows to those of all rows. Collective. */
    void
    import(std::vector<double> &all, const LA::Vector &owned) const;

    /** Of what all ranks have for a row, on its owner. Collective. */
    LA::Vector
    sum(const std::vector<double> &all) const;

  private:
    dealii::IndexSet               owned;
    MPI_Comm                       communicator;
    unsigned int                   n_owned_rows;
    std::vector<std::size_t>       begins;
    std::vector<unsigned int>      columns;
    std::vector<double>            values;
    std::unique_ptr<Epetra_Map>    map;
    std::unique_ptr<Epetra_Import> importer;
  };
} // namespace moraine

#endif
