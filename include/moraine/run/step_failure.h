// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_step_failure_h
#define moraine_run_step_failure_h

#include <moraine/run/model.h>

#include <optional>
#include <string>

namespace moraine
{
  /** The node where the forces of a step that failed are out of balance most.
   */
  template <int dim>
  struct Imbalance
  {
    dealii::Point<dim> place;
    double             filled; ///< part of the cells around it that points fill
    double             fullest; ///< the same of the one that is filled most
  };

  /** None if no force is a finite number above zero; @p residual has the forces
   * of the owned unknowns. Collective. */
  template <int dim>
  std::optional<Imbalance<dim>>
  largest_imbalance(const GridSpace<dim> &space,
                    const PointSet<dim>  &points,
                    const LA::Vector     &residual);

  /** The same in words: "; the largest unbalanced force is at (1, 2), where
   * points fill 3 % of the cells", or empty. Collective. */
  template <int dim>
  std::string
  place_of_imbalance(const GridSpace<dim> &space,
                     const PointSet<dim>  &points,
                     const LA::Vector     &residual);

  /**
   * What may have kept the linear solver from solving for a step, with the keys
   * that help: " (... can be the cause; ...)". Empty if nothing is known.
   * Collective.
   *
   * @param model where the step failed
   * @param ran_out_of_iterations whether an iterative solver did
   * @param empty_parts_have_stiffness whether nodes there are held already
   */
  template <int dim>
  std::string
  cause_of_unsolved(const Model<dim> &model,
                    const bool        ran_out_of_iterations,
                    const bool        empty_parts_have_stiffness);

  /**
   * Name the point that the trial displacements @p x push out of the mesh, and
   * the step; empty if none. Collective.
   */
  template <int dim>
  std::string
  point_that_leaves(const Model<dim>  &model,
                    const TimeControl &time,
                    const LA::Vector  &x);
} // namespace moraine

#endif
