// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_grid_evaluation_h
#define moraine_output_grid_evaluation_h

#include <moraine/mesh/grid_space.h>

#include <functional>
#include <vector>

namespace moraine
{
  /**
   * Gives a vector at a place; returns false where there is none. Collective,
   * with the same result on every rank.
   */
  template <int dim>
  using PlaceFunction =
    std::function<bool(const dealii::Point<dim> &, dealii::Tensor<1, dim> &)>;

  /**
   * The finite element field @f$\sum_a N_a(x) v_a@f$ with the nodal values
   * @p values, as a function of the place in the mesh as it was built (not as
   * GridSpace::move_nodes() moved it). It is false outside the active cells.
   * Both arguments must outlive the result.
   */
  template <int dim>
  PlaceFunction<dim>
  grid_evaluation(const GridSpace<dim>                      &space,
                  const std::vector<dealii::Tensor<1, dim>> &values);
} // namespace moraine

#endif
