// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_smoothed_stress_h
#define moraine_output_smoothed_stress_h

#include <moraine/points/point_set.h>

#include <array>
#include <optional>
#include <vector>

namespace moraine
{
  /**
   * The stress @f$\sigma_p@f$ of points, smoothed over the vertices of their
   * cells. At vertex a it is the mean
   *
   * @f[ \bar\sigma_a = \frac{\sum_p N_a(x_p)\, v_p\, \sigma_p}
   *                         {\sum_p N_a(x_p)\, v_p} @f]
   *
   * with the linear functions @f$N_a@f$ of cells, also where unknowns have
   * quadratic ones: never more or less than it is at a point around. What
   * alternates from point to point or cell to cell, as the mean stress of
   * elements with a mean change of volume does, goes; what is linear stays but
   * in cells at the rim of a body, where the means are those of one side.
   */
  template <int dim>
  class SmoothedStress
  {
  public:
    using Stress = std::array<double, n_stress_components<dim>>;

    /** Of all bodies together, at the vertices; @p effective: of
     * effective_stress(). Collective. */
    explicit SmoothedStress(const PointSet<dim> &points,
                            const bool           effective = false);

    /** None where no cell around @p vertex, an index of the mesh, has points.
     */
    std::optional<Stress>
    at_vertex(const unsigned int vertex) const;

  private:
    std::vector<double> means; ///< for each vertex the stress and the volume
  };



  /**
   * The mean stress @f$(\sigma_{xx}+\sigma_{yy}+\sigma_{zz})/3@f$ of each body
   * by itself, smoothed as in SmoothedStress and interpolated to its points
   * again, one number for each point of this rank. Collective.
   */
  template <int dim>
  std::vector<double>
  smoothed_mean_stress(const PointSet<dim> &points);
} // namespace moraine

#endif
