// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_node_values_h
#define moraine_state_node_values_h

#include <moraine/core/simulation_state.h>
#include <moraine/mesh/grid_space.h>

#include <string>
#include <vector>

namespace moraine
{
  /** Vectors at nodes, kept for later steps. By then nodes may have other
   * numbers, or be others. */
  template <int dim>
  class NodeValuesRecord : public StatePart
  {
  public:
    /** @p group of archives, which is this one's alone; @p unit of values. */
    NodeValuesRecord(const GridSpace<dim> &space,
                     const std::string    &group,
                     const std::string    &unit);

    /** Keep these @p values, of the nodes as they are now; or none. */
    void
    keep(const std::vector<dealii::Tensor<1, dim>> &values);

    /** For the nodes as they are now, zero where these are new; none if none
     * were kept. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    of_nodes() const;

    /** The same for the unknowns. Collective. */
    LA::Vector
    values() const
    {
      const std::vector<dealii::Tensor<1, dim>> of = of_nodes();
      return of.empty() ? space.vector() : space.vector_of(of);
    }

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
    const std::string     group, unit;
    /** By cells and their nodes. */
    Archive stored;
  };
} // namespace moraine

#endif
