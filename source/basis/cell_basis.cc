// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/basis.h>

#include <moraine/mesh/active_search.h>
#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/utilities.h>

#include <array>
#include <numeric>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  Basis<dim>::evaluate_parts(const unsigned int       batch,
                             const StencilBlock<dim> &block,
                             CellParts<dim>          &parts) const
  {
    AssertDimension(block.n_nodes, CellParts<dim>::n_corners);
    parts.cells = {points.cells()[batch].cell->active_cell_index()};
    parts.places.resize(block.n_nodes);
    std::iota(parts.places.begin(), parts.places.end(), 0u);
    parts.shares.assign(block.n_points, 1.);
    parts.gradients.assign(block.grad_N(0),
                           block.grad_N(0) + block.n_points * block.n_nodes);
  }



  template <int dim, int degree>
  bool
  CellBasis<dim, degree>::batch_points()
  {
    constexpr unsigned int n = CellShapes<dim, degree>::n_nodes;
    this->batch_points_by_cell([this](const auto &cell) {
      const unsigned int *nodes = this->space.cell_nodes(cell);
      this->batch_node_list.insert(this->batch_node_list.end(),
                                   nodes,
                                   nodes + n);
    });
    // The nodes of active cells couple anyway.
    return false;
  }



  template <int dim, int degree>
  void
  CellBasis<dim, degree>::evaluate(const unsigned int batch,
                                   StencilBlock<dim> &block) const
  {
    constexpr unsigned int n = CellShapes<dim, degree>::n_nodes;
    this->reinit(batch, block);
    Point<dim> X[n];
    for (unsigned int a = 0; a < n; ++a)
      X[a] = this->space.node_position(block.nodes[a]);
    for (unsigned int p = 0; p < block.n_points; ++p)
      CellShapes<dim, degree>::evaluate(this->points.reference_position(
                                          block.points[p]),
                                        X,
                                        &block.values[p * n],
                                        &block.gradients[p * n]);
  }



  template <int dim>
  PlaceFunctions<dim>
  Basis<dim>::functions_of_cells(
    const std::vector<typename CarriedPlaces<dim>::Place> &places) const
  {
    PlaceFunctions<dim> functions;
    for (unsigned int k = 0; k < places.size(); ++k)
      add_functions_of_cell(places[k], k, functions);
    return functions;
  }



  template <int dim>
  void
  Basis<dim>::add_functions_of_cell(
    const typename CarriedPlaces<dim>::Place &place,
    const unsigned int                        k,
    PlaceFunctions<dim>                      &functions) const
  {
    const unsigned int cell = place.active_cell_index;
    if (cell == GridSpace<dim>::no_cell)
      return;
    const auto [N, grad_N] = functions.add(k, cell, space.nodes_per_cell());
    evaluate_shapes(space, cell, place.x, N, grad_N);
  }



  template class Basis<2>;
  template class Basis<3>;
  template class CellBasis<2, 1>;
  template class CellBasis<2, 2>;
  template class CellBasis<3, 1>;
  template class CellBasis<3, 2>;
} // namespace moraine
