// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_grid_condition_h
#define moraine_boundary_grid_condition_h

#include <moraine/geometry/placement.h>
#include <moraine/mesh/grid_space.h>

#include <deal.II/base/bounding_box.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** Displacements prescribed at nodes of the mesh: on one of its sides or in a
   * region, some or all components, to a value u(x, t). */
  template <int dim>
  struct GridCondition
  {
    std::string                               name;
    std::optional<dealii::types::boundary_id> side;
    std::optional<dealii::BoundingBox<dim>>   region;
    std::array<bool, dim>                     component{};
    /** Prescribed displacement at a place and time; on top of the motion. */
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                         const double)>
                     displacement;
    RigidMotion<dim> motion;
    /** Start of the stage: only changes from then on act. */
    double start = 0;

    /** Displacement from @p t_start to @p t_end of what is at @p x at
     * @p t_start and was at @p X in the mesh as it was built, whose place @p
     * displacement asks for. */
    dealii::Tensor<1, dim>
    increment(const dealii::Point<dim> &x,
              const dealii::Point<dim> &X,
              const double              t_start,
              const double              t_end) const
    {
      return displacement(X, t_end) - displacement(X, t_start) +
             (motion.pose(t_end).map(motion.pose(t_start).inverse(x)) - x);
    }

    /** The same of what is at @p x at @p t_end. */
    dealii::Tensor<1, dim>
    increment_before(const dealii::Point<dim> &x,
                     const dealii::Point<dim> &X,
                     const double              t_start,
                     const double              t_end) const
    {
      return increment(motion.pose(t_start).map(motion.pose(t_end).inverse(x)),
                       X,
                       t_start,
                       t_end);
    }
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

    /** An unknown that two conditions prescribe. */
    struct Shared
    {
      unsigned int node;
      unsigned int component;
      unsigned int first; ///< the condition that has it among the entries
      unsigned int second;
    };
    std::vector<Shared> shared;
  };

  /**
   * Find the nodes the conditions prescribe: those that are on a side or in a
   * region of the mesh as it was built, wherever they have gone with it.
   *
   * @throws InputError naming both conditions if two prescribe the same
   * unknown with different changes from the start of the stage to @p t_end,
   * now.
   */
  template <int dim>
  PrescribedNodes<dim>
  find_prescribed_nodes(const std::vector<GridCondition<dim>> &conditions,
                        const GridSpace<dim>                  &space,
                        const double                           t_end);
} // namespace moraine

#endif
