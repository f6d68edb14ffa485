// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_scene_bodies_h
#define moraine_scene_scene_bodies_h

#include <moraine/geometry/shape_library.h>
#include <moraine/material/material.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/points/bodies.h>
#include <moraine/scene/scene.h>

#include <memory>
#include <vector>

namespace moraine
{
  /**
   * The shapes of all bodies, operands too, by name; null for those whose
   * points are given. @throws InputError for shapes that are wrong.
   */
  template <int dim>
  NamedShapes<dim>
  body_shapes(const Scene<dim> &scene);

  /** Bodies that others are combined from; they are not simulated themselves.
   */
  template <int dim>
  std::set<std::string>
  operands_of(const Scene<dim> &scene);

  /** The names of the others, in their order. */
  template <int dim>
  std::vector<std::string>
  simulated_bodies(const Scene<dim> &scene);

  /**
   * The bodies of a scene in its order, but for those that others are made
   * from: a body that is an operand is a tool without material of its own.
   * @throws InputError for shapes and point files that are wrong.
   */
  template <int dim>
  std::vector<Body<dim>>
  make_bodies(const Scene<dim> &scene);

  /**
   * Groups of cells must not become one body unsaid.
   * @throws InputError for a body of shape 'mesh' that names no group though
   * there are several.
   */
  template <int dim>
  void
  check_groups(const Scene<dim> &scene, const BackgroundMesh<dim> &mesh);

  /** The material of each body. @throws InputError for impossible values. */
  template <int dim>
  std::vector<std::shared_ptr<const Material>>
  make_materials(const Scene<dim>             &scene,
                 const std::vector<Body<dim>> &bodies,
                 const BackgroundMesh<dim>    &mesh);

  /** Of which part that is filled on the nodes of a cell are free, for each
   * body: its own or that of the method. */
  template <int dim>
  std::vector<double>
  fill_of_bodies(const Scene<dim> &scene, const std::vector<Body<dim>> &bodies);

  /** The damping of each body. */
  template <int dim>
  std::vector<RayleighFactors>
  make_damping(const Scene<dim> &scene, const std::vector<Body<dim>> &bodies);
} // namespace moraine

#endif
