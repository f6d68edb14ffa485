// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/cpdi_basis.h>

#include <moraine/basis/domain_tools.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/object_error.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  CpdiBasis<dim>::CpdiBasis(const GridSpace<dim>         &space,
                            const PointSet<dim>          &points,
                            const CellSeeder<dim>        &seeder,
                            const std::vector<Body<dim>> &bodies,
                            const bool                    split,
                            const bool                    gradients_of_mesh,
                            const std::string            &name)
    : Basis<dim>(space, points)
    , seeder(seeder)
    , split(split)
    , gradients_of_mesh(gradients_of_mesh)
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
    if (split)
      limits = limits_of_bodies();
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
    Basis<dim>::append_batch(first_node);
  }



  template <int dim>
  bool
  CpdiBasis<dim>::batch_points()
  {
    AssertDimension(corner_cells.size(), this->points.n_local() * n_corners);
    const std::vector<unsigned int> previous_nodes =
      std::move(this->batch_node_list);
    this->clear_batches();
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
    if (gradients_of_mesh)
      find_mesh_gradients();
    return this->batch_node_list != previous_nodes;
  }



  template <int dim>
  void
  CpdiBasis<dim>::evaluate(const unsigned int batch,
                           StencilBlock<dim> &block) const
  {
    const auto          &g      = this->reinit(batch, block);
    const unsigned char *places = &places_of_nodes[first_place[batch]];
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
    if (!mesh_gradients.empty())
      std::copy_n(&mesh_gradients[first_gradient[batch]],
                  g.n_points * g.n_nodes,
                  block.gradients.begin());
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
  std::vector<double>
  CpdiBasis<dim>::limits_of_bodies() const
  {
    const double of_full_cell = std::pow(seeder.n_sub_cells(), -1. / dim);
    const bool   is_box       = this->space.mesh().box_grid().has_value();
    std::vector<double> of_bodies;
    for (const bool seeded : is_seeded)
      of_bodies.push_back(
        std::max(DomainTools::longest_edge, seeded ? of_full_cell : 0.));
    if (is_box &&
        std::find(is_seeded.begin(), is_seeded.end(), false) == is_seeded.end())
      return of_bodies;
    const auto domains = initial_domains(this->points);
    for (const auto &in_cell : this->points.cells())
      {
        const auto cell = vertices_of<dim>(in_cell.cell);
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          if (const unsigned int body = this->points.body(p);
              !is_box || !is_seeded[body])
            of_bodies[body] =
              std::max(of_bodies[body],
                       longest_in_cell<dim>(cell, domains[p].corners).second);
      }
    Utilities::MPI::max(of_bodies, this->space.communicator(), of_bodies);
    return of_bodies;
  }



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
    const Point<dim> whole = DomainTools::region_of<dim>(corners).centroid;
    for (const auto &half : DomainTools::halves_of<dim>(corners, d))
      if (is_outside(x + (DomainTools::region_of<dim>(half).centroid - whole)))
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
    bool is_far = longest.second > (1 + 1e-9) * limits[this->points.body(p)];
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
