// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/stress_signs.h>

#include <moraine/points/linear_fit.h>

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
    /** What has to be filled of a cell that is fitted, and of one whose stress
     * does not depend on the cut. */
    constexpr double filled_to_fit = 0.75;
    constexpr double filled_half   = 0.5;

    /** Of points in a unit cell, in each direction, squared. */
    constexpr double least_spread = 0.01;



    /** Mean stress in a unit cell: volume of what it is fitted to (0: none),
     * value in the middle and gradient. */
    template <int dim>
    struct Fit
    {
      double         volume = 0;
      double         middle = 0;
      Tensor<1, dim> gradient;

      double
      at(const Point<dim> &xi) const
      {
        return middle + gradient * (xi - unit_middle());
      }

      static Point<dim>
      unit_middle()
      {
        Point<dim> xi;
        for (unsigned int d = 0; d < dim; ++d)
          xi[d] = 0.5;
        return xi;
      }
    };



    template <int dim>
    Fit<dim>
    fit_mean_stress(const PointSet<dim>                      &points,
                    const typename PointSet<dim>::CellPoints &in_cell)
    {
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        if (points.body(p) != points.body(in_cell.first))
          return {};
      const LinearFit<dim, double> linear(
        points,
        in_cell,
        [&](const unsigned int p) {
          return points.reference_position(p) - Fit<dim>::unit_middle();
        },
        [&](const unsigned int p) {
          return trace(points.stress_field()(points.values(p))) / 3;
        },
        least_spread);
      if (!linear.is_complete())
        return {};
      Fit<dim> fit;
      fit.volume = linear.volume();
      fit.middle = linear.at(Tensor<1, dim>());
      for (unsigned int d = 0; d < dim; ++d)
        fit.gradient[d] = linear.gradient()[d];
      return fit;
    }



    /** Between the cells of this rank and those after them: the squares of
     * jumps and of steps times volumes, and the sum of these volumes. */
    template <int dim>
    std::array<double, 3>
    squares_of_jumps(const GridSpace<dim>      &space,
                     const std::vector<double> &fits)
    {
      const auto fit_of = [&](const auto &cell) {
        const double *values = &fits[(dim + 2) * cell->active_cell_index()];
        Fit<dim>      fit;
        fit.volume = values[0];
        fit.middle = values[1];
        std::copy_n(values + 2, dim, fit.gradient.begin_raw());
        return fit;
      };
      std::array<double, 3> sums{};
      for (const auto &cell :
           space.mesh().triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            {
              if (cell->at_boundary(f) || !cell->neighbor(f)->is_active() ||
                  cell->neighbor(f)->active_cell_index() <
                    cell->active_cell_index())
                continue;
              const Fit<dim> here  = fit_of(cell),
                             there = fit_of(cell->neighbor(f));
              if (here.volume == 0 || there.volume == 0)
                continue;
              const auto middle = [](const unsigned int face) {
                Point<dim> xi = Fit<dim>::unit_middle();
                xi[face / 2]  = face % 2;
                return xi;
              };
              const double jump =
                here.at(middle(f)) -
                there.at(middle(cell->neighbor_of_neighbor(f)));
              const double step   = here.middle - there.middle;
              const double volume = here.volume + there.volume;
              sums[0] += volume * jump * jump;
              sums[1] += volume * step * step;
              sums[2] += volume;
            }
      return sums;
    }
  } // namespace



  template <int dim>
  StressSigns
  stress_signs(const GridSpace<dim> &space, const PointSet<dim> &points)
  {
    std::vector<double> fits((dim + 2) *
                               space.mesh().triangulation().n_active_cells(),
                             0.);
    double              squares = 0, volume = 0;
    StressSigns         signs;
    for (const auto &in_cell : points.cells())
      {
        double largest = 0, filled = 0;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          {
            const auto   stress = points.stress_field()(points.values(p));
            const double v      = points.volume(p);
            squares += v * deviator(stress).norm() * deviator(stress).norm();
            filled += v;
            largest = std::max(largest, stress.norm());
          }
        volume += filled;
        filled /= volume_of_cell(in_cell.cell);
        double &of_kind =
          filled < filled_half ? signs.in_cuts : signs.elsewhere;
        of_kind = std::max(of_kind, largest);
        if (filled < filled_to_fit)
          continue;
        const Fit<dim> fit = fit_mean_stress(points, in_cell);
        double *to = &fits[(dim + 2) * in_cell.cell->active_cell_index()];
        to[0]      = fit.volume;
        to[1]      = fit.middle;
        std::copy_n(fit.gradient.begin_raw(), dim, to + 2);
      }
    const MPI_Comm communicator = space.communicator();
    Utilities::MPI::sum(fits, communicator, fits);
    std::array<double, 3> sums = squares_of_jumps(space, fits);
    for (double &sum : sums)
      sum = Utilities::MPI::sum(sum, communicator);
    if (sums[2] > 0)
      {
        signs.jump = std::sqrt(sums[0] / sums[2]);
        signs.step = std::sqrt(sums[1] / sums[2]);
      }
    volume = Utilities::MPI::sum(volume, communicator);
    signs.deviatoric =
      std::sqrt(Utilities::MPI::sum(squares, communicator) / volume);
    signs.in_cuts   = Utilities::MPI::max(signs.in_cuts, communicator);
    signs.elsewhere = Utilities::MPI::max(signs.elsewhere, communicator);
    return signs;
  }



  template decltype(stress_signs<2>) stress_signs<2>;
  template decltype(stress_signs<3>) stress_signs<3>;
} // namespace moraine
