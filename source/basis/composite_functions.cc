// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/composite_functions.h>

#include <mpi.h>

#include <numeric>

namespace moraine
{
  using namespace dealii;

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
    patches.clear();
    this->batch_points_by_cell([&](const auto &cell) {
      patches.push_back(patch_of(place_in(*mesh.box_grid(), cell->center())));
      append_nodes(patches.back().window,
                   neighbours,
                   this->space,
                   this->batch_node_list);
    });
    // They recover strains and couple no unknowns.
    return false;
  }



  template <int dim>
  void
  CompositeBasis<dim>::evaluate(const unsigned int batch,
                                StencilBlock<dim> &block) const
  {
    const BoxGrid<dim> &grid  = *this->space.mesh().box_grid();
    const Patch        &patch = patches[batch];
    this->reinit(batch, block);
    LineFunctions along;
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const Point<dim> &x = this->points.position(block.points[p]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double h = grid.cell_size[d];
            const double xi =
              2 * ((x[d] - grid.lower_corner[d]) / h - patch.cell[d]) - 1;
            const bool below =
              patch.window
                .first[d]<patch.cell[d], above = patch.window.last[d]>
                  patch.cell[d];
            along.n[d] = composite_functions(
              xi, below, above, along.values[d], along.slopes[d]);
            for (unsigned int a = 0; a < along.n[d]; ++a)
              along.slopes[d][a] *= 2 / h;
          }
        multiply(along,
                 &block.values[p * block.n_nodes],
                 &block.gradients[p * block.n_nodes]);
      }
  }



  template class CompositeBasis<2>;
  template class CompositeBasis<3>;
} // namespace moraine
