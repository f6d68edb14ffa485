// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_boundary_ends_h
#define moraine_run_boundary_ends_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Add to @p notes which boundaries begin in @p stage, not @p known from the
   * one before, and end inside cells that have more of a body's rim: functions
   * of these cells hold that, too. In a step that has begun. Collective.
   */
  template <int dim>
  void
  tell_of_ends(const StageParameters          &stage,
               const std::vector<std::string> &known,
               const Model<dim>               &model,
               std::vector<std::string>       &notes);
} // namespace moraine

#endif
