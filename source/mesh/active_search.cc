// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/active_search.h>
#include <moraine/mesh/cell_shapes.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    distance_to(const BoundingBox<dim> &box, const Point<dim> &x)
    {
      Tensor<1, dim> gap;
      for (unsigned int d = 0; d < dim; ++d)
        gap[d] =
          std::max({box.lower_bound(d) - x[d], x[d] - box.upper_bound(d), 0.});
      return gap.norm();
    }



    template <int dim, int degree>
    void
    evaluate_at(const GridSpace<dim> &space,
                const unsigned int    cell,
                const Point<dim>     &x,
                double               *N,
                Tensor<1, dim>       *grad_N)
    {
      constexpr unsigned int n     = CellShapes<dim, degree>::n_nodes;
      const unsigned int    *nodes = space.cell_nodes(cell);
      Point<dim>             X[n];
      for (unsigned int a = 0; a < n; ++a)
        X[a] = space.node_position(nodes[a]);
      CellShapes<dim, degree>::evaluate(CellShapes<dim, degree>::inverse(x, X),
                                        X,
                                        N,
                                        grad_N);
    }
  } // namespace



  template <int dim>
  typename GridSpace<dim>::CellIterator
  nearest_active_cell(const GridSpace<dim>                        &space,
                      const typename GridSpace<dim>::CellIterator &cell,
                      const Point<dim>                            &x,
                      const double                                 reach)
  {
    if (space.is_active(cell))
      return cell;

    const auto &cells_at_vertex =
      space.mesh().search_cache().get_vertex_to_cell_map();
    typename GridSpace<dim>::CellIterator owner =
      space.mesh().triangulation().end();
    double nearest = reach;
    for (const unsigned int v : cell->vertex_indices())
      for (const auto &neighbour : cells_at_vertex[cell->vertex_index(v)])
        if (space.is_active(neighbour))
          {
            const double distance = distance_to(neighbour->bounding_box(), x);
            if (distance < nearest - 1e-9 * reach)
              {
                nearest = distance;
                owner   = neighbour;
              }
          }
    return owner;
  }



  template <int dim>
  void
  evaluate_shapes(const GridSpace<dim> &space,
                  const unsigned int    active_cell_index,
                  const Point<dim>     &x,
                  double               *N,
                  Tensor<1, dim>       *grad_N)
  {
    if (space.degree() == 1)
      evaluate_at<dim, 1>(space, active_cell_index, x, N, grad_N);
    else
      evaluate_at<dim, 2>(space, active_cell_index, x, N, grad_N);
  }



#define INSTANTIATE(dim)                                     \
  template GridSpace<dim>::CellIterator nearest_active_cell( \
    const GridSpace<dim> &,                                  \
    const GridSpace<dim>::CellIterator &,                    \
    const Point<dim> &,                                      \
    const double);                                           \
  template void evaluate_shapes(const GridSpace<dim> &,      \
                                const unsigned int,          \
                                const Point<dim> &,          \
                                double *,                    \
                                Tensor<1, dim> *);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
