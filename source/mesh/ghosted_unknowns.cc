// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/ghosted_unknowns.h>

#include <algorithm>
#include <utility>

namespace moraine
{
  using namespace dealii;

  void
  GhostedUnknowns::reinit(const IndexSet &owned,
                          const IndexSet &relevant,
                          const MPI_Comm &communicator)
  {
    // One that served other unknowns cannot be used again (deal.II 9.4).
    partitioner =
      std::make_unique<const Utilities::MPI::Partitioner>(owned,
                                                          relevant,
                                                          communicator);
    zeros = std::make_unique<const LA::Vector>(owned, communicator);
    values.resize(partitioner->locally_owned_size() +
                  partitioner->n_ghost_indices());
    to_send.resize(partitioner->n_import_indices());
  }



  const std::vector<double> &
  GhostedUnknowns::array_of(const LA::Vector &vector)
  {
    const unsigned int n_owned = partitioner->locally_owned_size();
    AssertDimension(vector.locally_owned_size(), n_owned);
    std::copy_n(vector.begin(), n_owned, values.begin());
    const ArrayView<double>  ghosts(values.data() + n_owned,
                                   partitioner->n_ghost_indices());
    std::vector<MPI_Request> requests;
    partitioner->export_to_ghosted_array_start<double, MemorySpace::Host>(
      0,
      ArrayView<const double>(values.data(), n_owned),
      ArrayView<double>(to_send.data(), to_send.size()),
      ghosts,
      requests);
    partitioner->export_to_ghosted_array_finish<double, MemorySpace::Host>(
      ghosts, requests);
    return values;
  }



  void
  GhostedUnknowns::add_to_owners(LA::Vector &sums)
  {
    const unsigned int       n_owned = partitioner->locally_owned_size();
    const ArrayView<double>  ghosts(values.data() + n_owned,
                                   partitioner->n_ghost_indices());
    std::vector<MPI_Request> requests;
    partitioner->import_from_ghosted_array_start<double, MemorySpace::Host>(
      VectorOperation::add,
      0,
      ghosts,
      ArrayView<double>(to_send.data(), to_send.size()),
      requests);
    partitioner->import_from_ghosted_array_finish<double, MemorySpace::Host>(
      VectorOperation::add,
      ArrayView<const double>(to_send.data(), to_send.size()),
      ArrayView<double>(values.data(), n_owned),
      ghosts,
      requests);
    LA::Vector result(*zeros);
    std::copy_n(values.begin(), n_owned, result.begin());
    sums = std::move(result);
  }
} // namespace moraine
