// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/cpdi_basis.h>

#include <moraine/basis/domain_tools.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/object_error.h>
#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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
  CpdiBasis<dim>::CpdiBasis(const GridSpace<dim>         &space,
                            const PointSet<dim>          &points,
                            const CellSeeder<dim>        &seeder,
                            const std::vector<Body<dim>> &bodies,
                            const bool                    split,
                            const std::string            &name)
    : Basis<dim>(space, points)
    , seeder(seeder)
    , split(split)
    , name(name)
    , neighbours(space.mesh())
  {
    if (space.degree() != 1)
      throw ObjectError("method",
                        name,
                        "found '" + name +
                          "' with shape functions it cannot use, allowed: with "
                          "degree 1");
    for (const Body<dim> &body : bodies)
      {
        is_seeded.push_back(body.shape != nullptr);
        half_edges_of_body.push_back(body.listed.half_edges);
      }
  }



  template <int dim>
  std::vector<DomainTools::InitialDomain<dim>>
  CpdiBasis<dim>::initial_domains(const PointSet<dim> &points) const
  {
    return DomainTools::initial_domains(points,
                                        seeder,
                                        is_seeded,
                                        half_edges_of_body);
  }



  template <int dim>
  void
  CpdiBasis<dim>::mark_cells(std::vector<unsigned char> &active)
  {
    neighbours.update();
    const unsigned int n = this->points.n_local() * n_corners;
    corner_cells.resize(n);
    corner_values.resize(n * n_corners);
    function_weights.resize(n);
    gradient_weights.resize(n);

    n_far = 0;
    std::string    failure;
    CellPatch<dim> patch(neighbours), far_patch(neighbours);
    for (const auto &in_cell : this->points.cells())
      {
        patch.reinit(in_cell.cell);
        // The rank knows its neighbours only if it is active.
        active[in_cell.cell->active_cell_index()] = 1;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          {
            const auto corners = this->domain_corners(p);
            bool       is_far  = false;
            for (unsigned int c = 0; c < n_corners; ++c)
              {
                const unsigned int k     = p * n_corners + c;
                const auto         found = [&](const CellPatch<dim> &cells) {
                  return cells.locate(this->points.position(p),
                                      corners[c],
                                      corner_cells[k],
                                      &corner_values[k * n_corners]);
                };
                if (!found(patch))
                  {
                    is_far = true;
                    far_patch.reinit(
                      neighbours.nearest_cell(in_cell.cell, corners[c]));
                    if (!found(far_patch))
                      {
                        failure = DomainTools::name_of(this->points, p) +
                                  ": no cell is near a corner of its domain";
                        continue;
                      }
                  }
                active[corner_cells[k]] = 1;
              }
            n_far += is_far;
            weights(p,
                    &function_weights[p * n_corners],
                    &gradient_weights[p * n_corners]);
          }
      }
    DomainTools::throw_first(failure, this->space.communicator());
  }



  template <int dim>
  typename CpdiBasis<dim>::CornerCells
  CpdiBasis<dim>::cells_of(const unsigned int p) const
  {
    CornerCells found;
    auto       &cells = found.cells;
    std::copy_n(&corner_cells[p * n_corners], n_corners, cells.begin());
    std::sort(cells.begin(), cells.end());
    const auto end = std::unique(cells.begin(), cells.end());
    found.n        = end - cells.begin();
    std::fill(end, cells.end(), GridSpace<dim>::no_cell);
    return found;
  }



  template <int dim>
  void
  CpdiBasis<dim>::append_batch(const CornerCells &cells)
  {
    const unsigned int first_node = this->batch_node_list.size();
    first_place.push_back(places_of_nodes.size());
    cells_of_batches.push_back(cells);
    for (unsigned int i = 0; i < cells.n; ++i)
      {
        const unsigned int *nodes = this->space.cell_nodes(cells.cells[i]);
        for (unsigned int a = 0; a < n_corners; ++a)
          {
            const auto begin = this->batch_node_list.begin() + first_node;
            const auto place =
              std::find(begin, this->batch_node_list.end(), nodes[a]);
            places_of_nodes.push_back(place - begin);
            if (place == this->batch_node_list.end())
              this->batch_node_list.push_back(nodes[a]);
          }
      }
    this->batches.push_back(
      {0,
       0,
       first_node,
       static_cast<unsigned int>(this->batch_node_list.size()) - first_node});
  }



  template <int dim>
  bool
  CpdiBasis<dim>::batch_points()
  {
    AssertDimension(corner_cells.size(), this->points.n_local() * n_corners);
    const std::vector<unsigned int> previous_nodes =
      std::move(this->batch_node_list);
    this->batches.clear();
    this->batch_node_list.clear();
    this->order.clear();
    first_place.clear();
    cells_of_batches.clear();
    cell_of_batch.clear();
    places_of_nodes.clear();
    cell_in_batch.resize(corner_cells.size());

    std::vector<std::pair<CornerCells, unsigned int>> in_cell;
    std::vector<CornerCells>                          of_batches;
    for (const auto &cell : this->points.cells())
      {
        in_cell.clear();
        for (unsigned int p = cell.first; p < cell.last; ++p)
          in_cell.emplace_back(cells_of(p), p);
        const unsigned int first_batch = this->batches.size();
        this->batch_points_of_cell(in_cell,
                                   of_batches,
                                   [this](const CornerCells &cells) {
                                     append_batch(cells);
                                   });
        cell_of_batch.resize(this->batches.size(),
                             cell.cell->active_cell_index());
        for (unsigned int i = 0; i < of_batches.size(); ++i)
          {
            const auto &batch = this->batches[first_batch + i];
            const auto &cells = of_batches[i].cells;
            for (unsigned int q = 0; q < batch.n_points; ++q)
              {
                const unsigned int first =
                  this->order[batch.first_point + q] * n_corners;
                for (unsigned int k = first; k < first + n_corners; ++k)
                  cell_in_batch[k] =
                    std::find(cells.begin(), cells.end(), corner_cells[k]) -
                    cells.begin();
              }
          }
      }
    return this->batch_node_list != previous_nodes;
  }



  template <int dim>
  void
  CpdiBasis<dim>::evaluate(const unsigned int batch,
                           StencilBlock<dim> &block) const
  {
    const auto          &g      = this->batches[batch];
    const unsigned char *places = &places_of_nodes[first_place[batch]];
    block.reinit(g.n_points,
                 &this->order[g.first_point],
                 g.n_nodes,
                 &this->batch_node_list[g.first_node]);
    std::fill_n(block.values.begin(), g.n_points * g.n_nodes, 0.);
    std::fill_n(block.gradients.begin(),
                g.n_points * g.n_nodes,
                Tensor<1, dim>());
    for (unsigned int p = 0; p < g.n_points; ++p)
      {
        double         *S      = &block.values[p * g.n_nodes];
        Tensor<1, dim> *grad_S = &block.gradients[p * g.n_nodes];
        for (unsigned int c = 0; c < n_corners; ++c)
          {
            const unsigned int   k     = block.points[p] * n_corners + c;
            const double        *N     = &corner_values[k * n_corners];
            const unsigned char *place = places + cell_in_batch[k] * n_corners;
            for (unsigned int a = 0; a < n_corners; ++a)
              {
                S[place[a]] += function_weights[k] * N[a];
                grad_S[place[a]] += N[a] * gradient_weights[k];
              }
          }
      }
  }



  template <int dim>
  void
  CpdiBasis<dim>::evaluate_parts(const unsigned int       batch,
                                 const StencilBlock<dim> &block,
                                 CellParts<dim>          &parts) const
  {
    const auto        &g     = this->batches[batch];
    const CornerCells  cells = cells_of_batches[batch];
    const unsigned int first = first_place[batch];
    parts.cells.assign(cells.cells.begin(), cells.cells.begin() + cells.n);
    parts.places.assign(&places_of_nodes[first],
                        &places_of_nodes[first] + cells.n * n_corners);
    parts.shares.assign(g.n_points * cells.n, 0.);
    parts.gradients.assign(g.n_points * cells.n * n_corners, Tensor<1, dim>());
    CellPatch<dim> patch(neighbours);
    patch.reinit(neighbours.cell(cell_of_batch[batch]));
    for (unsigned int i = 0; i < g.n_points; ++i)
      add_parts_of(block.points[i], i, patch, parts);
  }



  template <int dim>
  void
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
    double             sum     = 0;
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
        const auto   end   = own.cells.begin() + own.n;
        if (!found || std::find(own.cells.begin(), end, cell) == end)
          continue;
        Point<dim> xi;
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            xi[d] += (a >> d) & 1 ? N[a] : 0.;
        const double w = size * std::abs(determinant(map.jacobian(middle)));
        sum += w;
        add_part(i, cell, xi, w, parts);
      }
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



  template <int dim>
  Tensor<1, dim>
  CpdiBasis<dim>::corner_increment(
    const unsigned int                 p,
    const unsigned int                 c,
    const std::vector<Tensor<1, dim>> &nodal_increments) const
  {
    const unsigned int  k     = p * n_corners + c;
    const double       *N     = &corner_values[k * n_corners];
    const unsigned int *nodes = this->space.cell_nodes(corner_cells[k]);
    Tensor<1, dim>      increment;
    for (unsigned int a = 0; a < n_corners; ++a)
      increment += N[a] * nodal_increments[nodes[a]];
    return increment;
  }



  namespace
  {
    /** In cell sizes: what is shorter is not why a corner is far away. */
    constexpr double shortest_split = 0.1;



    /** Of smallest_corner(): domains more distorted than that did not grow by
     * being stretched. */
    constexpr double sharpest_split = 0.25;



    /** Of the way from a point to a corner of its domain: what has to be in the
     * mesh, for a half mostly outside of it would soon leave it. */
    constexpr double inner_part = 0.9;



    /** The centroid of a domain. */
    template <int dim>
    Point<dim>
    middle_of(const CellVertices<dim> &corners)
    {
      double         w[1 << dim];
      Tensor<1, dim> g[1 << dim];
      DomainTools::average_weights<dim>(corners, w, g);
      Point<dim> middle;
      for (unsigned int c = 0; c < corners.size(); ++c)
        middle += w[c] * corners[c];
      return middle;
    }



    /** Determinant of the edges at a corner of a domain, where it is smallest,
     * over the domain's volume: 1 for a parallelogram, 0 where an angle is
     * straight. */
    template <int dim>
    double
    smallest_corner(const CellVertices<dim> &corners)
    {
      double smallest = std::numeric_limits<double>::infinity();
      for (unsigned int c = 0; c < corners.size(); ++c)
        {
          Tensor<2, dim> edges; // columns
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int i = 0; i < dim; ++i)
              edges[i][d] =
                corners[c | (1u << d)][i] - corners[c & ~(1u << d)][i];
          smallest = std::min(smallest, determinant(edges));
        }
      return smallest / DomainTools::volume<dim>(corners);
    }



    /** Direction of the edge of a domain that is longest in sizes of the @p
     * cell, and how long that is. */
    template <int dim>
    std::pair<unsigned int, double>
    longest_in_cell(const CellVertices<dim> &cell,
                    const CellVertices<dim> &domain)
    {
      Tensor<2, dim> size; // columns: along the cell, between opposite faces
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int v = 0; v < cell.size(); ++v)
          for (unsigned int i = 0; i < dim; ++i)
            size[i][d] +=
              ((v >> d) & 1 ? 1. : -1.) * cell[v][i] / (cell.size() / 2);
      const Tensor<2, dim>            to_cell = invert(size);
      std::pair<unsigned int, double> longest(0, 0.);
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int c = 0; c < domain.size(); ++c)
          if (!((c >> d) & 1))
            {
              const Tensor<1, dim> edge =
                to_cell * (domain[c | (1u << d)] - domain[c]);
              for (unsigned int i = 0; i < dim; ++i)
                if (std::abs(edge[i]) > longest.second)
                  longest = {d, std::abs(edge[i])};
            }
      return longest;
    }
  } // namespace



  template <int dim>
  bool
  CpdiBasis<dim>::can_be_halved(
    const CellVertices<dim>                     &corners,
    const unsigned int                           d,
    const Point<dim>                            &x,
    const typename CellPatch<dim>::CellIterator &cell) const
  {
    if (smallest_corner<dim>(corners) < sharpest_split)
      return false;
    const auto is_outside = [&](const Point<dim> &place) {
      return neighbours.cell_around(cell, place) ==
             this->points.mesh().triangulation().end();
    };
    for (const Point<dim> &corner : corners)
      if (is_outside(x + inner_part * (corner - x)))
        return false;
    // At a hole in the mesh the middle may be outside though no corner is.
    const Point<dim> whole = middle_of<dim>(corners);
    for (const auto &half : DomainTools::halves_of<dim>(corners, d))
      if (is_outside(x + (middle_of<dim>(half) - whole)))
        return false;
    return true;
  }



  template <int dim>
  unsigned int
  CpdiBasis<dim>::too_long_edge(
    const unsigned int                     p,
    typename CellPatch<dim>::CellIterator &cell_of_patch,
    CellPatch<dim>                        &patch) const
  {
    const Point<dim> x    = this->points.position(p);
    const auto       cell = neighbours.cell_around(this->points.cell_of(p), x);
    // The search for cells tells about points that left the mesh.
    if (cell == this->points.mesh().triangulation().end())
      return dim;
    const auto corners = this->domain_corners(p);
    const auto longest = longest_in_cell<dim>(vertices_of<dim>(cell), corners);
    const double limit =
      std::max(DomainTools::longest_edge,
               std::pow(seeder.n_sub_cells(), -1. / dim)); // as at the start
    bool is_far = longest.second > (1 + 1e-9) * limit;
    if (!is_far && longest.second > shortest_split)
      {
        // In meshes of distorted cells.
        if (cell != cell_of_patch)
          patch.reinit(cell_of_patch = cell);
        for (const Point<dim> &corner : corners)
          {
            unsigned int index;
            double       N[n_corners];
            is_far = is_far || !patch.locate(x, corner, index, N);
          }
      }
    if (!is_far)
      return dim;
    return can_be_halved(corners, longest.first, x, cell) ? longest.first : dim;
  }



  template <int dim>
  bool
  CpdiBasis<dim>::split_domains(PointSet<dim> &points)
  {
    if (!split)
      return false;
    neighbours.update(); // the mesh may have moved
    typename CellPatch<dim>::CellIterator cell;
    CellPatch<dim>                        patch(neighbours);
    return DomainTools::split_points<dim>(
      points,
      [&](const unsigned int p) { return too_long_edge(p, cell, patch); },
      [&](const unsigned int lower,
          const unsigned int upper,
          const unsigned int d) { return halve(points, lower, upper, d); });
  }



  template class CpdiBasis<2>;
  template class CpdiBasis<3>;
} // namespace moraine
