// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_history_row_h
#define moraine_run_history_row_h

#include <moraine/assembly/term.h>
#include <moraine/output/named_value.h>
#include <moraine/run/condition_results.h>
#include <moraine/run/model.h>
#include <moraine/scene/scene.h>
#include <moraine/time/time_control.h>

#include <vector>

namespace moraine
{
  /** The columns of history.csv with their values after a step, the same at
   * every step. What does not act in a stage has zeros. Collective. */
  template <int dim>
  std::vector<NamedValue>
  history_row(const Scene<dim>                       &scene,
              const Model<dim>                       &model,
              const NamedTranslations<dim>           &translations,
              const TimeControl                      &time,
              const std::vector<BoundaryReport<dim>> &reports);
} // namespace moraine

#endif
