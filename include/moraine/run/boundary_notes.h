// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_boundary_notes_h
#define moraine_run_boundary_notes_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Add to @p notes which boundaries of the first stage are only in part on a
   * body or begin inside one, and where the flux of Nitsche's method is not
   * that of the material. In a step that has begun. Collective.
   * @throws InputError for a boundary with its body behind it.
   */
  template <int dim>
  void
  tell_of_boundaries(const Scene<dim>         &scene,
                     const Model<dim>         &model,
                     std::vector<std::string> &notes);

  /**
   * Add to @p notes which boundaries begin in @p stage, not @p known from the
   * one before, inside a body: it has material on their outer side too, next to
   * the surface and deeper than a quarter of a cell. In a step that has begun.
   * Collective.
   */
  template <int dim>
  void
  tell_of_material_behind(const StageParameters          &stage,
                          const std::vector<std::string> &known,
                          const Model<dim>               &model,
                          std::vector<std::string>       &notes);

  /**
   * Add to @p notes which boundaries begin in @p stage, not in the one
   * @p before, away from the material: surfaces stand where they are drawn, and
   * ground may have settled. In a step that has begun. Collective.
   */
  template <int dim>
  void
  tell_of_gaps(const StageParameters    &stage,
               const StageParameters    &before,
               const Model<dim>         &model,
               std::vector<std::string> &notes);
} // namespace moraine

#endif
