// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_near_bodies_h
#define moraine_run_near_bodies_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /** For each body, 1 in the first component at the nodes that its points
   * touch, on any rank. In a step that has begun. Collective. */
  template <int dim>
  std::vector<std::vector<dealii::Tensor<1, dim>>>
  touched_nodes(const Model<dim> &model);

  /**
   * Add to @p notes which bodies are drawn apart and stick together all the
   * same, as they touch the same nodes: across a gap of up to two cells, or
   * more with boxes. Only pairs of which not both are @p known from a stage
   * before. In a step that has begun. Collective.
   */
  template <int dim>
  void
  tell_of_near_bodies(const Model<dim>               &model,
                      const std::vector<std::string> &known,
                      std::vector<std::string>       &notes);
} // namespace moraine

#endif
