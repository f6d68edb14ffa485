// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/domain_tools.h>

#include <moraine/core/exceptions.h>
#include <moraine/mesh/cell_inverse.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace DomainTools
  {
    template <int dim>
    std::string
    name_of(const PointSet<dim> &points, const unsigned int p)
    {
      std::ostringstream name;
      name << std::setprecision(10) << "point " << points.id(p) << " at (";
      for (unsigned int d = 0; d < dim; ++d)
        name << (d > 0 ? ", " : "") << points.position(p)[d];
      name << ")";
      return name.str();
    }



    void
    throw_first(const std::string &message, const MPI_Comm &communicator)
    {
      for (const std::string &found :
           Utilities::MPI::all_gather(communicator, message))
        if (!found.empty())
          throw ComputationError(found);
    }



    template <int dim>
    double
    average_weights(const CellVertices<dim> &corners,
                    double                  *w,
                    Tensor<1, dim>          *g)
    {
      constexpr unsigned int n = 1 << dim;
      static const QGauss<1> line(2);
      const CellMap<dim>     map(corners);
      double                 volume = 0;
      std::fill(w, w + n, 0.);
      std::fill(g, g + n, Tensor<1, dim>());
      for (unsigned int q = 0; q < n; ++q)
        {
          Point<dim> xi;
          for (unsigned int d = 0; d < dim; ++d)
            xi[d] = line.point((q >> d) & 1)[0];
          const Tensor<2, dim> J                       = map.jacobian(xi);
          const double         dV                      = determinant(J) / n;
          const Tensor<2, dim> dV_inverse_J_transposed = cofactor(J) / n;
          volume += dV;
          for (unsigned int c = 0; c < n; ++c)
            {
              double         M = 1;
              Tensor<1, dim> unit_gradient;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  M *= (c >> d) & 1 ? xi[d] : 1 - xi[d];
                  unit_gradient[d] = (c >> d) & 1 ? 1 : -1;
                  for (unsigned int e = 0; e < dim; ++e)
                    if (e != d)
                      unit_gradient[d] *= (c >> e) & 1 ? xi[e] : 1 - xi[e];
                }
              w[c] += M * dV;
              g[c] += dV_inverse_J_transposed * unit_gradient;
            }
        }
      for (unsigned int c = 0; c < n; ++c)
        {
          w[c] /= volume;
          g[c] /= volume;
        }
      return volume;
    }



    template <int dim>
    CellVertices<dim>
    parallelepiped(const Point<dim> &x, const Tensor<2, dim> &half_edges)
    {
      CellVertices<dim> corners;
      for (unsigned int c = 0; c < corners.size(); ++c)
        {
          Tensor<1, dim> signs;
          for (unsigned int d = 0; d < dim; ++d)
            signs[d] = (c >> d) & 1 ? 1 : -1;
          corners[c] = x + half_edges * signs;
        }
      return corners;
    }



    namespace
    {
      /**
       * Half the lengths of a box around @p xi in the unit cell: a cube with
       * the @p volume, as far as there is room on both sides. What one
       * direction has no room for goes to the others.
       */
      template <int dim>
      Tensor<1, dim>
      half_lengths_around(const Point<dim> &xi, const double volume)
      {
        Tensor<1, dim>        half;
        std::array<bool, dim> is_full{};
        for (unsigned int round = 0; round < dim; ++round)
          {
            double       rest   = volume;
            unsigned int n_free = dim;
            for (unsigned int d = 0; d < dim; ++d)
              if (is_full[d])
                {
                  rest /= 2 * half[d];
                  --n_free;
                }
            for (unsigned int d = 0; d < dim; ++d)
              if (!is_full[d])
                {
                  // Round-off must not make a domain flat.
                  const double room =
                    std::max(std::min(xi[d], 1 - xi[d]), 1e-6);
                  half[d]    = 0.5 * std::pow(rest, 1. / n_free);
                  is_full[d] = half[d] >= room;
                  half[d]    = std::min(half[d], room);
                }
          }
        return half;
      }



      /**
       * The domain of a point with the centroid @p x and the volume @p volume
       * of what a body cuts from a sub-cell. In a cell, the functions averaged
       * over it have the gradient they have at @p x, which integrates theirs
       * over the body; beyond the cell's edge they have not.
       */
      template <int dim>
      CellVertices<dim>
      domain_in_sub_cell(const CellVertices<dim> &sub_cell,
                         const Point<dim>        &x,
                         const double             volume)
      {
        const CellMap<dim>   map(sub_cell);
        const Point<dim>     xi = CellInverse<dim>(sub_cell)(x).value();
        const Tensor<1, dim> half =
          half_lengths_around(xi, volume / determinant(map.jacobian(xi)));
        CellVertices<dim> corners;
        for (unsigned int c = 0; c < corners.size(); ++c)
          {
            Point<dim> corner = xi;
            for (unsigned int d = 0; d < dim; ++d)
              corner[d] += (c >> d) & 1 ? half[d] : -half[d];
            corners[c] = map.place(corner);
          }
        return corners;
      }
    } // namespace



    template <int dim>
    std::vector<InitialDomain<dim>>
    initial_domains(const PointSet<dim>               &points,
                    const CellSeeder<dim>             &seeder,
                    const std::vector<bool>           &is_seeded,
                    const std::vector<Tensor<2, dim>> &half_edges)
    {
      std::vector<InitialDomain<dim>> domains;
      domains.reserve(points.n_local());
      for (const auto &in_cell : points.cells())
        {
          const auto vertices = vertices_of<dim>(in_cell.cell);
          double     filled   = 0;
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            filled += points.volume(p);
          const double whole_cell = volume<dim>(vertices);
          // The Gauss points of a full skewed cell have not the volumes of
          // their sub-cells; only their sum is right.
          const bool is_full =
            in_cell.last - in_cell.first == seeder.n_sub_cells() &&
            std::abs(filled - whole_cell) < 1e-12 * whole_cell;
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            if (is_seeded[points.body(p)])
              {
                const auto sub_cell =
                  seeder.sub_cell_around(vertices,
                                         points.reference_position(p));
                const double whole = volume<dim>(sub_cell);
                if (is_full ||
                    std::abs(points.volume(p) - whole) < 1e-12 * whole)
                  domains.push_back({sub_cell, false});
                else
                  domains.push_back({domain_in_sub_cell<dim>(sub_cell,
                                                             points.position(p),
                                                             points.volume(p)),
                                     true});
              }
            else
              {
                Tensor<2, dim> r = half_edges[points.body(p)];
                if (r.norm() == 0)
                  for (unsigned int d = 0; d < dim; ++d)
                    r[d][d] = 0.5 * std::pow(points.volume(p), 1. / dim);
                domains.push_back(
                  {parallelepiped(points.position(p), r), false});
              }
        }
      return domains;
    }



    namespace
    {
      /** Ids of the points over all ranks, sorted. */
      template <int dim>
      std::vector<unsigned int>
      sorted_ids(const PointSet<dim>             &points,
                 const std::vector<unsigned int> &local,
                 const MPI_Comm                  &communicator)
      {
        std::vector<unsigned int> ids;
        for (const unsigned int p : local)
          ids.push_back(points.id(p));
        std::vector<unsigned int> all;
        for (const auto &of_rank :
             Utilities::MPI::all_gather(communicator, ids))
          all.insert(all.end(), of_rank.begin(), of_rank.end());
        std::sort(all.begin(), all.end());
        return all;
      }
    } // namespace



    template <int dim>
    std::array<CellVertices<dim>, 2>
    halves_of(const CellVertices<dim> &corners, const unsigned int d)
    {
      std::array<CellVertices<dim>, 2> halves{{corners, corners}};
      for (unsigned int c = 0; c < corners.size(); ++c)
        if (!((c >> d) & 1))
          {
            const unsigned int opposite = c | (1u << d);
            const Point<dim>   middle =
              corners[c] + 0.5 * (corners[opposite] - corners[c]);
            halves[0][opposite] = halves[1][c] = middle;
          }
      return halves;
    }



    template <int dim>
    bool
    split_points(
      PointSet<dim>                                           &points,
      const std::function<unsigned int(const unsigned int p)> &split_direction,
      const std::function<Halves<dim>(const unsigned int lower,
                                      const unsigned int upper,
                                      const unsigned int d)>  &halve)
    {
      const MPI_Comm communicator =
        points.mesh().triangulation().get_communicator();
      const PointFields &fields = points.fields();
      const auto         v_0    = fields.find(FieldNames<dim>::initial_volume);
      const auto         F = fields.find(FieldNames<dim>::deformation_gradient);
      const auto  F_0 = fields.find(FieldNames<dim>::deformation_gradient_then);
      const auto  v   = fields.find(FieldNames<dim>::velocity);
      const auto  G   = fields.find(FieldNames<dim>::velocity_gradient);
      const auto &u   = points.displacement_field();
      unsigned int next_id = points.next_id();

      std::vector<unsigned int> candidates(points.n_local());
      std::iota(candidates.begin(), candidates.end(), 0u);
      constexpr unsigned int max_rounds = 40;
      for (unsigned int round = 0; round < max_rounds; ++round)
        {
          std::vector<unsigned int> wholes, directions;
          for (const unsigned int p : candidates)
            {
              const unsigned int d = split_direction(p);
              if (d == dim)
                continue;
              wholes.push_back(p);
              directions.push_back(d);
            }
          const auto ids = sorted_ids(points, wholes, communicator);
          if (ids.empty())
            return round > 0;

          std::vector<typename PointSet<dim>::Copy> copies;
          for (const unsigned int p : wholes)
            {
              const unsigned int place =
                std::lower_bound(ids.begin(), ids.end(), points.id(p)) -
                ids.begin();
              copies.push_back({p, next_id + place, points.position(p)});
            }
          const unsigned int first_half = points.n_local();
          points.insert_copies(copies);
          for (unsigned int i = 0; i < wholes.size(); ++i)
            {
              const unsigned int lower = wholes[i], upper = first_half + i;
              const Halves<dim>  halves = halve(lower, upper, directions[i]);
              const auto         become = [&](const unsigned int    p,
                                      const Tensor<1, dim> &offset,
                                      const double          share) {
                double *values = points.values(p);
                points.set_position(p, points.position(p) + offset);
                // Of the half's own place.
                if (F.exists())
                  {
                    Tensor<1, dim> then = invert(F(values)) * offset;
                    if (F_0.exists() && F_0(values).norm() > 0)
                      then = F_0(values) * then;
                    u.store(u(values) + offset - then, values);
                  }
                if (G.exists())
                  v.store(v(values) + G(values) * offset, values);
                points.set_volume(p, share * points.volume(p));
                if (v_0.exists())
                  v_0.store(share * v_0(values), values);
              };
              become(lower, halves.lower, 1 - halves.upper_share);
              become(upper, halves.upper, halves.upper_share);
            }
          next_id += ids.size();
          candidates = wholes;
          candidates.resize(2 * wholes.size());
          std::iota(candidates.begin() + wholes.size(),
                    candidates.end(),
                    first_half);
        }
      throw ComputationError(
        "splitting the domains of points does not end; they are too long, or "
        "not numbers any more");
    }



#define INSTANTIATE(dim)                                        \
  template decltype(name_of<dim>)         name_of<dim>;         \
  template decltype(average_weights<dim>) average_weights<dim>; \
  template decltype(parallelepiped<dim>)  parallelepiped<dim>;  \
  template decltype(initial_domains<dim>) initial_domains<dim>; \
  template decltype(halves_of<dim>)       halves_of<dim>;       \
  template decltype(split_points<dim>)    split_points<dim>;
    INSTANTIATE(2)
    INSTANTIATE(3)
#undef INSTANTIATE
  } // namespace DomainTools
} // namespace moraine
