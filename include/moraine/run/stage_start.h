// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_stage_start_h
#define moraine_run_stage_start_h

#include <moraine/diagnostics/diagnostics.h>
#include <moraine/run/model.h>

namespace moraine
{
  /**
   * Find cells and pieces for the first step, refuse what cannot be right, and
   * give the bodies the stress and the motion that they begin with. Collective.
   * @throws InputError, ComputationError for a body that is not held.
   */
  template <int dim>
  void
  begin_first_step(const Scene<dim> &scene,
                   Model<dim>       &model,
                   Diagnostics<dim> &diagnostics);

  /**
   * The same for stage @p k, in a step that has begun after the last one of the
   * stage before: what ends, what acts, and what carries on.
   */
  template <int dim>
  void
  begin_stage(const Scene<dim>  &scene,
              const unsigned int k,
              Model<dim>        &model,
              Diagnostics<dim>  &diagnostics);
} // namespace moraine

#endif
