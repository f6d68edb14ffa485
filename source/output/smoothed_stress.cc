// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/smoothed_stress.h>

#include <moraine/output/stress_rows.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * Means over the vertices of the mesh: for each n_values numbers, and after
     * them the volume they are a mean over, 0 where there is none. Collective.
     * @param takes_part whether point p does
     * @param add adds v times the numbers of point p to those at a place
     */
    template <int dim, typename TakesPart, typename Add>
    std::vector<double>
    vertex_means(const PointSet<dim> &points,
                 const unsigned int   n_values,
                 const TakesPart     &takes_part,
                 const Add           &add)
    {
      const auto         &tria   = points.mesh().triangulation();
      const unsigned int  stride = n_values + 1;
      std::vector<double> sums(stride * tria.n_vertices(), 0.);
      for (const auto &in_cell : points.cells())
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          if (takes_part(p))
            for (const unsigned int a : GeometryInfo<dim>::vertex_indices())
              {
                const double share =
                  points.volume(p) * GeometryInfo<dim>::d_linear_shape_function(
                                       points.reference_position(p), a);
                double *sum = &sums[stride * in_cell.cell->vertex_index(a)];
                add(share, p, sum);
                sum[n_values] += share;
              }
      Utilities::MPI::sum(sums, tria.get_communicator(), sums);
      for (auto sum = sums.begin(); sum != sums.end(); sum += stride)
        if (sum[n_values] > 0)
          for (unsigned int c = 0; c < n_values; ++c)
            sum[c] /= sum[n_values];
      return sums;
    }



    template <int dim>
    unsigned int
    n_bodies(const PointSet<dim> &points)
    {
      unsigned int n = 0;
      for (unsigned int p = 0; p < points.n_local(); ++p)
        n = std::max(n, points.body(p) + 1);
      return Utilities::MPI::max(
        n, points.mesh().triangulation().get_communicator());
    }
  } // namespace



  template <int dim>
  SmoothedStress<dim>::SmoothedStress(const PointSet<dim> &points,
                                      const bool           effective)
    : means(vertex_means(
        points,
        n_stress_components<dim>,
        [](const unsigned int) { return true; },
        [&](const double v, const unsigned int p, double *sum) {
          const double *sigma = points.values(p) + points.stress_offset();
          for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
            sum[c] += v * sigma[c];
          const double pressure = effective ? excess_pressure(points, p) : 0.;
          for (unsigned int c = 0; c < 3 && effective; ++c)
            sum[c] += v * pressure;
        }))
  {}



  template <int dim>
  std::optional<typename SmoothedStress<dim>::Stress>
  SmoothedStress<dim>::at_vertex(const unsigned int vertex) const
  {
    const auto at = means.begin() + (n_stress_components<dim> + 1) * vertex;
    if (!(at[n_stress_components<dim>] > 0))
      return {};
    Stress stress;
    std::copy_n(at, n_stress_components<dim>, stress.begin());
    return stress;
  }



  template <int dim>
  std::vector<double>
  smoothed_mean_stress(const PointSet<dim> &points)
  {
    std::vector<double> values(points.n_local());
    for (unsigned int body = 0; body < n_bodies(points); ++body)
      {
        const auto in_body = [&](const unsigned int p) {
          return points.body(p) == body;
        };
        const std::vector<double> means = vertex_means(
          points,
          1,
          in_body,
          [&points](const double v, const unsigned int p, double *sum) {
            *sum += v * trace(points.stress_field()(points.values(p))) / 3;
          });
        for (const auto &in_cell : points.cells())
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            if (in_body(p))
              for (const unsigned int a : GeometryInfo<dim>::vertex_indices())
                values[p] += GeometryInfo<dim>::d_linear_shape_function(
                               points.reference_position(p), a) *
                             means[2 * in_cell.cell->vertex_index(a)];
      }
    return values;
  }



  template class SmoothedStress<2>;
  template class SmoothedStress<3>;
  template std::vector<double>
  smoothed_mean_stress(const PointSet<2> &);
  template std::vector<double>
  smoothed_mean_stress(const PointSet<3> &);
} // namespace moraine
