// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/cpdi_basis.h>

#include <moraine/basis/domain_tools.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/object_error.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  CpdiBasis<dim>::CpdiBasis(const GridSpace<dim>         &space,
                            const PointSet<dim>          &points,
                            const CellSeeder<dim>        &seeder,
                            const std::vector<Body<dim>> &bodies,
                            const std::string            &name)
    : Basis<dim>(space, points)
    , seeder(seeder)
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
    template <int dim, std::size_t n>
    std::array<unsigned int, n>
    request_vectors(PointFields &fields, const std::string &name)
    {
      std::array<unsigned int, n> offsets;
      for (unsigned int i = 0; i < n; ++i)
        offsets[i] = fields
                       .request(typename FieldNames<dim>::Vector{
                         name + "_" + std::to_string(i + 1), "length"})
                       .offset();
      return offsets;
    }



    template <int dim, std::size_t n>
    std::array<unsigned int, n>
    offsets_of_vectors(PointFields fields, const std::string &name)
    {
      return request_vectors<dim, n>(fields, name);
    }



    template <int dim>
    double
    volume_of(const CellVertices<dim> &corners)
    {
      double         w[1 << dim];
      Tensor<1, dim> g[1 << dim];
      return DomainTools::average_weights<dim>(corners, w, g);
    }
  } // namespace



  template <int dim>
  void
  Cpdi1Basis<dim>::request_fields(PointFields &fields)
  {
    request_vectors<dim, dim>(fields, "half_edge");
  }



  template <int dim>
  Cpdi1Basis<dim>::Cpdi1Basis(const GridSpace<dim>         &space,
                              const PointSet<dim>          &points,
                              const CellSeeder<dim>        &seeder,
                              const std::vector<Body<dim>> &bodies,
                              const bool                    split)
    : CpdiBasis<dim>(space, points, seeder, bodies, "CPDI1")
    , split(split)
    , offsets(offsets_of_vectors<dim, dim>(points.fields(), "half_edge"))
  {}



  template <int dim>
  void
  Cpdi1Basis<dim>::initialise_points(PointSet<dim> &points) const
  {
    const auto domains = this->initial_domains(points);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const auto    &corners = domains[p].corners;
        Tensor<2, dim> R; // rows: r_i
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int c = 0; c < n_corners; ++c)
            R[d] += ((c >> d) & 1 ? 1. : -1.) / n_corners * corners[c];
        const double volume =
          domains[p].is_cut ? volume_of<dim>(corners) : points.volume(p);
        const double factor =
          std::pow(volume / (n_corners * determinant(R)), 1. / dim);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int i = 0; i < dim; ++i)
            points.values(p)[offsets[d] + i] = factor * R[d][i];
      }
  }



  template <int dim>
  Tensor<2, dim>
  Cpdi1Basis<dim>::half_edges(const unsigned int p) const
  {
    Tensor<2, dim> R;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int i = 0; i < dim; ++i)
        R[i][d] = this->points.values(p)[offsets[d] + i];
    return R;
  }



  template <int dim>
  CellVertices<dim>
  Cpdi1Basis<dim>::domain_corners(const unsigned int p) const
  {
    return DomainTools::parallelepiped(this->points.position(p), half_edges(p));
  }



  template <int dim>
  void
  Cpdi1Basis<dim>::weights(const unsigned int p,
                           double            *w,
                           Tensor<1, dim>    *g) const
  {
    const Tensor<2, dim> inverse_R = invert(half_edges(p));
    for (unsigned int c = 0; c < n_corners; ++c)
      {
        Tensor<1, dim> signs;
        for (unsigned int d = 0; d < dim; ++d)
          signs[d] = (c >> d) & 1 ? 1 : -1;
        w[c] = 1. / n_corners;
        g[c] = (signs * inverse_R) / n_corners;
      }
  }



  template <int dim>
  void
  Cpdi1Basis<dim>::move_domains(
    PointSet<dim> &points,
    const std::vector<Tensor<1, dim>> &,
    const std::vector<Tensor<2, dim>> &gradients) const
  {
    if (!DomainTools::finite_strain(points))
      return;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const Tensor<2, dim> R         = half_edges(p);
        const Tensor<2, dim> increment = gradients[p] * R;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int i = 0; i < dim; ++i)
            points.values(p)[offsets[d] + i] += increment[i][d];
      }
  }



  template <int dim>
  bool
  Cpdi1Basis<dim>::split_domains(PointSet<dim> &points) const
  {
    if (!split)
      return false;
    const auto    &neighbours = this->mesh_neighbours();
    CellPatch<dim> patch(neighbours);
    auto           patch_cell   = points.mesh().triangulation().end();
    const auto     is_too_large = [&](const unsigned int p) {
      const auto cell =
        neighbours.cell_around(points.cell_of(p), points.position(p));
      // The search for cells tells about points that left the mesh.
      if (cell == points.mesh().triangulation().end())
        return false;
      if (cell != patch_cell)
        patch.reinit(cell);
      patch_cell = cell;
      for (const Point<dim> &corner : domain_corners(p))
        {
          unsigned int index;
          double       N[n_corners];
          if (!patch.locate(points.position(p), corner, index, N))
            return true;
        }
      return false;
    };
    return DomainTools::split_points<dim>(
      points,
      [&](const unsigned int p) -> unsigned int {
        if (!is_too_large(p))
          return dim;
        const Tensor<2, dim> rows    = transpose(half_edges(p));
        unsigned int         longest = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (rows[d].norm() > rows[longest].norm())
            longest = d;
        return longest;
      },
      [&](const unsigned int p, const unsigned int d) {
        Tensor<1, dim> offset;
        for (unsigned int i = 0; i < dim; ++i)
          {
            points.values(p)[offsets[d] + i] *= 0.5;
            offset[i] = points.values(p)[offsets[d] + i];
          }
        return offset;
      });
  }



  template <int dim>
  void
  Cpdi2Basis<dim>::request_fields(PointFields &fields)
  {
    request_vectors<dim, n_corners>(fields, "corner");
  }



  template <int dim>
  Cpdi2Basis<dim>::Cpdi2Basis(const GridSpace<dim>         &space,
                              const PointSet<dim>          &points,
                              const CellSeeder<dim>        &seeder,
                              const std::vector<Body<dim>> &bodies)
    : CpdiBasis<dim>(space, points, seeder, bodies, "CPDI2")
    , finite_strain(DomainTools::finite_strain(points))
    , offsets(offsets_of_vectors<dim, n_corners>(points.fields(), "corner"))
  {}



  template <int dim>
  void
  Cpdi2Basis<dim>::store_corners(PointSet<dim>           &points,
                                 const unsigned int       p,
                                 const CellVertices<dim> &corners) const
  {
    for (unsigned int c = 0; c < n_corners; ++c)
      std::copy_n(corners[c].begin_raw(), dim, points.values(p) + offsets[c]);
  }



  template <int dim>
  void
  Cpdi2Basis<dim>::initialise_points(PointSet<dim> &points) const
  {
    const auto domains = this->initial_domains(points);
    const auto v_0     = points.fields().find(FieldNames<dim>::initial_volume);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        store_corners(points, p, domains[p].corners);
        if (!domains[p].is_cut)
          points.set_volume(p, volume_of<dim>(domains[p].corners));
        if (v_0.exists())
          v_0.store(points.volume(p), points.values(p));
      }
  }



  template <int dim>
  CellVertices<dim>
  Cpdi2Basis<dim>::domain_corners(const unsigned int p) const
  {
    CellVertices<dim> corners;
    for (unsigned int c = 0; c < n_corners; ++c)
      std::copy_n(this->points.values(p) + offsets[c],
                  dim,
                  corners[c].begin_raw());
    return corners;
  }



  template <int dim>
  void
  Cpdi2Basis<dim>::weights(const unsigned int p,
                           double            *w,
                           Tensor<1, dim>    *g) const
  {
    DomainTools::average_weights<dim>(domain_corners(p), w, g);
  }



  template <int dim>
  CellVertices<dim>
  Cpdi2Basis<dim>::moved_corners(
    const unsigned int                 p,
    const std::vector<Tensor<1, dim>> &nodal_increments) const
  {
    CellVertices<dim> corners = domain_corners(p);
    for (unsigned int c = 0; c < n_corners; ++c)
      corners[c] += this->corner_increment(p, c, nodal_increments);
    return corners;
  }



  template <int dim>
  std::string
  Cpdi2Basis<dim>::failure_of(
    const std::vector<Tensor<1, dim>> &nodal_increments) const
  {
    if (!finite_strain)
      return "";
    // Averages over a domain with re-entrant corners still make sense, as long
    // as more of it is the right way round than not.
    for (unsigned int p = 0; p < this->points.n_local(); ++p)
      {
        const auto corners = moved_corners(p, nodal_increments);
        if (!(volume_of<dim>(corners) > 0))
          return DomainTools::name_of(this->points, p) +
                 ": its domain would turn inside out";
      }
    return "";
  }



  template <int dim>
  void
  Cpdi2Basis<dim>::move_domains(
    PointSet<dim>                     &points,
    const std::vector<Tensor<1, dim>> &nodal_increments,
    const std::vector<Tensor<2, dim>> &gradients) const
  {
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (finite_strain)
        {
          const auto     corners = moved_corners(p, nodal_increments);
          Tensor<2, dim> dF      = gradients[p];
          for (unsigned int d = 0; d < dim; ++d)
            dF[d][d] += 1;
          // It has followed the gradient until here.
          points.set_volume(p,
                            points.volume(p) * volume_of<dim>(corners) /
                              (determinant(dF) *
                               volume_of<dim>(domain_corners(p))));
          store_corners(points, p, corners);
        }
      else
        {
          Tensor<1, dim> shift;
          for (unsigned int c = 0; c < n_corners; ++c)
            shift += this->function_weight(p, c) *
                     this->corner_increment(p, c, nodal_increments);
          auto corners = domain_corners(p);
          for (Point<dim> &corner : corners)
            corner += shift;
          store_corners(points, p, corners);
        }
  }



  template class CpdiBasis<2>;
  template class CpdiBasis<3>;
  template class Cpdi1Basis<2>;
  template class Cpdi1Basis<3>;
  template class Cpdi2Basis<2>;
  template class Cpdi2Basis<3>;
} // namespace moraine
