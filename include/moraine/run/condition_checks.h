// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_condition_checks_h
#define moraine_run_condition_checks_h

#include <moraine/run/model.h>
#include <moraine/scene/scene.h>

#include <string>
#include <vector>

namespace moraine
{
  /** That grid conditions of a @p stage that begins hold no node of a body.
   * Bodies may come to them later. Collective. */
  template <int dim>
  std::vector<std::string>
  idle_conditions(const StageParameters &stage, const Model<dim> &model);

  /**
   * A motion without a value at the end of a step is found here, before
   * anything is computed or written; so are conditions that contradict each
   * other, and a surface without a level at a body. Collective.
   * @param stage that begins
   * @param first whether bodies are where they were drawn
   * @param model in its first step
   * @param notes what is told
   */
  template <int dim>
  void
  check_prescribed_motion(const StageParameters    &stage,
                          const bool                first,
                          Model<dim>               &model,
                          std::vector<std::string> &notes);

  /**
   * Only the change of a displacement acts. Refuse one that has a value at the
   * start of the scene, and tell of one that has when it begins to act later.
   * Collective.
   * @param scene its texts
   * @param stage that begins
   * @param before the stage before, of whose conditions nothing is asked; null
   * in the first
   * @param model where they act
   * @param notes what is told
   */
  template <int dim>
  void
  check_displacements_at_start(const Scene<dim>         &scene,
                               const StageParameters    &stage,
                               const StageParameters    *before,
                               const Model<dim>         &model,
                               std::vector<std::string> &notes);
} // namespace moraine

#endif
