// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_moment_fitting_h
#define moraine_points_moment_fitting_h

#include <moraine/geometry/shape.h>

#include <deal.II/base/quadrature.h>

#include <vector>

namespace moraine
{
  /**
   * A quadrature rule for the region of the @p pieces that Shape::add_pieces()
   * gave: it integrates all polynomials of degree @p degree in each coordinate.
   * The points lie in @p shape, the weights (area or volume) are positive and
   * sum up to @p volume, and there are at most (degree + 1)^dim points.
   *
   * Of the points of simplex rules on the pieces, the least squares problem
   * with weights that are not negative (Lawson and Hanson 1974, algorithm NNLS)
   * chooses those that reproduce the moments of the region. Without points if
   * there are no such weights; more and smaller pieces offer more points to
   * choose from.
   */
  template <int dim>
  dealii::Quadrature<dim>
  moment_fitted_rule(const std::vector<SignedPiece<dim>> &pieces,
                     const Shape<dim>                    &shape,
                     const double                         volume,
                     const unsigned int                   degree);
} // namespace moraine

#endif
