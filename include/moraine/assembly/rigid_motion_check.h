// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_rigid_motion_check_h
#define moraine_assembly_rigid_motion_check_h

#include <moraine/assembly/constraint_table.h>
#include <moraine/assembly/step_context.h>
#include <moraine/core/linear_algebra.h>

#include <string>
#include <vector>

namespace moraine
{
  /** Translations and rotations of the nodes, where they are now. */
  template <int dim>
  std::vector<LA::Vector>
  rigid_modes_of(const GridSpace<dim> &space);

  /**
   * Throws if a connected part of the material can move as a rigid body against
   * @p tangent, naming it and the motion: InputError in the first step,
   * ComputationError later. Collective.
   */
  template <int dim>
  void
  check_rigid_motion(const StepContext<dim>         &context,
                     const LA::SparseMatrix         &tangent,
                     const ConstraintTable          &constraints,
                     const std::vector<LA::Vector>  &rigid_modes,
                     const std::vector<std::string> &body_names,
                     const bool                      first_step);
} // namespace moraine

#endif
