// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_skipped_tables_h
#define moraine_run_skipped_tables_h

#include <moraine/scene/scene.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Steps of the largest size may pass over a pulse, and with it over a whole
   * load: add to @p notes each table over time, of a load, a wave or a motion
   * that acts in @p stage, of which they miss a row by more than a tenth of its
   * largest change since the stage began. In the first stage also what does
   * nothing in the whole run: curves that are 0, motions that stay the same.
   */
  template <int dim>
  void
  tell_of_skipped_tables(const Scene<dim>         &scene,
                         const StageParameters    &stage,
                         std::vector<std::string> &notes);
} // namespace moraine

#endif
