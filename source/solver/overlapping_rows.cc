// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/overlapping_rows.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_MultiVector.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Part of the diagonal that a singular block gets on top of it. */
    constexpr double diagonal_added = 1e-8;



    using Numbers = std::vector<TrilinosWrappers::types::int_type>;



    /** Columns of @p rows that are not among the sorted numbers @p known. */
    Numbers
    new_columns(const Epetra_CrsMatrix &rows, const Numbers &known)
    {
      Numbers all;
      for (int c = 0; c < rows.NumMyCols(); ++c)
        if (!std::binary_search(known.begin(),
                                known.end(),
                                rows.ColMap().GID(c)))
          all.push_back(rows.ColMap().GID(c));
      std::sort(all.begin(), all.end());
      return all;
    }



    Epetra_Map
    map_of(const Numbers &numbers, const Epetra_Comm &communicator)
    {
      return Epetra_Map(static_cast<TrilinosWrappers::types::int_type>(-1),
                        static_cast<int>(numbers.size()),
                        numbers.data(),
                        0,
                        communicator);
    }



    /** Rows of @p matrix with these @p numbers. Collective. */
    std::unique_ptr<Epetra_CrsMatrix>
    import_rows(const Epetra_CrsMatrix &matrix, const Numbers &numbers)
    {
      const Epetra_Map map  = map_of(numbers, matrix.Comm());
      auto             rows = std::make_unique<Epetra_CrsMatrix>(Copy, map, 0);
      rows->Import(matrix, Epetra_Import(map, matrix.RowMap()), Insert);
      rows->FillComplete(matrix.DomainMap(), map);
      return rows;
    }
  } // namespace



  OverlappingRows::OverlappingRows(const LA::SparseMatrix &matrix,
                                   const unsigned int      layers)
    : owned(matrix.locally_owned_range_indices())
    , communicator(matrix.get_mpi_communicator())
    , n_owned_rows(matrix.trilinos_matrix().NumMyRows())
    , begins(1, 0)
  {
    const Epetra_CrsMatrix                        &A = matrix.trilinos_matrix();
    std::vector<std::unique_ptr<Epetra_CrsMatrix>> others;
    Numbers numbers(A.RowMap().MyGlobalElements(),
                    A.RowMap().MyGlobalElements() + n_owned_rows);
    Numbers sorted = numbers;
    std::sort(sorted.begin(), sorted.end());
    if (A.Comm().NumProc() > 1)
      for (unsigned int layer = 0; layer < layers; ++layer)
        {
          const Numbers added =
            new_columns(layer == 0 ? A : *others.back(), sorted);
          others.push_back(import_rows(A, added));
          numbers.insert(numbers.end(), added.begin(), added.end());
          sorted.insert(sorted.end(), added.begin(), added.end());
          std::sort(sorted.begin(), sorted.end());
        }
    map      = std::make_unique<Epetra_Map>(map_of(numbers, A.Comm()));
    importer = std::make_unique<Epetra_Import>(*map, A.RowMap());

    const auto append = [this](const Epetra_CrsMatrix &rows) {
      std::vector<int> row_of(rows.NumMyCols());
      for (int c = 0; c < rows.NumMyCols(); ++c)
        row_of[c] = map->LID(rows.ColMap().GID(c));
      for (int i = 0; i < rows.NumMyRows(); ++i)
        {
          int     n_entries;
          double *entries;
          int    *where;
          rows.ExtractMyRowView(i, n_entries, entries, where);
          for (int e = 0; e < n_entries; ++e)
            if (row_of[where[e]] >= 0)
              {
                columns.push_back(row_of[where[e]]);
                values.push_back(entries[e]);
              }
          begins.push_back(columns.size());
        }
    };
    append(A);
    for (const auto &rows : others)
      append(*rows);
  }



  OverlappingRows::~OverlappingRows() = default;



  BlockFactors
  OverlappingRows::factorise(const std::vector<unsigned int> &unknowns) const
  {
    std::vector<int> number(n_rows(), -1);
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      number[unknowns[k]] = k;
    BlockFactors::Rows block;
    block.begins.push_back(0);
    std::vector<std::pair<int, double>> row;
    std::vector<std::size_t>            diagonal;
    for (const unsigned int i : unknowns)
      {
        row.clear();
        for (auto e = begin(i); e < begin(i + 1); ++e)
          if (number[column(e)] >= 0)
            row.emplace_back(number[column(e)], value(e));
        std::sort(row.begin(), row.end());
        for (const auto &[column, value] : row)
          {
            if (column == number[i])
              diagonal.push_back(block.values.size());
            block.columns.push_back(column);
            block.values.push_back(value);
          }
        block.begins.push_back(block.columns.size());
      }
    BlockFactors factors(block);
    if (!factors.is_singular())
      return factors;
    for (const std::size_t entry : diagonal)
      block.values[entry] *= 1 + diagonal_added;
    return BlockFactors(block);
  }



  std::vector<std::vector<double>>
  OverlappingRows::import(const std::vector<std::vector<double>> &owned) const
  {
    Epetra_MultiVector source(importer->SourceMap(), owned.size());
    Epetra_MultiVector target(*map, owned.size());
    for (unsigned int v = 0; v < owned.size(); ++v)
      std::copy(owned[v].begin(), owned[v].end(), source[v]);
    target.Import(source, *importer, Insert);
    std::vector<std::vector<double>> all(owned.size());
    for (unsigned int v = 0; v < owned.size(); ++v)
      all[v].assign(target[v], target[v] + n_rows());
    return all;
  }



  void
  OverlappingRows::import(std::vector<double> &all,
                          const LA::Vector    &owned) const
  {
    all.resize(n_rows());
    Epetra_MultiVector target(View, *map, all.data(), n_rows(), 1);
    target.Import(owned.trilinos_vector(), *importer, Insert);
  }



  LA::Vector
  OverlappingRows::sum(const std::vector<double> &all) const
  {
    const Epetra_MultiVector source(
      View, *map, const_cast<double *>(all.data()), n_rows(), 1);
    LA::Vector sum(owned, communicator);
    sum.trilinos_vector().Export(source, *importer, Add);
    return sum;
  }
} // namespace moraine
