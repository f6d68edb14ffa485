// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_stress_signs_h
#define moraine_run_stress_signs_h

#include <moraine/run/model.h>

#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * What stresses of points show of the cells that they come from. In each cell
   * of one body that is filled by 3/4 at least and has enough points, the mean
   * stress is fitted by a linear function of the unit cell, weighted by volume;
   * a jump is what the fits of two neighbours differ by in the middle of their
   * face, which for a smooth field is of the order of the square of the cell
   * size.
   */
  struct StressSigns
  {
    /** Root of the mean square over faces, weighted by the volume of their
     * cells [stress]; 0 if there is no such face. */
    double jump = 0;
    /** The same of what they differ by in the middle of their cells. */
    double step = 0;
    /** @f$|s| = \sqrt{s : s}@f$ of the deviatoric stress, root of the mean
     * square over the volume of all points [stress]. */
    double deviatoric = 0;
    /** Largest @f$|\sigma|@f$ of points in cells that are filled by less than
     * one half [stress]. */
    double in_cuts = 0;
    /** The same, of all other points. */
    double elsewhere = 0;
  };

  /** Of @p points in the cells in which they were found last. Collective. */
  template <int dim>
  StressSigns
  stress_signs(const GridSpace<dim> &space, const PointSet<dim> &points);

  /** estimated_stress_error() of all bodies; nothing where there is next to no
   * stress, or next to none of the energy is that of strain. Collective. */
  template <int dim>
  std::optional<double>
  stress_error(const Model<dim> &model);

  /** That nothing has acted; or that results look as if volume locked or cells
   * were crossed, as if they depended on where the mesh cuts the material, or
   * as if cells did not resolve them, and which keys help; nothing where there
   * is next to no stress. With inertia, of the first of these alone.
   * Collective.
   *
   * @param scene method and keys
   * @param model after the last step
   * @param error what stress_error() says of it
   */
  template <int dim>
  std::vector<std::string>
  doubts_of_stress(const Scene<dim>            &scene,
                   const Model<dim>            &model,
                   const std::optional<double> &error);
} // namespace moraine

#endif
