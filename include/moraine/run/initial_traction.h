// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_initial_traction_h
#define moraine_run_initial_traction_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Let boundaries that begin in @p stage hold the material beside them as it
   * is stressed: their multiplier at first is @f$M \sigma n@f$, with the
   * stress of the points of each cell continued linearly to the surface; so
   * are the tractions of its slopes.
   * Without that a boundary that finds stress, initial or left by what held
   * there before, would take it over by a flux that is one of new strain. One
   * for which this leaves more out of balance than no traction at all, as
   * inside of a body, starts with none.
   *
   * To be called in a step that has begun, and begins it anew. Collective.
   * @param stage that begins
   * @param before boundaries that acted before
   * @param model what it acts on
   */
  template <int dim>
  void
  set_initial_tractions(const StageParameters          &stage,
                        const std::vector<std::string> &before,
                        Model<dim>                     &model);

  /**
   * Let boundaries that go on hold bodies that come in @p stage by the stress
   * of their own, in cells where no other body is: what they took over is the
   * traction of a neighbour. Begins the step anew where bodies come.
   * Collective.
   */
  template <int dim>
  void
  set_tractions_of_new_bodies(const StageParameters &stage,
                              const StageParameters &before,
                              Model<dim>            &model);
} // namespace moraine

#endif
