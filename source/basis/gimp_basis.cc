// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/gimp_basis.h>

#include <moraine/basis/domain_tools.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  GimpBasis<dim>::GimpBasis(const GridSpace<dim>              &space,
                            const PointSet<dim>               &points,
                            const CellSeeder<dim>             &seeder,
                            const std::vector<bool>           &is_seeded,
                            const DomainUpdate                 update,
                            const bool                         split,
                            const std::string                 &name,
                            const std::vector<Tensor<2, dim>> &half_edges)
    : Basis<dim>(space, points)
    , name(name)
    , neighbours((require_box_mesh(space, name), space.mesh()))
    , seeder(seeder)
    , is_seeded(is_seeded)
    , half_edges_of_body(half_edges)
    , update(DomainTools::finite_strain(points) ? update : DomainUpdate::frozen)
    , split(split)
    , half_length_field(points.fields().find(half_length_name))
    , initial_half_length_field(points.fields().find(initial_half_length_name))
    , half_length_offset(half_length_field.offset())
    , limits(split ? limits_of_bodies() : std::vector<double>())
    , local_functions(space, points)
  {}



  template <int dim>
  CellWindow<dim>
  GimpBasis<dim>::window_of(const unsigned int point) const
  {
    return cells_of_box(grid(),
                        this->points.position(point),
                        this->points.values(point) + half_length_offset);
  }



  template <int dim>
  void
  GimpBasis<dim>::mark_cells(std::vector<unsigned char> &active)
  {
    require_box_mesh(this->space, name);
    std::string failure;
    for (unsigned int p = 0; p < this->points.n_local(); ++p)
      {
        if (const unsigned int d = too_long_edge(p, 1); d < dim)
          {
            if (failure.empty())
              failure = DomainTools::name_of(this->points, p) +
                        ": the half length of its box along " + "xyz"[d] +
                        " is " +
                        std::to_string(
                          (this->points.values(p) + half_length_offset)[d] /
                          grid().cell_size[d]) +
                        " cell sizes, the limit of GIMP is 1; allowed: larger "
                        "cells, or 'Split domains = true'";
            continue;
          }
        window_of(p).for_each_cell(
          [&](const auto &ijk) { active[neighbours.box_cell(ijk)] = 1; });
      }
    DomainTools::throw_first(failure, this->space.communicator());
  }



  template <int dim>
  void
  GimpBasis<dim>::append_batch(const Window &window)
  {
    const unsigned int first_node = this->batch_node_list.size();
    append_nodes(window, neighbours, this->space, this->batch_node_list);
    Basis<dim>::append_batch(first_node);
  }



  template <int dim>
  bool
  GimpBasis<dim>::batch_points()
  {
    const std::vector<unsigned int> previous_nodes =
      std::move(this->batch_node_list);
    this->clear_batches();
    windows.clear();

    std::vector<std::pair<Window, unsigned int>> in_cell;
    std::vector<Window>                          of_batches;
    for (const auto &cell : this->points.cells())
      {
        in_cell.clear();
        for (unsigned int p = cell.first; p < cell.last; ++p)
          in_cell.emplace_back(window_of(p), p);
        this->batch_points_of_cell(in_cell,
                                   of_batches,
                                   [this](const Window &window) {
                                     append_batch(window);
                                   });
        windows.insert(windows.end(), of_batches.begin(), of_batches.end());
      }
    return this->batch_node_list != previous_nodes;
  }



  template <int dim>
  void
  GimpBasis<dim>::evaluate(const unsigned int batch,
                           StencilBlock<dim> &block) const
  {
    const BoxGrid<dim> &grid   = this->grid();
    const Window       &window = windows[batch];
    this->reinit(batch, block);
    std::array<double, dim> lower, per_h;
    LineFunctions           along; // l <= h: a box overlaps three cells at most
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d]   = grid.lower_corner[d] + window.first[d] * grid.cell_size[d];
        per_h[d]   = 1 / grid.cell_size[d];
        along.n[d] = window.last[d] - window.first[d] + 2;
      }
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const Point<dim> &x = this->points.position(block.points[p]);
        const double     *l =
          this->points.values(block.points[p]) + half_length_offset;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int n_cells = along.n[d] - 1;
            const LineOfBox    line((x[d] - lower[d]) * per_h[d],
                                 l[d] * per_h[d],
                                 n_cells);
            double            *S = along.values[d], *dS = along.slopes[d];
            std::fill(S, S + n_cells + 1, 0.);
            std::fill(dS, dS + n_cells + 1, 0.);
            for (unsigned int c = 0; c < n_cells; ++c)
              {
                const auto   local = line.hats(c);
                const double slope = (local[0] + local[1]) * per_h[d];
                S[c] += local[0];
                S[c + 1] += local[1];
                dS[c] -= slope;
                dS[c + 1] += slope;
              }
          }
        multiply(along,
                 &block.values[p * block.n_nodes],
                 &block.gradients[p * block.n_nodes]);
      }
  }



  template <int dim>
  void
  GimpBasis<dim>::evaluate_parts(const unsigned int       batch,
                                 const StencilBlock<dim> &block,
                                 CellParts<dim>          &parts) const
  {
    constexpr unsigned int n_corners = CellParts<dim>::n_corners;
    const Window          &window    = windows[batch];
    const unsigned int     n_cells   = window.n_cells();
    parts.cells.clear();
    parts.places.clear();
    parts.shares.resize(block.n_points * n_cells);
    parts.gradients.resize(block.n_points * n_cells * n_corners);
    window.for_each_cell([&](const auto &ijk) {
      const unsigned int c = parts.cells.size();
      parts.cells.push_back(neighbours.box_cell(ijk));
      for (unsigned int a = 0; a < n_corners; ++a)
        {
          unsigned int place = 0, stride = 1;
          for (unsigned int d = 0; d < dim; ++d)
            {
              place += stride * (ijk[d] - window.first[d] + ((a >> d) & 1));
              stride *= window.last[d] - window.first[d] + 2;
            }
          parts.places.push_back(place);
        }
      for (unsigned int p = 0; p < block.n_points; ++p)
        {
          const auto S     = local_functions.values(ijk, block.points[p]);
          double    &share = parts.shares[p * n_cells + c];
          share            = 1;
          for (unsigned int d = 0; d < dim; ++d)
            share *= S[d][0] + S[d][1];
          for (unsigned int a = 0; a < n_corners; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              {
                double slope = ((a >> i) & 1 ? 1 : -1) * (S[i][0] + S[i][1]) /
                               grid().cell_size[i];
                for (unsigned int d = 0; d < dim; ++d)
                  if (d != i)
                    slope *= S[d][(a >> d) & 1];
                parts.gradients[(p * n_cells + c) * n_corners + a][i] = slope;
              }
        }
    });
    // Cells touched with next to no overlap are not among those of a window.
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        double sum = 0;
        for (unsigned int c = p * n_cells; c < (p + 1) * n_cells; ++c)
          sum += parts.shares[c];
        for (unsigned int c = p * n_cells; c < (p + 1) * n_cells; ++c)
          parts.shares[c] /= sum;
      }
  }



  template class GimpBasis<2>;
  template class GimpBasis<3>;
} // namespace moraine
