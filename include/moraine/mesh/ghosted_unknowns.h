// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_ghosted_unknowns_h
#define moraine_mesh_ghosted_unknowns_h

#include <moraine/core/linear_algebra.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace moraine
{
  /**
   * An array of the unknowns that a rank owns, followed by those of others that
   * it needs, and what ranks send each other: found once, where vectors of the
   * linear algebra would ask all ranks each time.
   */
  class GhostedUnknowns
  {
  public:
    /** @p relevant: owned and needed ones. Collective. */
    void
    reinit(const dealii::IndexSet &owned,
           const dealii::IndexSet &relevant,
           const MPI_Comm         &communicator);

    /** Where an unknown stands in the array. */
    unsigned int
    index(const dealii::types::global_dof_index unknown) const
    {
      return partitioner->global_to_local(unknown);
    }

    /** A vector of zeros. Copying it asks no other rank. */
    const LA::Vector &
    zero_vector() const
    {
      return *zeros;
    }

    /** The array of a vector, until the next call. Collective. */
    const std::vector<double> &
    array_of(const LA::Vector &vector);

    /** An array of zeros to be filled, for add_to_owners(). */
    std::vector<double> &
    zero_array()
    {
      std::fill(values.begin(), values.end(), 0.);
      return values;
    }

    /** The sums over all ranks of what is in the array now. Collective. */
    void
    add_to_owners(LA::Vector &sums);

  private:
    /** Before the first reinit() there are no unknowns. */
    std::unique_ptr<const dealii::Utilities::MPI::Partitioner> partitioner =
      std::make_unique<const dealii::Utilities::MPI::Partitioner>();
    std::unique_ptr<const LA::Vector> zeros =
      std::make_unique<const LA::Vector>();
    std::vector<double> values;
    std::vector<double> to_send;
  };
} // namespace moraine

#endif
