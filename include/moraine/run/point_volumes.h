// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_point_volumes_h
#define moraine_run_point_volumes_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Add to @p notes what volumes of points and of cells have to do with each
   * other in the first step: points that are given, by a file or as a grid, may
   * have volumes that are not theirs, and may lie so that a method without
   * domains integrates unevenly with them. Collective.
   */
  template <int dim>
  void
  tell_of_point_volumes(const Model<dim>         &model,
                        std::vector<std::string> &notes);

  /**
   * Add to @p notes new bodies that stand where material is: it has moved since
   * it was drawn. @p bodies are those of a stage that begins, @p known those of
   * the one before. Collective.
   */
  template <int dim>
  void
  tell_of_volume_twice(const Model<dim>               &model,
                       const std::vector<std::string> &bodies,
                       const std::vector<std::string> &known,
                       std::vector<std::string>       &notes);
} // namespace moraine

#endif
