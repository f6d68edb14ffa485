// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_held_off_bodies_h
#define moraine_run_held_off_bodies_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Add to @p notes which of @p conditions hold faces of cells of which most,
   * or nodes which all, are further from the bodies, as they were drawn, than a
   * tenth of a cell: these do not reach what holds them, but their cells do. In
   * a step that has begun, where the bodies are as they were drawn, at @p t.
   * Collective.
   */
  template <int dim>
  void
  tell_of_held_off_bodies(const std::vector<GridCondition<dim>> &conditions,
                          const Model<dim>                      &model,
                          const double                           t,
                          std::vector<std::string>              &notes);
} // namespace moraine

#endif
