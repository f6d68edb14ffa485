// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_fitted_weights_h
#define moraine_state_fitted_weights_h

#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

#include <vector>

namespace moraine
{
  /**
   * Factors @f$f_p@f$ on the volumes of points with which those of a filled
   * cell @f$K@f$ integrate what is linear in its reference coordinates exactly,
   * wherever in the cell they have moved:
   * @f[ \sum_p f_p v_p = |K|, \qquad \sum_p f_p v_p\,\xi_p = \int_K \xi\,dV,
   *     \qquad
   *     f_p = \frac{|K|}{V}\left(1 + \theta\, g \cdot (\xi_p - \bar\xi)\right),
   *     \quad V = \sum_p v_p . @f]
   * @f$\theta = 1@f$, or less where a factor would be below a tenth of the mean
   * (no weight is negative); 0 where points stand in a row and no @f$g@f$
   * exists. Without the factors a row of points that moves by less than half
   * its spacing brings its volume to a cell that it covers in part only, an
   * error that does not depend on the size of cells.
   *
   * A cell is filled if all cells around it have points, its points belong to
   * one body and fill at least half of it; at the edge of the mesh, where a
   * surface may run through it unseen, also only if it was full at the start.
   * Points of other cells have the factor 1. Al-Kafaji (2013) takes one Gauss
   * point with the mean stress in filled cells; here points keep their stress.
   */
  template <int dim>
  class FittedWeights
  {
  public:
    /** With the points of the start. */
    explicit FittedWeights(const PointSet<dim> &points);

    /** One factor for each local point. */
    std::vector<double>
    factors(const GridSpace<dim> &space, const PointSet<dim> &points) const;

  private:
    std::vector<bool> full_at_start; ///< by active_cell_index()
  };
} // namespace moraine

#endif
