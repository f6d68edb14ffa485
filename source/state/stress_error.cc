// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/stress_error.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    using Stress                     = SymmetricTensor<2, 3>;
    constexpr unsigned int n_entries = Stress::n_independent_components;

    /** Of the points around a vertex along a direction, the mean of squares
     * over that of the shortest edge of a cell: slivers are not continued. */
    constexpr double least_spread_around = 0.01;

    /** Least share of a vertex in its cell: points on the face opposite. */
    constexpr double least_share_of_vertex = 1e-3;

    /** Next to no stress, over the shear modulus. */
    constexpr double next_to_no_stress = 1e-9;



    /** What the linear function around a vertex is found from, as plain numbers
     * that ranks add up: v, v x, v x x, and of each entry v sigma, v sigma x.
     */
    template <int dim>
    constexpr unsigned int n_sums = 1 + dim + dim *dim + n_entries *(1 + dim);

    template <int dim>
    void
    add_point(const double          v,
              const Tensor<1, dim> &x,
              const Stress         &sigma,
              double               *to)
    {
      *to++ += v;
      for (unsigned int d = 0; d < dim; ++d)
        *to++ += v * x[d];
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          *to++ += v * x[d] * x[e];
      for (unsigned int c = 0; c < n_entries; ++c)
        {
          const double entry = v * sigma.access_raw_entry(c);
          *to++ += entry;
          for (unsigned int d = 0; d < dim; ++d)
            *to++ += entry * x[d];
        }
    }



    /** Stress around a vertex, linear along directions in which its points are
     * apart. */
    template <int dim>
    class StressAround
    {
    public:
      StressAround(const double *sums, const double edge)
        : v(sums[0])
      {
        if (!(v > 0))
          return;
        for (unsigned int d = 0; d < dim; ++d)
          centre[d] = sums[1 + d] / v;
        SymmetricTensor<2, dim> spread;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d; e < dim; ++e)
            spread[d][e] =
              sums[1 + dim + dim * d + e] / v - centre[d] * centre[e];

        std::array<Stress, dim> covariance;
        const double           *entry = sums + 1 + dim + dim * dim;
        for (unsigned int c = 0; c < n_entries; ++c, entry += 1 + dim)
          {
            mean.access_raw_entry(c) = entry[0] / v;
            for (unsigned int d = 0; d < dim; ++d)
              covariance[d].access_raw_entry(c) =
                entry[1 + d] / v - centre[d] * mean.access_raw_entry(c);
          }
        for (const auto &[square, direction] : eigenvectors(spread))
          if (square > least_spread_around * edge * edge)
            for (unsigned int d = 0; d < dim; ++d)
              for (unsigned int e = 0; e < dim; ++e)
                slope[d] +=
                  direction[d] * direction[e] / square * covariance[e];
      }

      double
      volume() const
      {
        return v;
      }

      Stress
      at(const Tensor<1, dim> &x) const
      {
        Stress result = mean;
        for (unsigned int d = 0; d < dim; ++d)
          result += (x[d] - centre[d]) * slope[d];
        return result;
      }

    private:
      double                  v;
      Tensor<1, dim>          centre;
      Stress                  mean;
      std::array<Stress, dim> slope;
    };



    /** Numbers for the vertices of cells with points on any rank, in the order
     * of the mesh. Collective. */
    template <int dim>
    std::vector<unsigned int>
    numbers_of_vertices(const PointSet<dim> &points, unsigned int &n)
    {
      const auto               &tria = points.mesh().triangulation();
      std::vector<unsigned int> numbers(tria.n_vertices(), 0);
      for (const auto &in_cell : points.cells())
        for (const unsigned int a : GeometryInfo<dim>::vertex_indices())
          numbers[in_cell.cell->vertex_index(a)] = 1;
      Utilities::MPI::max(numbers, tria.get_communicator(), numbers);
      n = 0;
      for (unsigned int &number : numbers)
        if (number > 0)
          number = n++;
      return numbers;
    }



    /** Error and size of the stresses of a body, squared and integrated. */
    template <int dim>
    class BodyError
    {
    public:
      BodyError(const PointSet<dim>             &points,
                const unsigned int               body,
                const std::vector<unsigned int> &numbers,
                const unsigned int               n_vertices)
        : points(points)
        , body(body)
        , numbers(numbers)
        , sums(n_sums<dim> * n_vertices, 0.)
      {
        for (const auto &in_cell : points.cells())
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            if (points.body(p) == body)
              for (const unsigned int a : GeometryInfo<dim>::vertex_indices())
                add_point(points.volume(p),
                          from_vertex(p, in_cell, a),
                          stress(p),
                          &sums[n_sums<dim> * number(in_cell, a)]);
        Utilities::MPI::sum(sums,
                            points.mesh().triangulation().get_communicator(),
                            sums);
      }

      void
      add(const LameConstants &C, double &of_error, double &of_stress) const
      {
        std::vector<StressAround<dim>> around;
        for (const auto &in_cell : points.cells())
          {
            around.clear();
            const double edge = in_cell.cell->minimum_vertex_distance();
            for (const unsigned int a : GeometryInfo<dim>::vertex_indices())
              around.emplace_back(&sums[n_sums<dim> * number(in_cell, a)],
                                  edge);
            for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
              if (points.body(p) == body)
                {
                  of_error += points.volume(p) *
                              energy(stress(p) - smooth(p, in_cell, around), C);
                  of_stress += points.volume(p) * energy(stress(p), C);
                }
          }
      }

    private:
      using CellPoints = typename PointSet<dim>::CellPoints;

      unsigned int
      number(const CellPoints &in_cell, const unsigned int a) const
      {
        return numbers[in_cell.cell->vertex_index(a)];
      }

      Stress
      stress(const unsigned int p) const
      {
        return points.stress_field()(points.values(p));
      }

      Tensor<1, dim>
      from_vertex(const unsigned int p,
                  const CellPoints  &in_cell,
                  const unsigned int a) const
      {
        return points.position(p) - in_cell.cell->vertex(a);
      }

      Stress
      smooth(const unsigned int                    p,
             const CellPoints                     &in_cell,
             const std::vector<StressAround<dim>> &around) const
      {
        Stress sum;
        double weights = 0;
        for (const unsigned int a : GeometryInfo<dim>::vertex_indices())
          {
            const double weight =
              std::max(least_share_of_vertex,
                       GeometryInfo<dim>::d_linear_shape_function(
                         points.reference_position(p), a)) *
              std::pow(around[a].volume(), 3);
            weights += weight;
            sum += weight * around[a].at(from_vertex(p, in_cell, a));
          }
        return sum / weights;
      }

      /** Twice the elastic energy by volume. */
      static double
      energy(const Stress &sigma, const LameConstants &C)
      {
        const double p = trace(sigma) / 3;
        const Stress s = deviator(sigma);
        return s * s / (2 * C.mu) + p * p / (C.lambda + 2. / 3 * C.mu);
      }

      const PointSet<dim>             &points;
      const unsigned int               body;
      const std::vector<unsigned int> &numbers;
      std::vector<double>              sums;
    };
  } // namespace



  template <int dim>
  std::optional<double>
  estimated_stress_error(const PointSet<dim>              &points,
                         const std::vector<LameConstants> &moduli)
  {
    const MPI_Comm communicator =
      points.mesh().triangulation().get_communicator();
    unsigned int                    n_vertices;
    const std::vector<unsigned int> numbers =
      numbers_of_vertices(points, n_vertices);

    std::array<double, 3> totals{}; // of the error, of stress, next to none
    for (unsigned int body = 0; body < moduli.size(); ++body)
      BodyError<dim>(points, body, numbers, n_vertices)
        .add(moduli[body], totals[0], totals[1]);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      totals[2] += points.volume(p) * moduli[points.body(p)].mu *
                   next_to_no_stress * next_to_no_stress;
    for (double &total : totals)
      total = Utilities::MPI::sum(total, communicator);
    if (!(totals[1] > totals[2]))
      return {};
    return std::sqrt(totals[0] / totals[1]);
  }



  template decltype(estimated_stress_error<2>) estimated_stress_error<2>;
  template decltype(estimated_stress_error<3>) estimated_stress_error<3>;
} // namespace moraine
