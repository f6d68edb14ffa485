// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_active_search_h
#define moraine_mesh_active_search_h

#include <moraine/mesh/grid_space.h>

#include <array>

namespace moraine
{
  /**
   * The active cell whose functions serve a place @p x that lies in @p cell:
   * the cell itself, or else the nearest active one around it that is not
   * further than @p search_tolerance, because the material that points close to
   * an edge stand for reaches over it. Returns end() if there is none. All
   * ranks get the same answer.
   */
  template <int dim>
  typename GridSpace<dim>::CellIterator
  nearest_active_cell(const GridSpace<dim>                        &space,
                      const typename GridSpace<dim>::CellIterator &cell,
                      const dealii::Point<dim>                    &x,
                      const double search_tolerance);

  /** How far @p x is from a cell of the mesh as it was built; 0 in it. */
  template <int dim>
  double
  distance_to_cell(const typename GridSpace<dim>::CellIterator &cell,
                   const dealii::Point<dim>                    &x);

  /** How far @p x is from a segment, or in 3D from a triangle. */
  template <int dim>
  double
  distance_to_simplex(const std::array<dealii::Point<dim>, dim> &simplex,
                      const dealii::Point<dim>                  &x);

  /** What lies beyond a face of a cell, by no more than @p thickness. */
  template <int dim>
  CellVertices<dim>
  layer_beyond(const unsigned int       face,
               const CellVertices<dim> &cell,
               const double             thickness);

  /**
   * Shape functions of an active cell this rank knows at the place @p x, also
   * outside of the cell. Arrays hold space.nodes_per_cell() entries, which are
   * not numbers where the cell has folded and @p x is nowhere in it.
   */
  template <int dim>
  void
  evaluate_shapes(const GridSpace<dim>     &space,
                  const unsigned int        active_cell_index,
                  const dealii::Point<dim> &x,
                  double                   *N,
                  dealii::Tensor<1, dim>   *grad_N);

  /**
   * Values @p N of shape functions of an active cell this rank knows, continued
   * to a place @p x that may be far from it. The map of a cell that is no
   * parallelogram folds outside of it: where @p x is beyond the fold or close
   * to it, functions go on linearly from the middle of the cell. They sum to 1
   * and reproduce linear functions everywhere.
   */
  template <int dim>
  void
  continue_shapes(const GridSpace<dim>     &space,
                  const unsigned int        active_cell_index,
                  const dealii::Point<dim> &x,
                  double                   *N);

  /** How far the nodes of an active cell this rank knows carried the place @p X
   * of the mesh as it was built, which may be outside of the cell; @p gradient
   * by X, unless null. */
  template <int dim>
  dealii::Tensor<1, dim>
  move_of_nodes_at(const GridSpace<dim>     &space,
                   const unsigned int        active_cell_index,
                   const dealii::Point<dim> &X,
                   dealii::Tensor<2, dim>   *gradient = nullptr);
} // namespace moraine

#endif
