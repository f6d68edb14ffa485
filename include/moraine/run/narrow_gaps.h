// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_narrow_gaps_h
#define moraine_run_narrow_gaps_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Add to @p notes which bodies have a slot or hole that cells are too coarse
   * for: material on both sides of it touches the same nodes and hangs
   * together. What is a cell deep or more somewhere is none, so that notches
   * and holes which cells resolve are not told of. Only bodies that are not @p
   * known from a stage before. Collective.
   */
  template <int dim>
  void
  tell_of_narrow_gaps(const Model<dim>               &model,
                      const std::vector<std::string> &known,
                      std::vector<std::string>       &notes);
} // namespace moraine

#endif
