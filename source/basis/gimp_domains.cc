// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The boxes of GIMP: how long they are at first, how they go with the material,
// and when they are halved.

#include <moraine/basis/gimp_basis.h>

#include <moraine/basis/domain_tools.h>
#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/mpi.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Tensor<1, dim>
    edges_of(const BoxGrid<dim> &grid)
    {
      Tensor<1, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        edges[d] = grid.cell_size[d];
      return edges;
    }



    /** Half the edges of the box along the axes around a parallelepiped. */
    template <int dim>
    Tensor<1, dim>
    half_box_around(const Tensor<2, dim> &half_edges)
    {
      Tensor<1, dim> half_box;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          half_box[d] += std::abs(half_edges[d][e]);
      return half_box;
    }



    /** Half the edges of a box of @p volume with the same proportions. */
    template <int dim>
    Tensor<1, dim>
    scaled_to(const double volume, const Tensor<1, dim> &half_edges)
    {
      double of_edges = 1;
      for (unsigned int d = 0; d < dim; ++d)
        of_edges *= 2 * half_edges[d];
      return std::pow(volume / of_edges, 1. / dim) * half_edges;
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  GimpBasis<dim>::first_half_length(const unsigned int point) const
  {
    const BoxGrid<dim> &grid = this->grid();
    const unsigned int  body = this->points.body(point);
    if (is_of_cells(body))
      {
        Point<dim> xi;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double place =
              (this->points.position(point)[d] - grid.lower_corner[d]) /
              grid.cell_size[d];
            xi[d] = place - std::floor(place);
          }
        Tensor<1, dim> half_length = seeder.distance_to_faces(xi);
        for (unsigned int d = 0; d < dim; ++d)
          half_length[d] *= grid.cell_size[d];
        return half_length;
      }
    const bool has_part =
      body < half_edges_of_body.size() && half_edges_of_body[body].norm() > 0;
    Tensor<1, dim> half_length =
      scaled_to(this->points.volume(point),
                has_part ? half_box_around(half_edges_of_body[body]) :
                           0.5 * edges_of(grid));
    for (unsigned int d = 0; d < dim; ++d)
      half_length[d] = std::min(0.5 * grid.cell_size[d], half_length[d]);
    return half_length;
  }



  template <int dim>
  std::vector<double>
  GimpBasis<dim>::limits_of_bodies() const
  {
    unsigned int n_bodies = 0;
    for (unsigned int p = 0; p < this->points.n_local(); ++p)
      n_bodies = std::max(n_bodies, this->points.body(p) + 1);
    std::vector<double> of_bodies(
      Utilities::MPI::max(n_bodies, this->space.communicator()),
      0.5 * DomainTools::longest_edge);
    for (unsigned int p = 0; p < this->points.n_local(); ++p)
      {
        const unsigned int body  = this->points.body(p);
        double            &limit = of_bodies[body];
        if (is_of_cells(body))
          limit = std::max(limit, 0.5 * seeder.longest_edge());
        else
          for (unsigned int d = 0; d < dim; ++d)
            limit =
              std::max(limit, first_half_length(p)[d] / grid().cell_size[d]);
      }
    Utilities::MPI::max(of_bodies, this->space.communicator(), of_bodies);
    return of_bodies;
  }



  template <int dim>
  void
  GimpBasis<dim>::initialise_points(PointSet<dim> &points) const
  {
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const Tensor<1, dim> l = first_half_length(p);
        half_length_field.store(l, points.values(p));
        if (update == DomainUpdate::stretch)
          initial_half_length_field.store(l, points.values(p));
      }
  }



  template <int dim>
  unsigned int
  GimpBasis<dim>::too_long_edge(const unsigned int point,
                                const double       limit,
                                const bool         to_halve) const
  {
    const double *l     = this->points.values(point) + half_length_offset;
    unsigned int  edge  = dim;
    double        worst = (1 + 1e-9) * limit;
    for (unsigned int d = 0; d < dim; ++d)
      // also true for what is not a number
      if (!(l[d] <= worst * grid().cell_size[d]) &&
          !(to_halve && half_is_outside(point, d)))
        {
          edge  = d;
          worst = l[d] / grid().cell_size[d];
        }
    return edge;
  }



  template <int dim>
  bool
  GimpBasis<dim>::half_is_outside(const unsigned int point,
                                  const unsigned int d) const
  {
    constexpr double margin = 1e-6; // of a cell; the search has no tolerance
    const double    *l      = this->points.values(point) + half_length_offset;
    const double     h      = grid().cell_size[d];
    const double     place =
      (this->points.position(point)[d] - grid().lower_corner[d]) / h;
    const double way = 0.5 * l[d] / h;
    return place - way < margin || place + way > grid().n_cells[d] - margin;
  }



  template <int dim>
  CellVertices<dim>
  GimpBasis<dim>::domain_corners(const unsigned int p) const
  {
    const double  *l = this->points.values(p) + half_length_offset;
    Tensor<2, dim> half_edges;
    for (unsigned int d = 0; d < dim; ++d)
      half_edges[d][d] = l[d];
    return DomainTools::parallelepiped(this->points.position(p), half_edges);
  }



  template <int dim>
  Tensor<1, dim>
  GimpBasis<dim>::tracked_half_length(
    const unsigned int                 point,
    const std::vector<Tensor<1, dim>> &nodal_increments) const
  {
    constexpr unsigned int n_corners = 1 << dim;
    const BoxGrid<dim>    &grid      = this->grid();
    // Corners are looked for in the cells whose nodes the point knows. One that
    // touches a cell by no more than round-off keeps to its neighbour.
    const Window   window  = window_of(point);
    const auto     corners = domain_corners(point);
    const double  *l       = this->points.values(point) + half_length_offset;
    Tensor<1, dim> tracked;
    for (unsigned int d = 0; d < dim; ++d)
      tracked[d] = l[d];
    for (unsigned int c = 0; c < n_corners; ++c)
      {
        std::array<unsigned int, dim> ijk;
        Point<dim>                    xi;
        for (unsigned int d = 0; d < dim; ++d)
          {
            ijk[d] = (c >> d) & 1 ? window.last[d] : window.first[d];
            xi[d] = (corners[c][d] - grid.lower_corner[d]) / grid.cell_size[d] -
                    ijk[d];
          }
        double N[n_corners];
        CellShapes<dim, 1>::values(xi, N);
        const unsigned int *nodes =
          this->space.cell_nodes(neighbours.box_cell(ijk));
        Tensor<1, dim> increment;
        for (unsigned int a = 0; a < n_corners; ++a)
          increment += N[a] * nodal_increments[nodes[a]];
        for (unsigned int d = 0; d < dim; ++d)
          tracked[d] += ((c >> d) & 1 ? 1. : -1.) * increment[d] / n_corners;
      }
    return tracked;
  }



  template <int dim>
  std::string
  GimpBasis<dim>::failure_of(
    const std::vector<Tensor<1, dim>> &nodal_increments) const
  {
    if (update != DomainUpdate::corners)
      return "";
    for (unsigned int p = 0; p < this->points.n_local(); ++p)
      {
        const Tensor<1, dim> l = tracked_half_length(p, nodal_increments);
        for (unsigned int d = 0; d < dim; ++d)
          if (!(l[d] > 0))
            return DomainTools::name_of(this->points, p) +
                   ": its box would have no length along " + "xyz"[d];
      }
    return "";
  }



  namespace
  {
    /** Diagonal of the right stretch of a deformation gradient. */
    template <int dim>
    Tensor<1, dim>
    diagonal_of_stretch(const Tensor<2, dim> &F)
    {
      Tensor<1, dim> diagonal;
      for (const auto &[square, direction] :
           eigenvectors(symmetrize(transpose(F) * F)))
        for (unsigned int d = 0; d < dim; ++d)
          diagonal[d] +=
            std::sqrt(std::max(square, 0.)) * direction[d] * direction[d];
      return diagonal;
    }
  } // namespace



  template <int dim>
  void
  GimpBasis<dim>::move_domains(
    PointSet<dim>                     &points,
    const std::vector<Tensor<1, dim>> &nodal_increments,
    const std::vector<Tensor<2, dim>> &gradients) const
  {
    if (update == DomainUpdate::stretch)
      {
        const auto F =
          points.fields().find(FieldNames<dim>::deformation_gradient);
        for (unsigned int p = 0; p < points.n_local(); ++p)
          {
            double              *values = points.values(p);
            const Tensor<1, dim> U      = diagonal_of_stretch(F(values));
            Tensor<1, dim>       l      = initial_half_length_field(values);
            for (unsigned int d = 0; d < dim; ++d)
              l[d] *= U[d];
            half_length_field.store(l, values);
          }
      }
    else if (update == DomainUpdate::corners)
      {
        for (unsigned int p = 0; p < points.n_local(); ++p)
          {
            const Tensor<1, dim> l = tracked_half_length(p, nodal_increments);
            double *half_length    = points.values(p) + half_length_offset;
            double  ratio =
              determinant(Physics::Elasticity::Kinematics::F(gradients[p]));
            for (unsigned int d = 0; d < dim; ++d)
              ratio *= half_length[d] / l[d];
            for (unsigned int d = 0; d < dim; ++d)
              half_length[d] = l[d] * std::pow(ratio, 1. / dim);
          }
      }
  }



  template <int dim>
  bool
  GimpBasis<dim>::split_domains(PointSet<dim> &points)
  {
    if (!split || update == DomainUpdate::frozen)
      return false;
    return DomainTools::split_points<dim>(
      points,
      [&](const unsigned int p) {
        return too_long_edge(p,
                             limits[points.body(p)],
                             /* to_halve = */ true);
      },
      [&](const unsigned int lower,
          const unsigned int upper,
          const unsigned int d) {
        for (const unsigned int p : {lower, upper})
          {
            (points.values(p) + half_length_offset)[d] *= 0.5;
            if (initial_half_length_field.exists())
              (points.values(p) + initial_half_length_field.offset())[d] *= 0.5;
          }
        DomainTools::Halves<dim> halves;
        halves.upper[d] = (points.values(upper) + half_length_offset)[d];
        halves.lower    = -halves.upper;
        return halves;
      });
  }



#define INSTANTIATE(dim)                                                       \
  template std::vector<double> GimpBasis<dim>::limits_of_bodies() const;       \
  template void GimpBasis<dim>::initialise_points(PointSet<dim> &) const;      \
  template unsigned int      GimpBasis<dim>::too_long_edge(const unsigned int, \
                                                      const double,       \
                                                      const bool) const;  \
  template CellVertices<dim> GimpBasis<dim>::domain_corners(                   \
    const unsigned int) const;                                                 \
  template std::string GimpBasis<dim>::failure_of(                             \
    const std::vector<Tensor<1, dim>> &) const;                                \
  template void GimpBasis<dim>::move_domains(                                  \
    PointSet<dim> &,                                                           \
    const std::vector<Tensor<1, dim>> &,                                       \
    const std::vector<Tensor<2, dim>> &) const;                                \
  template bool GimpBasis<dim>::split_domains(PointSet<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
