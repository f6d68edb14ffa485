// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/basis.h>
#include <moraine/core/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    const BoxGrid<dim> &
    box_grid_or_throw(const GridSpace<dim> &space)
    {
      if (!space.mesh().box_grid() || space.degree() != 1)
        throw InputError("section 'Method', key 'Method': found 'GIMP' on a "
                         "mesh or with shape functions it cannot use, allowed: "
                         "a box of equal cells with degree 1");
      return *space.mesh().box_grid();
    }
  } // namespace



  template <int dim>
  GimpBasis<dim>::GimpBasis(const GridSpace<dim>    &space,
                            const PointSet<dim>     &points,
                            const unsigned int       points_per_direction,
                            const std::vector<bool> &is_seeded)
    : Basis<dim>(space, points)
    , grid(box_grid_or_throw(space))
    , points_per_direction(points_per_direction)
    , is_seeded(is_seeded)
    , half_length_offset(
        PointFields(points.fields()).request("half_length", dim, ""))
  {
    const auto &tria = space.mesh().triangulation();
    active_index_of_box_cell.resize(tria.n_active_cells());
    for (const auto &cell : tria.active_cell_iterators())
      {
        std::array<unsigned int, dim> ijk;
        const Point<dim>              center = cell->center();
        for (unsigned int d = 0; d < dim; ++d)
          ijk[d] = static_cast<unsigned int>(
            (center[d] - grid.lower_corner[d]) / grid.cell_size[d]);
        active_index_of_box_cell[cell_number(ijk)] = cell->active_cell_index();
      }
  }



  template <int dim>
  unsigned int
  GimpBasis<dim>::cell_number(const std::array<unsigned int, dim> &ijk) const
  {
    unsigned int number = 0;
    for (int d = dim - 1; d >= 0; --d)
      number = number * grid.n_cells[d] + ijk[d];
    return number;
  }



  template <int dim>
  void
  GimpBasis<dim>::initialise_points(PointSet<dim> &points) const
  {
    double sub_cell_volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      sub_cell_volume *= grid.cell_size[d] / points_per_direction;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        double      *half_length = points.values(p) + half_length_offset;
        const double scale =
          std::pow(points.volume(p) / sub_cell_volume, 1. / dim);
        const unsigned int body = points.body(p);
        for (unsigned int d = 0; d < dim; ++d)
          if (body < is_seeded.size() && is_seeded[body])
            {
              const double length = grid.cell_size[d] / points_per_direction;
              const double place =
                (points.position(p)[d] - grid.lower_corner[d]) / length;
              const double from_face = place - std::floor(place);
              half_length[d] = length * std::min(from_face, 1. - from_face);
            }
          else
            half_length[d] = 0.5 * grid.cell_size[d] *
                             std::min(1., scale / points_per_direction);
      }
  }



  template <int dim>
  typename GimpBasis<dim>::Window
  GimpBasis<dim>::window_of(const unsigned int point) const
  {
    // A cell touched with next to no overlap must not become active: its far
    // nodes would get no stiffness.
    static const double shrink =
      1 - std::sqrt(std::numeric_limits<double>::epsilon());
    const Point<dim> &x = this->points.position(point);
    const double     *l = this->points.values(point) + half_length_offset;
    Window            window;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double position =
          (x[d] - grid.lower_corner[d]) / grid.cell_size[d];
        const double half      = shrink * l[d] / grid.cell_size[d];
        const double last_cell = grid.n_cells[d] - 1;
        // Where the box reaches over the edge of the mesh it is cut there.
        window.first[d] =
          std::clamp(std::floor(position - half), 0., last_cell);
        window.last[d] = std::clamp(std::floor(position + half), 0., last_cell);
      }
    return window;
  }



  template <int dim>
  void
  GimpBasis<dim>::mark_cells(std::vector<unsigned char> &active) const
  {
    for (unsigned int p = 0; p < this->points.n_local(); ++p)
      {
        const Window window = window_of(p);
        auto         ijk    = window.first;
        for (;;)
          {
            active[active_index_of_box_cell[cell_number(ijk)]] = 1;
            unsigned int d                                     = 0;
            while (d < dim && ijk[d] == window.last[d])
              {
                ijk[d] = window.first[d];
                ++d;
              }
            if (d == dim)
              break;
            ++ijk[d];
          }
      }
  }



  template <int dim>
  void
  GimpBasis<dim>::append_nodes(const Window &window)
  {
    std::array<unsigned int, 3> n_nodes{{1, 1, 1}};
    for (unsigned int d = 0; d < dim; ++d)
      n_nodes[d] = window.last[d] - window.first[d] + 2;
    for (unsigned int k = 0; k < n_nodes[2]; ++k)
      for (unsigned int j = 0; j < n_nodes[1]; ++j)
        for (unsigned int i = 0; i < n_nodes[0]; ++i)
          {
            // Any cell of the window with that node will do.
            const std::array<unsigned int, 3> node{{i, j, k}};
            std::array<unsigned int, dim>     cell;
            unsigned int                      corner = 0;
            for (unsigned int d = 0; d < dim; ++d)
              {
                cell[d] = std::min(window.first[d] + node[d], window.last[d]);
                corner += (window.first[d] + node[d] - cell[d]) << d;
              }
            this->group_node_list.push_back(this->space.cell_nodes(
              active_index_of_box_cell[cell_number(cell)])[corner]);
          }
  }



  template <int dim>
  bool
  GimpBasis<dim>::group_points()
  {
    const std::vector<unsigned int> previous_nodes =
      std::move(this->group_node_list);
    this->groups.clear();
    this->group_node_list.clear();
    this->order.clear();
    windows.clear();

    std::vector<std::pair<Window, unsigned int>> in_cell;
    for (const auto &cell : this->points.cells())
      {
        in_cell.clear();
        for (unsigned int p = cell.first; p < cell.last; ++p)
          in_cell.emplace_back(window_of(p), p);
        std::sort(in_cell.begin(), in_cell.end());
        for (unsigned int k = 0; k < in_cell.size(); ++k)
          {
            if (k == 0 || in_cell[k - 1].first < in_cell[k].first)
              {
                const unsigned int first_node = this->group_node_list.size();
                append_nodes(in_cell[k].first);
                windows.push_back(in_cell[k].first);
                this->groups.push_back(
                  {static_cast<unsigned int>(this->order.size()),
                   0,
                   first_node,
                   static_cast<unsigned int>(this->group_node_list.size()) -
                     first_node});
              }
            this->order.push_back(in_cell[k].second);
            ++this->groups.back().n_points;
          }
      }
    return this->group_node_list != previous_nodes;
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
      const double lower  = std::max(x - l, first_node);
      const double upper  = std::min(x + l, first_node + n_cells * h);
      const double length = upper - lower;
      std::fill(S, S + n_cells + 1, 0.);
      std::fill(dS, dS + n_cells + 1, 0.);
      if (length < 1e-8 * h)
        {
          // A box as thin as that is a point; its average would be round-off.
          const double       xi = (x - first_node) / h;
          const unsigned int c  = std::clamp(std::floor(xi), 0., n_cells - 1.);
          S[c]                  = 1 - (xi - c);
          S[c + 1]              = xi - c;
          dS[c]                 = -1 / h;
          dS[c + 1]             = 1 / h;
          return;
        }
      for (unsigned int c = 0; c < n_cells; ++c)
        {
          const double a     = std::clamp((lower - first_node) / h - c, 0., 1.);
          const double b     = std::clamp((upper - first_node) / h - c, 0., 1.);
          const double right = 0.5 * (b * b - a * a) * h / length;
          S[c] += (b - a) * h / length - right;
          S[c + 1] += right;
          dS[c] -= (b - a) / length;
          dS[c + 1] += (b - a) / length;
        }
    }
  } // namespace



  template <int dim>
  void
  GimpBasis<dim>::evaluate(const unsigned int group,
                           StencilBlock<dim> &block) const
  {
    const auto   &g      = this->groups[group];
    const Window &window = windows[group];
    block.reinit(g.n_points,
                 &this->order[g.first_point],
                 g.n_nodes,
                 &this->group_node_list[g.first_node]);

    // l <= h/2, so a box overlaps at most two cells, rounding a third.
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



  template class GimpBasis<2>;
  template class GimpBasis<3>;
} // namespace moraine
