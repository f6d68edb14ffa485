// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_surface_motion_h
#define moraine_scene_surface_motion_h

#include <moraine/geometry/placement.h>
#include <moraine/load/load.h>
#include <moraine/scene/scene.h>

#include <string>

namespace moraine
{
  /** A vector function from text; zero if the text is empty.
   * @throws InputError naming @p place for what is none. */
  template <int dim>
  VectorFunction<dim>
  vector_function(const std::string &text, const std::string &place);

  /** When the boundary @p name begins to act. */
  template <int dim>
  double
  first_time_of(const std::string &name, const Scene<dim> &scene);

  /** Whether what the boundary prescribes is not the same everywhere. */
  template <int dim>
  bool
  varies(const BoundaryParameters<dim> &parameters);

  /**
   * The rigid motion of the boundary @p name: its motion and a uniform
   * 'Displacement'.
   * @throws InputError for a displacement by which it would not be rigid.
   */
  template <int dim>
  RigidMotion<dim>
  motion_of_surface(const std::string             &name,
                    const BoundaryParameters<dim> &parameters,
                    const Scene<dim>              &scene);
} // namespace moraine

#endif
