// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_removed_bodies_h
#define moraine_run_removed_bodies_h

#include <moraine/core/finding.h>
#include <moraine/run/model.h>

#include <optional>

namespace moraine
{
  /**
   * Remove the places of absorbing boundaries that lie on bodies which @p stage
   * does not have, before they go. Collective.
   * @return what was lost, if anything
   */
  template <int dim>
  std::optional<Finding>
  remove_absorbing_places(const StageParameters &stage, Model<dim> &model);
} // namespace moraine

#endif
