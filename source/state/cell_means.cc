// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/cell_means.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  unsigned int
  CellMeans<dim>::number_of(const unsigned int cell)
  {
    if (numbers_of[cell] == numbers::invalid_unsigned_int)
      {
        numbers_of[cell] = cells.size();
        cells.push_back(cell);
        volumes.push_back(0.);
        gradients.resize(gradients.size() + n_corners);
      }
    return numbers_of[cell];
  }



  template <int dim>
  void
  CellMeans<dim>::update(const GridSpace<dim> &space,
                         const Basis<dim>     &basis,
                         const Volume         &volume)
  {
    cells.clear();
    volumes.clear();
    gradients.clear();
    numbers_of.assign(space.mesh().triangulation().n_active_cells(),
                      numbers::invalid_unsigned_int);
    batches.clear();
    cells_of_batches.clear();
    corners_of_batches.clear();
    shares_of_batches.clear();
    StencilBlock<dim> block;
    CellParts<dim>    parts;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        basis.evaluate_parts(g, block, parts);
        append_batch(parts);
        const unsigned int m = parts.cells.size();
        for (unsigned int c = 0; c < m; ++c)
          {
            const unsigned int k = number_of(parts.cells[c]);
            for (unsigned int p = 0; p < block.n_points; ++p)
              {
                const double v = volume(block, p);
                volumes[k] += v * parts.shares[p * m + c];
                for (unsigned int a = 0; a < n_corners; ++a)
                  gradients[k * n_corners + a] +=
                    v * parts.gradients[(p * m + c) * n_corners + a];
              }
          }
      }
    sum_over_ranks(space);
    for (unsigned int k = 0; k < cells.size(); ++k)
      for (unsigned int a = 0; a < n_corners; ++a)
        if (volumes[k] > 0)
          gradients[k * n_corners + a] /= volumes[k];
  }



  template <int dim>
  void
  CellMeans<dim>::sum_over_ranks(const GridSpace<dim> &space)
  {
    constexpr unsigned int n            = 1 + dim * n_corners;
    const auto             communicator = space.communicator();
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;

    using Cells  = std::vector<unsigned int>;
    using Values = std::vector<double>;
    std::map<unsigned int, std::pair<Cells, Values>> messages;
    const auto append = [&](std::pair<Cells, Values> &message,
                            const unsigned int        cell) {
      const unsigned int k = numbers_of[cell];
      message.first.push_back(cell);
      message.second.push_back(volumes[k]);
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          message.second.push_back(gradients[k * n_corners + a][d]);
    };

    // Owners add; then all who have a part get the sum.
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (!cell->is_locally_owned() && numbers_of[cell->active_cell_index()] !=
                                         numbers::invalid_unsigned_int)
        append(messages[cell->subdomain_id()], cell->active_cell_index());
    const auto received = Utilities::MPI::some_to_some(communicator, messages);
    for (const auto &[rank, message] : received)
      for (unsigned int i = 0; i < message.first.size(); ++i)
        {
          const unsigned int k      = number_of(message.first[i]);
          const double      *values = &message.second[n * i];
          volumes[k] += values[0];
          for (unsigned int a = 0; a < n_corners; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              gradients[k * n_corners + a][d] += values[1 + dim * a + d];
        }
    messages.clear();
    for (const auto &[rank, message] : received)
      for (const unsigned int cell : message.first)
        append(messages[rank], cell);
    for (const auto &[rank, message] :
         Utilities::MPI::some_to_some(communicator, messages))
      for (unsigned int i = 0; i < message.first.size(); ++i)
        {
          const unsigned int k      = numbers_of[message.first[i]];
          const double      *values = &message.second[n * i];
          volumes[k]                = values[0];
          for (unsigned int a = 0; a < n_corners; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              gradients[k * n_corners + a][d] = values[1 + dim * a + d];
        }
  }



  template <int dim>
  void
  CellMeans<dim>::append_batch(const CellParts<dim> &parts)
  {
    const unsigned int m = parts.cells.size();
    batches.push_back({static_cast<unsigned int>(cells_of_batches.size()),
                       m,
                       shares_of_batches.size()});
    cells_of_batches.insert(cells_of_batches.end(),
                            parts.cells.begin(),
                            parts.cells.end());
    corners_of_batches.insert(corners_of_batches.end(),
                              parts.places.begin(),
                              parts.places.end());
    if (m > 1)
      shares_of_batches.insert(shares_of_batches.end(),
                               parts.shares.begin(),
                               parts.shares.end());
  }



  template <int dim>
  void
  CellMeans<dim>::attach(const unsigned int batch,
                         StencilBlock<dim> &block) const
  {
    const Batch        &g     = batches[batch];
    CellMeanBlock<dim> &means = block.means;
    means.n_cells             = g.n_cells;
    means.places              = &corners_of_batches[g.first_cell * n_corners];
    means.shares = g.n_cells > 1 ? &shares_of_batches[g.first_share] : nullptr;
    means.gradients.resize(g.n_cells * n_corners);
    for (unsigned int c = 0; c < g.n_cells; ++c)
      std::copy_n(
        &gradients[numbers_of[cells_of_batches[g.first_cell + c]] * n_corners],
        n_corners,
        &means.gradients[c * n_corners]);
  }



  template <int dim>
  const Tensor<1, dim> *
  CellMeans<dim>::of_cell(const unsigned int cell) const
  {
    const unsigned int k = numbers_of[cell];
    return k == numbers::invalid_unsigned_int || !(volumes[k] > 0) ?
             nullptr :
             &gradients[k * n_corners];
  }



  template class CellMeans<2>;
  template class CellMeans<3>;
} // namespace moraine
