// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_scene_mesh_motion_h
#define moraine_scene_scene_mesh_motion_h

#include <moraine/boundary/grid_condition.h>
#include <moraine/boundary/implicit_boundary.h>
#include <moraine/boundary/mesh_motion.h>
#include <moraine/scene/scene.h>

#include <vector>

namespace moraine
{
  /** Section `Mesh motion`; none if it is empty. @throws InputError for names
   * that are not there. */
  template <int dim>
  MeshMotion<dim>
  make_mesh_motion(const Scene<dim>                         &scene,
                   const BackgroundMesh<dim>                &mesh,
                   const std::vector<ImplicitBoundary<dim>> &boundaries,
                   const std::vector<GridCondition<dim>>    &conditions);

  /**
   * That no side of the mesh leaves material behind that a grid condition holds
   * there: normal to the side, the mesh and the condition move alike.
   * @param motion of the mesh
   * @param t_0 the time at which the mesh is as it is given
   * @param time the steps to be looked at
   * @param mesh as it is before it moves
   * @param conditions that act in these steps
   * @throws InputError naming the condition.
   */
  template <int dim>
  void
  check_mesh_motion(const MeshMotion<dim>                 &motion,
                    const double                           t_0,
                    const TimeParameters                  &time,
                    const BackgroundMesh<dim>             &mesh,
                    const std::vector<GridCondition<dim>> &conditions);
} // namespace moraine

#endif
