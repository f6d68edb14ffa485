// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_initial_stress_h
#define moraine_run_initial_stress_h

#include <moraine/run/model.h>

namespace moraine
{
  /**
   * Give the points of @p model, which has loads and no step behind it, the
   * initial stress of their bodies. Geostatic stress comes from what gravity
   * makes of the bodies above when the body appears.
   *
   * @throws InputError for geostatic stress without gravity or of bodies
   * without a shape, and for a stress that the material cannot have, with the
   * worst place. Collective.
   */
  template <int dim>
  void
  set_initial_stress(const Scene<dim> &scene, Model<dim> &model);

  /** Whether a body of stage @p k has an initial stress that those of the stage
   * before did not have. */
  template <int dim>
  bool
  begins_with_stress(const Scene<dim> &scene, const unsigned int k);
} // namespace moraine

#endif
