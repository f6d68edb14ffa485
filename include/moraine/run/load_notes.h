// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_load_notes_h
#define moraine_run_load_notes_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * A weight of nothing is a mistake, not a load; so is a push on nothing. A
   * side is pushed by whole faces of cells: add to @p notes which of them
   * material fills in part, and loads that change so much between the places
   * where they are evaluated that their force is another one. In a step of @p
   * stage that has begun. Collective.
   * @throws InputError naming the load.
   */
  template <int dim>
  void
  check_loads(const StageParameters    &stage,
              const Model<dim>         &model,
              std::vector<std::string> &notes);

  /** Add to @p notes how much of the surface of a load does not act: a mesh may
   * end at an axis of symmetry, but nothing is dropped without a word. */
  template <int dim>
  void
  tell_of_loads_outside(const Model<dim>         &model,
                        std::vector<std::string> &notes);
} // namespace moraine

#endif
