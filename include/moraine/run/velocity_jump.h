// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_velocity_jump_h
#define moraine_run_velocity_jump_h

#include <moraine/core/finding.h>
#include <moraine/run/model.h>

#include <optional>

namespace moraine
{
  /**
   * A sentence if what holds a body begins to move at another velocity than the
   * body has, else empty: the velocity of the body then jumps. Compares with
   * the derivative of the prescribed motion at the start of @p stage, in a step
   * that has begun and has a target after it. Collective.
   * @throws InputError if a body has an 'Initial velocity' where a condition
   * holds it at rest; in the @p first motion of a scene alone.
   */
  template <int dim>
  std::optional<Finding>
  velocity_jump(const StageParameters &stage,
                const bool             first,
                Model<dim>            &model);

  /** Aim at the end of the first step of a stage: nodes that are held get
   * the velocity and the acceleration that conditions prescribe. */
  template <int dim>
  void
  set_first_target(const TimeParameters &time, Model<dim> &model);
} // namespace moraine

#endif
