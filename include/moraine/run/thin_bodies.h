// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_thin_bodies_h
#define moraine_run_thin_bodies_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Add to @p notes what cells are too coarse for and no equation tells: bodies
   * that are nowhere as thick as one and a half linear cells, which bend as
   * they should not unless @p stage holds their sides, and cells that a stiff
   * body fills in part beside a soft one, as one displacement makes all of such
   * a cell stiff, also if that holds back much of the compression of the soft
   * body. Only of bodies that are not @p known from a stage before. Collective.
   */
  template <int dim>
  void
  tell_of_thin_bodies(const StageParameters          &stage,
                      const Model<dim>               &model,
                      const std::vector<std::string> &known,
                      std::vector<std::string>       &notes);
} // namespace moraine

#endif
