// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_stress_error_h
#define moraine_state_stress_error_h

#include <moraine/material/material.h>
#include <moraine/points/point_set.h>

#include <optional>
#include <vector>

namespace moraine
{
  /**
   * How far the stresses of the points are from a smoother field, over the
   * stresses, in the norm of elastic energy:
   *
   * @f[ \eta = \sqrt{\frac{\sum_p v_p\,
   *   (\sigma_p-\sigma^*(x_p)) : C^{-1} : (\sigma_p-\sigma^*(x_p))}
   *   {\sum_p v_p\, \sigma_p : C^{-1} : \sigma_p}} @f]
   *
   * Around each vertex the linear function nearest to the stresses of the
   * points in its cells is found, in the mean square by volume, each body by
   * itself;
   * @f$\sigma^*@f$ at a point is the mean of those of the vertices of its cell,
   * weighted by their linear functions and by the cube of the volume around
   * them, so that at a rim the functions from inside count. It is the estimate
   * of Zienkiewicz and Zhu, Int. J. Numer. Meth. Engng 33 (1992), 1331-1364,
   * with points in place of superconvergent places.
   *
   * Of an elastic body under given forces @f$\eta^2@f$ estimates the share of
   * the deflection that the mesh holds back. Where material flows it is a
   * measure of what cells resolve, no more. Stress of the start counts with the
   * rest.
   *
   * @param points in the cells in which they were found last
   * @param moduli of the material of each body
   * @return nothing where there is next to no stress. Collective.
   */
  template <int dim>
  std::optional<double>
  estimated_stress_error(const PointSet<dim>              &points,
                         const std::vector<LameConstants> &moduli);
} // namespace moraine

#endif
