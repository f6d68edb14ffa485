// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/composite_functions.h>

#include <mpi.h>

#include <numeric>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  CompositeBasis<dim>::CompositeBasis(const GridSpace<dim> &space,
                                      const PointSet<dim>  &points)
    : Basis<dim>(space, points)
    , neighbours(space.mesh())
  {}



  template <int dim>
  typename CompositeBasis<dim>::Patch
  CompositeBasis<dim>::patch_of(const std::array<unsigned int, dim> &cell) const
  {
    const auto &n_cells  = this->space.mesh().box_grid()->n_cells;
    const auto  is_there = [&](const auto &ijk) {
      return holds_points[neighbours.box_cell(ijk)] != 0;
    };
    CellWindow<dim> window{cell, cell};
    for (unsigned int d = 0; d < dim; ++d)
      {
        auto ijk = cell;
        if (cell[d] > 0)
          {
            --ijk[d];
            window.first[d] -= is_there(ijk);
            ++ijk[d];
          }
        if (cell[d] + 1 < n_cells[d])
          {
            ++ijk[d];
            window.last[d] += is_there(ijk);
          }
      }
    CellWindow<dim> filled = window;
    window.for_each_cell([&](const auto &ijk) {
      if (is_there(ijk))
        return;
      for (unsigned int d = 0; d < dim; ++d)
        {
          if (ijk[d] < cell[d])
            filled.first[d] = cell[d];
          if (ijk[d] > cell[d])
            filled.last[d] = cell[d];
        }
    });
    return {cell, filled};
  }



  template <int dim>
  bool
  CompositeBasis<dim>::batch_points()
  {
    // With boxes GimpBasis has looked before.
    require_box_mesh(this->space, "DM-C");
    const BackgroundMesh<dim> &mesh = this->space.mesh();
    holds_points.assign(mesh.triangulation().n_active_cells(), 0);
    for (const auto &in_cell : this->points.cells())
      holds_points[in_cell.cell->active_cell_index()] = 1;
    MPI_Allreduce(MPI_IN_PLACE,
                  holds_points.data(),
                  holds_points.size(),
                  MPI_UNSIGNED_CHAR,
                  MPI_MAX,
                  this->space.communicator());
    this->batches.clear();
    this->batch_node_list.clear();
    patches.clear();
    this->order.resize(this->points.n_local());
    std::iota(this->order.begin(), this->order.end(), 0u);
    for (const auto &in_cell : this->points.cells())
      {
        patches.push_back(
          patch_of(place_in(*mesh.box_grid(), in_cell.cell->center())));
        const unsigned int first_node = this->batch_node_list.size();
        append_nodes(patches.back().window,
                     neighbours,
                     this->space,
                     this->batch_node_list);
        this->batches.push_back(
          {in_cell.first,
           in_cell.last - in_cell.first,
           first_node,
           static_cast<unsigned int>(this->batch_node_list.size()) -
             first_node});
      }
    // They recover strains and couple no unknowns.
    return false;
  }



  template <int dim>
  void
  CompositeBasis<dim>::evaluate(const unsigned int batch,
                                StencilBlock<dim> &block) const
  {
    const BoxGrid<dim> &grid  = *this->space.mesh().box_grid();
    const auto         &g     = this->batches[batch];
    const Patch        &patch = patches[batch];
    block.reinit(g.n_points,
                 &this->order[g.first_point],
                 g.n_nodes,
                 &this->batch_node_list[g.first_node]);
    constexpr unsigned int max_nodes = 4;
    double                 N[3][max_nodes], dN[3][max_nodes];
    N[2][0] = 1;
    std::array<unsigned int, 3> n{{1, 1, 1}};
    for (unsigned int p = 0; p < g.n_points; ++p)
      {
        const Point<dim> &x = this->points.position(block.points[p]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double h = grid.cell_size[d];
            const double xi =
              2 * ((x[d] - grid.lower_corner[d]) / h - patch.cell[d]) - 1;
            n[d] = composite_functions(
              xi,
              patch.window.first[d]<patch.cell[d], patch.window.last[d]> patch
                .cell[d],
              N[d],
              dN[d]);
            for (unsigned int a = 0; a < n[d]; ++a)
              dN[d][a] *= 2 / h;
          }
        unsigned int a = p * g.n_nodes;
        for (unsigned int k = 0; k < n[2]; ++k)
          for (unsigned int j = 0; j < n[1]; ++j)
            for (unsigned int i = 0; i < n[0]; ++i, ++a)
              {
                block.values[a]       = N[0][i] * N[1][j] * N[2][k];
                block.gradients[a][0] = dN[0][i] * N[1][j] * N[2][k];
                block.gradients[a][1] = N[0][i] * dN[1][j] * N[2][k];
                if constexpr (dim == 3)
                  block.gradients[a][2] = N[0][i] * N[1][j] * dN[2][k];
              }
      }
  }



  template class CompositeBasis<2>;
  template class CompositeBasis<3>;
} // namespace moraine
