// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/cpdi1_basis.h>

#include <utility>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  Cpdi1Basis<dim>::request_fields(PointFields &fields)
  {
    DomainTools::request_vectors<dim, dim>(fields, "half_edge");
  }



  template <int dim>
  Cpdi1Basis<dim>::Cpdi1Basis(const GridSpace<dim>         &space,
                              const PointSet<dim>          &points,
                              const CellSeeder<dim>        &seeder,
                              const std::vector<Body<dim>> &bodies,
                              const bool                    split)
    : CpdiBasis<dim>(space, points, seeder, bodies, "CPDI1")
    , split(split)
    , offsets(
        DomainTools::offsets_of_vectors<dim, dim>(points.fields(), "half_edge"))
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
        const double volume = domains[p].is_cut ?
                                DomainTools::volume<dim>(corners) :
                                points.volume(p);
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



  namespace
  {
    /** Of the @p edges of a domain, columns, the one that is longest in sizes
     * of the @p cell, and how long that is. */
    template <int dim>
    std::pair<unsigned int, double>
    longest_in_cell(const CellVertices<dim> &cell, const Tensor<2, dim> &edges)
    {
      Tensor<2, dim> size; // columns: along the cell, between opposite faces
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int v = 0; v < cell.size(); ++v)
          for (unsigned int i = 0; i < dim; ++i)
            size[i][d] +=
              ((v >> d) & 1 ? 1. : -1.) * cell[v][i] / (cell.size() / 2);
      const Tensor<2, dim>            in_cell = invert(size) * edges;
      std::pair<unsigned int, double> longest(0, 0.);
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int i = 0; i < dim; ++i)
          if (std::abs(in_cell[i][d]) > longest.second)
            longest = {d, std::abs(in_cell[i][d])};
      return longest;
    }
  } // namespace



  template <int dim>
  unsigned int
  Cpdi1Basis<dim>::too_long_edge(const unsigned int p,
                                 CellPatch<dim>    &patch) const
  {
    const auto &neighbours = this->mesh_neighbours();
    const auto  cell =
      neighbours.cell_around(this->points.cell_of(p), this->points.position(p));
    // The search for cells tells about points that left the mesh.
    if (cell == this->points.mesh().triangulation().end())
      return dim;
    const auto [edge, length] =
      longest_in_cell(vertices_of<dim>(cell), 2. * half_edges(p));
    if (length > (1 + 1e-9) * DomainTools::longest_edge)
      return edge;
    // In meshes of distorted cells.
    patch.reinit(cell);
    for (const Point<dim> &corner : domain_corners(p))
      {
        unsigned int index;
        double       N[n_corners];
        if (!patch.locate(this->points.position(p), corner, index, N))
          return edge;
      }
    return dim;
  }



  template <int dim>
  bool
  Cpdi1Basis<dim>::split_domains(PointSet<dim> &points) const
  {
    if (!split)
      return false;
    CellPatch<dim> patch(this->mesh_neighbours());
    return DomainTools::split_points<dim>(
      points,
      [&](const unsigned int p) { return too_long_edge(p, patch); },
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



  template class Cpdi1Basis<2>;
  template class Cpdi1Basis<3>;
} // namespace moraine
