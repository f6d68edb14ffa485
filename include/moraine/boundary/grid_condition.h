// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_grid_condition_h
#define moraine_boundary_grid_condition_h

#include <moraine/mesh/grid_space.h>

#include <deal.II/base/bounding_box.h>

#include <functional>
#include <optional>
#include <string>

namespace moraine
{
  /**
   * Displacements prescribed at nodes of the mesh: on one of its sides or in a
   * region, some or all components, to a value u(x, t).
   */
  template <int dim>
  struct GridCondition
  {
    std::string                               name;
    std::optional<dealii::types::boundary_id> side;
    std::optional<dealii::BoundingBox<dim>>   region;
    std::array<bool, dim>                     component{};
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                         const double)>
      value;
  };

  /** The unknowns of this rank that grid conditions prescribe. */
  template <int dim>
  struct PrescribedNodes
  {
    struct Entry
    {
      unsigned int node;
      unsigned int component;
      unsigned int condition;
    };
    std::vector<Entry> entries;
  };

  /**
   * Find the nodes the conditions prescribe.
   *
   * @throws InputError naming both conditions if two prescribe the same
   * unknown with different values at @p t_end.
   */
  template <int dim>
  PrescribedNodes<dim>
  find_prescribed_nodes(const std::vector<GridCondition<dim>> &conditions,
                        const GridSpace<dim>                  &space,
                        const double                           t_end);
} // namespace moraine

#endif
