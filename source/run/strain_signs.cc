// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/strain_signs.h>

#include <moraine/points/linear_fit.h>

#include <deal.II/base/mpi.h>

#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What small strain takes for small, of the mean over a body: stress and
     * force over area differ by as much. */
    constexpr double told_strain = 0.05;

    /** Of points in a cell of size 1, in each direction, squared. */
    constexpr double least_spread_of_places = 0.01;
  } // namespace



  template <int dim>
  std::vector<double>
  mean_strains(const PointSet<dim> &points,
               const double         cell_size,
               const unsigned int   n_bodies,
               const MPI_Comm      &communicator)
  {
    std::vector<double> sums(2 * n_bodies, 0.);
    const auto          u = points.displacement_field();
    for (const auto &in_cell : points.cells())
      {
        const unsigned int b         = points.body(in_cell.first);
        bool               is_of_one = true;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          is_of_one = is_of_one && points.body(p) == b;
        if (!is_of_one)
          continue;
        const LinearFit<dim, Tensor<1, dim>> linear(
          points,
          in_cell,
          [&](const unsigned int p) {
            return Point<dim>(points.position(p) - u(points.values(p)));
          },
          [&](const unsigned int p) {
            return Tensor<1, dim>(u(points.values(p)));
          },
          least_spread_of_places * cell_size * cell_size);
        if (!linear.is_complete())
          continue;
        Tensor<2, dim> gradient;
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d] = linear.gradient()[d];
        sums[b] += linear.volume() * symmetrize(gradient).norm();
        sums[n_bodies + b] += linear.volume();
      }
    Utilities::MPI::sum(sums, communicator, sums);
    for (unsigned int b = 0; b < n_bodies; ++b)
      sums[b] = sums[n_bodies + b] > 0 ? sums[b] / sums[n_bodies + b] : 0.;
    sums.resize(n_bodies);
    return sums;
  }



  template <int dim>
  std::vector<double>
  mean_strains(const Model<dim> &model)
  {
    return mean_strains(*model.points,
                        model.mesh->cell_size(),
                        model.body_names.size(),
                        model.space->communicator());
  }



  template <int dim>
  std::vector<std::string>
  doubts_of_strain(const Model<dim> &model)
  {
    // Who lets nothing move wants what is linear.
    if (model.state->strain_measure() != StrainMeasure::small ||
        model.state->mesh_after_step() == MeshAfterStep::keep)
      return {};
    const std::vector<double> strains = mean_strains(model);
    std::vector<std::string>  doubts;
    for (unsigned int b = 0; b < strains.size(); ++b)
      if (strains[b] > told_strain)
        {
          std::ostringstream text;
          text
            << "body '" << model.body_names[b] << "' is strained by "
            << std::setprecision(2) << 100 * strains[b] << " % in the mean"
            << (model.points->forgotten_displacement() > 0 ?
                  " since displacements were reset" :
                  "")
            << ", and 'Strain = small' takes lengths and areas "
               "of the start where points move: stresses, and forces by "
               "them, differ by about as much; 'Strain = finite' knows of it";
          doubts.push_back(text.str());
        }
    return doubts;
  }



  template std::vector<double>
  mean_strains(const PointSet<2> &,
               const double,
               const unsigned int,
               const MPI_Comm &);
  template std::vector<double>
  mean_strains(const PointSet<3> &,
               const double,
               const unsigned int,
               const MPI_Comm &);
  template std::vector<double>
  mean_strains(const Model<2> &);
  template std::vector<double>
  mean_strains(const Model<3> &);
  template std::vector<std::string>
  doubts_of_strain(const Model<2> &);
  template std::vector<std::string>
  doubts_of_strain(const Model<3> &);
} // namespace moraine
