// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_condition_agreement_h
#define moraine_boundary_condition_agreement_h

#include <moraine/boundary/grid_condition.h>

#include <vector>

namespace moraine
{
  /**
   * Check that conditions that prescribe the same unknown of @p space agree on
   * its change in each of @p n_steps equal steps from @p start, now, to @p end,
   * to 1e-9 of the displacements there (plus what a rigid motion loses in
   * round-off). With @p nodes_follow nodes go where conditions take them.
   *
   * @throws InputError naming both conditions, place and time, on this rank.
   */
  template <int dim>
  void
  check_agreement(const std::vector<GridCondition<dim>> &conditions,
                  const GridSpace<dim>                  &space,
                  const double                           start,
                  const double                           end,
                  const unsigned int                     n_steps,
                  const bool                             nodes_follow);
} // namespace moraine

#endif
