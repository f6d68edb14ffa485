// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_removed_bodies_h
#define moraine_run_removed_bodies_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Add to @p notes which loads and boundaries of the stage @p before and of
   * @p stage lie on bodies that go between them, and get hold of what is
   * beside, in the same cells; and which forces on points go with theirs, or
   * act again after theirs went. In a step that has begun with the bodies of
   * the stage before. Collective.
   */
  template <int dim>
  void
  tell_of_removed_bodies(const StageParameters    &stage,
                         const StageParameters    &before,
                         const Model<dim>         &model,
                         std::vector<std::string> &notes);

  /**
   * Take from absorbing boundaries the places on bodies that go, and add to @p
   * notes how much that is. At the same time as tell_of_removed_bodies().
   * Collective.
   */
  template <int dim>
  void
  remove_absorbing_places(const StageParameters    &stage,
                          Model<dim>               &model,
                          std::vector<std::string> &notes);
} // namespace moraine

#endif
