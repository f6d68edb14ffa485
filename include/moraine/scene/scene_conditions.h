// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_scene_conditions_h
#define moraine_scene_scene_conditions_h

#include <moraine/boundary/absorbing_boundary.h>
#include <moraine/boundary/contact_boundary.h>
#include <moraine/boundary/grid_condition.h>
#include <moraine/boundary/implicit_boundary.h>
#include <moraine/load/load.h>
#include <moraine/load/water.h>
#include <moraine/scene/scene.h>

#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * What holds and what drives the bodies of a scene. All throw InputError for
   * keys that are missing or wrong.
   */
  template <int dim>
  std::vector<ImplicitBoundary<dim>>
  make_boundaries(const Scene<dim> &scene);

  /** Surfaces that the rims of bodies touch, which @p find_rim finds. */
  template <int dim>
  std::vector<ContactBoundary<dim>>
  make_contact_boundaries(
    const Scene<dim>                            &scene,
    const typename ContactBoundary<dim>::Finder &find_rim);

  /** Boundaries and grid conditions that absorb, in this order. They end where
   * bodies do that are there when they begin to: of all that have @p body_names
   * and @p shapes those of that stage. */
  template <int dim>
  std::vector<AbsorbingBoundary<dim>>
  make_absorbing_boundaries(const Scene<dim>               &scene,
                            const BackgroundMesh<dim>      &mesh,
                            const std::vector<std::string> &body_names,
                            const ShapesOfBodies<dim>      &shapes);

  template <int dim>
  std::vector<GridCondition<dim>>
  make_grid_conditions(const Scene<dim>          &scene,
                       const BackgroundMesh<dim> &mesh);

  /** Surfaces on which they act end where @p body does, the union of all; null
   * if nothing is known of one. Sides are loaded where @p covers says that a
   * body is. */
  template <int dim>
  Loads<dim>
  make_loads(const Scene<dim>               &scene,
             const BackgroundMesh<dim>      &mesh,
             const std::vector<std::string> &body_names,
             const ShapePointer<dim>        &body,
             const Covers<dim>              &covers);

  /** The water of a stage; none if it has none. */
  template <int dim>
  std::optional<Water<dim>>
  make_water(const Scene<dim> &scene, const StageParameters &stage);

  /** By body: what it weighs more below the phreatic line. */
  template <int dim>
  std::vector<double>
  extra_densities(const Scene<dim>               &scene,
                  const std::vector<std::string> &body_names);

  /** Velocities at the start, by body. */
  template <int dim>
  std::function<dealii::Tensor<1, dim>(const unsigned int        body,
                                       const dealii::Point<dim> &x)>
  initial_velocity(const Scene<dim>               &scene,
                   const std::vector<std::string> &body_names);
} // namespace moraine

#endif
