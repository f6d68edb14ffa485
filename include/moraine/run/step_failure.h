// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_step_failure_h
#define moraine_run_step_failure_h

#include <moraine/basis/body_parts.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Where the forces of a step that failed are out of balance most, and how
   * much of the cells around that node points fill: "; the largest unbalanced
   * force is at (1, 2), where points fill 3 % of the cells". Empty if no force
   * is a finite number above zero. Collective.
   *
   * @p residual has the forces of the owned unknowns.
   */
  template <int dim>
  std::string
  place_of_imbalance(const GridSpace<dim> &space,
                     const PointSet<dim>  &points,
                     const LA::Vector     &residual);

  /**
   * What to say if a body fell into more parts of at least 1 % of its volume
   * than it had @p at_start; empty if none did.
   */
  template <int dim>
  std::string
  name_separation(const std::vector<std::vector<BodyPart<dim>>> &parts,
                  const std::vector<unsigned int>               &at_start,
                  const std::vector<std::string>                &body_names);
} // namespace moraine

#endif
