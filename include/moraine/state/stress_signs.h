// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_stress_signs_h
#define moraine_state_stress_signs_h

#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

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
} // namespace moraine

#endif
