// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_condition_results_h
#define moraine_run_condition_results_h

#include <moraine/output/vtu_file.h>
#include <moraine/run/model.h>
#include <moraine/scene/scene.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** Names and translations [length], functions of t. */
  template <int dim>
  using NamedTranslations =
    std::vector<std::pair<std::string,
                          std::function<dealii::Tensor<1, dim>(const double)>>>;

  /**
   * How far boundaries and grid conditions have moved since they began to act:
   * `Translation` and, where it is the same everywhere, `Displacement`. Those
   * that do not move, or move differently from place to place, are left out.
   */
  template <int dim>
  NamedTranslations<dim>
  translations_of_conditions(const Scene<dim> &scene, const Model<dim> &model);

  /**
   * Write the pieces of the boundaries named @p acting, as points at the end of
   * the step with their normal, their `size` (length or area) and the number of
   * their `boundary`. Collective.
   * @throws InputError naming the file if it cannot be written.
   */
  template <int dim>
  void
  write_boundary_vtu(const Model<dim>               &model,
                     const std::vector<std::string> &acting,
                     const VtuTarget                &target);

  /**
   * Write the places of rims that carry contact: traction on the body, normal
   * of the rim, gap, slip so far, size, `status` (0 open, 1 stick, 2 slip) and
   * number of the surface. Collective.
   * @throws InputError naming the file if it cannot be written.
   */
  template <int dim>
  void
  write_contact_vtu(const Model<dim> &model, const VtuTarget &target);

  /**
   * Write places of the phreatic line (`kind` 0) and, if it is given, of the
   * level of free water (1), from one side of the mesh to the other. Where the
   * pressure is given, the line is the highest place without it. Collective.
   * @throws InputError naming the file if it cannot be written.
   */
  template <int dim>
  void
  write_water_vtu(const Model<dim> &model, const VtuTarget &target);
} // namespace moraine

#endif
