// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/domain_tools.h>

#include <moraine/core/exceptions.h>

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



    std::optional<unsigned int>
    find_field(const PointFields &fields, const std::string &name)
    {
      for (const auto &field : fields.fields())
        if (field.name == name)
          return field.offset;
      return {};
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
      /** The sub-cell as it is, or its shape with the point's volume. */
      template <int dim>
      CellVertices<dim>
      domain_in_sub_cell(const CellVertices<dim> &sub_cell,
                         const bool               is_whole,
                         const Point<dim>        &x,
                         const double             volume)
      {
        double         w[1 << dim];
        Tensor<1, dim> g[1 << dim];
        const double   whole = average_weights<dim>(sub_cell, w, g);
        if (is_whole || std::abs(volume - whole) < 1e-12 * whole)
          return sub_cell;
        Point<dim> centroid;
        for (unsigned int c = 0; c < sub_cell.size(); ++c)
          centroid += w[c] * sub_cell[c];
        const double      factor = std::pow(volume / whole, 1. / dim);
        CellVertices<dim> corners;
        for (unsigned int c = 0; c < sub_cell.size(); ++c)
          corners[c] = x + factor * (sub_cell[c] - centroid);
        return corners;
      }
    } // namespace



    template <int dim>
    std::vector<CellVertices<dim>>
    initial_domains(const PointSet<dim>               &points,
                    const CellSeeder<dim>             &seeder,
                    const std::vector<bool>           &is_seeded,
                    const std::vector<Tensor<2, dim>> &half_edges)
    {
      std::vector<CellVertices<dim>> domains;
      domains.reserve(points.n_local());
      for (const auto &in_cell : points.cells())
        {
          const auto vertices = vertices_of<dim>(in_cell.cell);
          double     filled   = 0;
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            filled += points.volume(p);
          double         w[1 << dim];
          Tensor<1, dim> g[1 << dim];
          const double   volume = average_weights<dim>(vertices, w, g);
          // The Gauss points of a full cell askew have not the volumes of
          // their sub-cells; only their sum is right.
          const bool is_full =
            in_cell.last - in_cell.first == seeder.n_sub_cells() &&
            std::abs(filled - volume) < 1e-12 * volume;
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            if (is_seeded[points.body(p)])
              domains.push_back(domain_in_sub_cell<dim>(
                seeder.sub_cell_around(vertices, points.reference_position(p)),
                is_full,
                points.position(p),
                points.volume(p)));
            else
              {
                Tensor<2, dim> r = half_edges[points.body(p)];
                if (r.norm() == 0)
                  for (unsigned int d = 0; d < dim; ++d)
                    r[d][d] = 0.5 * std::pow(points.volume(p), 1. / dim);
                domains.push_back(parallelepiped(points.position(p), r));
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



      template <int dim>
      unsigned int
      next_free_id(const PointSet<dim> &points, const MPI_Comm &communicator)
      {
        unsigned int next = 0;
        for (unsigned int p = 0; p < points.n_local(); ++p)
          next = std::max(next, points.id(p) + 1);
        return Utilities::MPI::max(next, communicator);
      }
    } // namespace



    template <int dim>
    bool
    split_points(
      PointSet<dim>                                           &points,
      const std::function<unsigned int(const unsigned int p)> &split_direction,
      const std::function<Tensor<1, dim>(const unsigned int p,
                                         const unsigned int d)> &halve)
    {
      const MPI_Comm communicator =
        points.mesh().triangulation().get_communicator();
      const auto volume         = find_field(points.fields(), "volume");
      const auto initial_volume = find_field(points.fields(), "initial_volume");
      unsigned int next_id      = next_free_id(points, communicator);

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

          std::vector<typename PointSet<dim>::Copy> halves;
          for (unsigned int i = 0; i < wholes.size(); ++i)
            {
              const unsigned int   p      = wholes[i];
              const Tensor<1, dim> offset = halve(p, directions[i]);
              points.values(p)[*volume] *= 0.5;
              if (initial_volume)
                points.values(p)[*initial_volume] *= 0.5;
              const unsigned int place =
                std::lower_bound(ids.begin(), ids.end(), points.id(p)) -
                ids.begin();
              halves.push_back(
                {p, next_id + place, points.position(p) + offset});
              points.set_position(p, points.position(p) - offset);
            }
          const unsigned int first_half = points.n_local();
          points.insert_copies(halves);
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



#define INSTANTIATE(dim)                                                         \
  template std::string       name_of(const PointSet<dim> &, const unsigned int); \
  template double            average_weights<dim>(const CellVertices<dim> &,     \
                                       double *,                      \
                                       Tensor<1, dim> *);             \
  template CellVertices<dim> parallelepiped(const Point<dim> &,                  \
                                            const Tensor<2, dim> &);             \
  template std::vector<CellVertices<dim>> initial_domains(                       \
    const PointSet<dim> &,                                                       \
    const CellSeeder<dim> &,                                                     \
    const std::vector<bool> &,                                                   \
    const std::vector<Tensor<2, dim>> &);                                        \
  template bool split_points(                                                    \
    PointSet<dim> &,                                                             \
    const std::function<unsigned int(const unsigned int)> &,                     \
    const std::function<Tensor<1, dim>(const unsigned int,                       \
                                       const unsigned int)> &);
    INSTANTIATE(2)
    INSTANTIATE(3)
#undef INSTANTIATE
  } // namespace DomainTools
} // namespace moraine
