// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_scene_curves_h
#define moraine_scene_scene_curves_h

#include <moraine/scene/scene.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Times at which steps have to end beside the planned ones: rows at which the
   * table of something that acts changes its slope, and such that no step turns
   * a boundary by half a circle. In their order.
   */
  template <int dim>
  std::vector<double>
  asked_times(const Scene<dim> &scene);

  /** Loads whose 'Curve' is 0 as long as they act, and grid conditions whose
   * motion does not change as long as they act but is not 0. */
  template <int dim>
  std::vector<std::string>
  idle_curves(const Scene<dim> &scene);
} // namespace moraine

#endif
