// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_last_increment_h
#define moraine_state_last_increment_h

#include <moraine/core/simulation_state.h>
#include <moraine/mesh/grid_space.h>

#include <vector>

namespace moraine
{
  /** The increment of the nodes in the last accepted step, for the one that
   * begins with it. By then nodes may have other numbers, or be others. */
  template <int dim>
  class LastIncrement : public StatePart
  {
  public:
    explicit LastIncrement(const GridSpace<dim> &space);

    /** Take over the @p increments of an accepted step. */
    void
    keep(const std::vector<dealii::Tensor<1, dim>> &increments);

    /** For the nodes as they are now, zero where these are new; none if none
     * were kept. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    of_nodes() const;

    /** The same for the unknowns. Collective. */
    LA::Vector
    values() const
    {
      const std::vector<dealii::Tensor<1, dim>> increments = of_nodes();
      return increments.empty() ? space.vector() : space.vector_of(increments);
    }

    /** Group "path/increment". */
    void
    write(Archive &archive) const override
    {
      for (const auto &[name, set] : stored.data_sets())
        archive.add(name, set);
    }

    void
    read(const Archive &archive) override;

  private:
    const GridSpace<dim> &space;
    /** By cells and their nodes. */
    Archive stored;
  };
} // namespace moraine

#endif
