// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_start_checks_h
#define moraine_run_start_checks_h

#include <moraine/run/model.h>

namespace moraine
{
  /**
   * Refuse what cannot be right as @p stage begins: boundaries and loads that
   * touch no body, bodies behind a boundary, conditions that contradict each
   * other or have no value, displacements that are not zero as the scene
   * begins, gravity without density. In a step that has begun. Collective.
   * @param scene what is simulated
   * @param stage the stage that begins
   * @param first whether it is the first stage
   * @param model its bodies, boundaries and loads, as the stage begins
   * @throws InputError
   */
  template <int dim>
  void
  check_start(const Scene<dim>      &scene,
              const StageParameters &stage,
              const bool             first,
              Model<dim>            &model);
} // namespace moraine

#endif
