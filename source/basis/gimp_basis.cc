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
    this->batches.push_back(
      {0,
       0,
       first_node,
       static_cast<unsigned int>(this->batch_node_list.size()) - first_node});
  }



  template <int dim>
  bool
  GimpBasis<dim>::batch_points()
  {
    const std::vector<unsigned int> previous_nodes =
      std::move(this->batch_node_list);
    this->batches.clear();
    this->batch_node_list.clear();
    this->order.clear();
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



  namespace
  {
    /**
     * Averages of the 1D hat functions of consecutive cells over
     * [x - l, x + l], and the averages of their derivatives. A box that
     * reaches over the last cell is cut there.
     *
     * @param first_node coordinate of the first node, @param n_cells number of
     * cells of size @p h behind it.
     */
    void
    average_hats(const double       x,
                 const double       l,
                 const double       first_node,
                 const double       h,
                 const unsigned int n_cells,
                 double            *S,
                 double            *dS)
    {
      const double per_h  = 1 / h;
      const double xi     = (x - first_node) * per_h;
      const double half   = l * per_h;
      const double lower  = std::max(xi - half, 0.);
      const double upper  = std::min<double>(xi + half, n_cells);
      const double length = upper - lower;
      std::fill(S, S + n_cells + 1, 0.);
      std::fill(dS, dS + n_cells + 1, 0.);
      if (length < thin_box)
        {
          const unsigned int c = std::clamp(std::floor(xi), 0., n_cells - 1.);
          S[c]                 = 1 - (xi - c);
          S[c + 1]             = xi - c;
          dS[c]                = -per_h;
          dS[c + 1]            = per_h;
          return;
        }
      const double per_length = 1 / length;
      for (unsigned int c = 0; c < n_cells; ++c)
        {
          const auto   local = local_hats(lower - c, upper - c, per_length);
          const double slope = (local[0] + local[1]) * per_h;
          S[c] += local[0];
          S[c + 1] += local[1];
          dS[c] -= slope;
          dS[c + 1] += slope;
        }
    }
  } // namespace



  template <int dim>
  void
  GimpBasis<dim>::evaluate(const unsigned int batch,
                           StencilBlock<dim> &block) const
  {
    const BoxGrid<dim> &grid   = this->grid();
    const auto         &g      = this->batches[batch];
    const Window       &window = windows[batch];
    block.reinit(g.n_points,
                 &this->order[g.first_point],
                 g.n_nodes,
                 &this->batch_node_list[g.first_node]);

    // l <= h, so a box overlaps at most three cells.
    constexpr unsigned int max_nodes = 4;
    double                 S[3][max_nodes], dS[3][max_nodes];
    S[2][0] = 1;
    std::array<unsigned int, 3> n{{1, 1, 1}};
    for (unsigned int d = 0; d < dim; ++d)
      n[d] = window.last[d] - window.first[d] + 2;
    for (unsigned int p = 0; p < g.n_points; ++p)
      {
        const Point<dim> &x = this->points.position(block.points[p]);
        const double     *l =
          this->points.values(block.points[p]) + half_length_offset;
        for (unsigned int d = 0; d < dim; ++d)
          average_hats(x[d],
                       l[d],
                       grid.lower_corner[d] +
                         window.first[d] * grid.cell_size[d],
                       grid.cell_size[d],
                       n[d] - 1,
                       S[d],
                       dS[d]);
        unsigned int a = p * g.n_nodes;
        for (unsigned int k = 0; k < n[2]; ++k)
          for (unsigned int j = 0; j < n[1]; ++j)
            for (unsigned int i = 0; i < n[0]; ++i, ++a)
              {
                block.values[a]       = S[0][i] * S[1][j] * S[2][k];
                block.gradients[a][0] = dS[0][i] * S[1][j] * S[2][k];
                block.gradients[a][1] = S[0][i] * dS[1][j] * S[2][k];
                if constexpr (dim == 3)
                  block.gradients[a][2] = S[0][i] * S[1][j] * dS[2][k];
              }
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
