// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Which parts of domains lie in which cells.

#include <moraine/basis/cpdi_basis.h>

#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Intervals of (0, 1) along an axis of a domain. */
    struct Intervals
    {
      std::array<double, 4> middle;
      std::array<double, 4> length;
      unsigned int          n;
    };



    /** @p n equal ones; if @p cut is inside, half of them on each side of it.
     */
    Intervals
    intervals(const unsigned int n, const double cut = 0)
    {
      Intervals result;
      result.n = n;
      for (unsigned int i = 0; i < n; ++i)
        {
          const bool   is_cut = cut > 0 && cut < 1;
          const bool   above  = is_cut && 2 * i >= n;
          const double begin  = above ? cut : 0.;
          const double length = is_cut ? (above ? 1 - cut : cut) : 1.;
          const double m      = is_cut ? n / 2. : n;
          const double k      = above ? i - n / 2. : i;
          result.middle[i]    = begin + (k + 0.5) / m * length;
          result.length[i]    = length / m;
        }
      return result;
    }



    /** Where the middle line of a domain along its axis @p d crosses a face of
     * the cells of a @p box, or 0 if none that it runs across. */
    template <int dim>
    double
    crossing(const BoxGrid<dim>                       &box,
             const std::array<Point<dim>, (1 << dim)> &corners,
             const unsigned int                        d)
    {
      Tensor<1, dim> from, to;
      for (unsigned int c = 0; c < corners.size(); ++c)
        ((c >> d) & 1 ? to : from) += 2. / corners.size() * corners[c];
      unsigned int along = 0;
      for (unsigned int e = 1; e < dim; ++e)
        if (std::abs(to[e] - from[e]) > std::abs(to[along] - from[along]))
          along = e;
      const auto in_cells = [&](const Tensor<1, dim> &x) {
        return (x[along] - box.lower_corner[along]) / box.cell_size[along];
      };
      const double a = in_cells(from), b = in_cells(to);
      const double face = std::floor(std::max(a, b));
      return std::min(a, b) < face ? (face - a) / (b - a) : 0.;
    }
  } // namespace



  template <int dim>
  void
  CpdiBasis<dim>::evaluate_parts(const unsigned int       batch,
                                 const StencilBlock<dim> &block,
                                 CellParts<dim>          &parts) const
  {
    begin_parts(batch, parts);
    CellPatch<dim> patch(neighbours);
    patch.reinit(neighbours.cell(cell_of_batch[batch]));
    for (unsigned int i = 0; i < block.n_points; ++i)
      add_parts_of(block.points[i], i, patch, parts);
  }



  template <int dim>
  void
  CpdiBasis<dim>::begin_parts(const unsigned int batch,
                              CellParts<dim>    &parts) const
  {
    const unsigned int n_points = this->batches[batch].n_points;
    const CornerCells  cells    = cells_of_batches[batch];
    const unsigned int first    = first_place[batch];
    parts.cells.assign(cells.cells.begin(), cells.cells.begin() + cells.n);
    parts.places.assign(&places_of_nodes[first],
                        &places_of_nodes[first] + cells.n * n_corners);
    parts.shares.assign(n_points * cells.n, 0.);
    parts.gradients.assign(n_points * cells.n * n_corners, Tensor<1, dim>());
  }



  template <int dim>
  void
  CpdiBasis<dim>::find_mesh_gradients()
  {
    mesh_gradients.clear();
    first_gradient.clear();
    std::vector<Tensor<1, dim>> gradients;
    StencilBlock<dim>           block;
    CellParts<dim>              parts;
    CellPatch<dim>              patch(neighbours);
    for (unsigned int batch = 0; batch < this->batches.size(); ++batch)
      {
        const std::size_t first = gradients.size();
        first_gradient.push_back(first);
        evaluate(batch, block);
        gradients.insert(gradients.end(),
                         block.gradients.begin(),
                         block.gradients.begin() +
                           block.n_points * block.n_nodes);
        begin_parts(batch, parts);
        patch.reinit(neighbours.cell(cell_of_batch[batch]));
        const unsigned int n = parts.places.size();
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            if (add_parts_of(block.points[p], p, patch, parts) > most_left_out)
              continue;
            const auto own = gradients.begin() + first + p * block.n_nodes;
            std::fill_n(own, block.n_nodes, Tensor<1, dim>());
            for (unsigned int i = 0; i < n; ++i)
              own[parts.places[i]] += parts.gradients[p * n + i];
          }
      }
    mesh_gradients = std::move(gradients);
  }



  template <int dim>
  double
  CpdiBasis<dim>::add_parts_of(const unsigned int    point,
                               const unsigned int    i,
                               const CellPatch<dim> &patch,
                               CellParts<dim>       &parts) const
  {
    const CornerCells          own     = cells_of(point);
    const auto                 corners = this->domain_corners(point);
    const CellMap<dim>         map(corners);
    const auto                &box = this->space.mesh().box_grid();
    std::array<Intervals, dim> along;
    for (unsigned int d = 0; d < dim; ++d)
      along[d] = own.n == 1 ? intervals(2) :
                 box        ? intervals(4, crossing(*box, corners, d)) :
                              intervals(4);
    double             sum = 0, left_out = 0;
    const unsigned int n_parts = Utilities::fixed_power<dim>(along[0].n);
    for (unsigned int part = 0; part < n_parts; ++part)
      {
        Point<dim>   middle;
        double       size  = 1;
        unsigned int digit = part;
        for (unsigned int d = 0; d < dim; ++d, digit /= along[0].n)
          {
            const unsigned int i = digit % along[0].n;
            middle[d]            = along[d].middle[i];
            size *= along[d].length[i];
          }
        unsigned int cell = GridSpace<dim>::no_cell;
        double       N[n_corners];
        const bool   found = patch.locate(this->points.position(point),
                                        map.place(middle),
                                        cell,
                                        N);
        const double w     = size * std::abs(determinant(map.jacobian(middle)));
        const auto   end   = own.cells.begin() + own.n;
        if (!found || std::find(own.cells.begin(), end, cell) == end)
          {
            left_out += w;
            continue;
          }
        Point<dim> xi;
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            xi[d] += (a >> d) & 1 ? N[a] : 0.;
        sum += w;
        add_part(i, cell, xi, w, parts);
      }
    const double part_left_out = left_out / (sum + left_out);
    if (sum == 0)
      {
        Point<dim> middle;
        for (unsigned int d = 0; d < dim; ++d)
          middle[d] = 0.5;
        sum = 1;
        add_part(i, own.cells[0], middle, sum, parts);
      }
    const unsigned int m = parts.cells.size();
    for (unsigned int c = i * m; c < (i + 1) * m; ++c)
      {
        parts.shares[c] /= sum;
        for (unsigned int a = c * n_corners; a < (c + 1) * n_corners; ++a)
          parts.gradients[a] /= sum;
      }
    return part_left_out;
  }



  template <int dim>
  void
  CpdiBasis<dim>::add_part(const unsigned int i,
                           const unsigned int cell,
                           Point<dim>         xi,
                           const double       weight,
                           CellParts<dim>    &parts) const
  {
    const unsigned int m = parts.cells.size();
    const unsigned int c =
      i * m + (std::find(parts.cells.begin(), parts.cells.end(), cell) -
               parts.cells.begin());
    Point<dim>     X[n_corners];
    double         N[n_corners];
    Tensor<1, dim> gradients[n_corners];
    for (unsigned int a = 0; a < n_corners; ++a)
      X[a] = this->space.node_position(this->space.cell_nodes(cell)[a]);
    for (unsigned int d = 0; d < dim; ++d)
      xi[d] = std::clamp(xi[d], 0., 1.);
    CellShapes<dim, 1>::evaluate(xi, X, N, gradients);
    parts.shares[c] += weight;
    for (unsigned int a = 0; a < n_corners; ++a)
      parts.gradients[c * n_corners + a] += weight * gradients[a];
  }



#define INSTANTIATE(dim)                                                  \
  template void CpdiBasis<dim>::evaluate_parts(const unsigned int,        \
                                               const StencilBlock<dim> &, \
                                               CellParts<dim> &) const;   \
  template void CpdiBasis<dim>::find_mesh_gradients();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
