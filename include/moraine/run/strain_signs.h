// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_strain_signs_h
#define moraine_run_strain_signs_h

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * @f$|\varepsilon| = \sqrt{\varepsilon : \varepsilon}@f$ of the displacements
   * of points, of the linear function of where they were at first that fits
   * best in each cell of one body: the mean over each body. Cells whose points
   * are not spread in all directions do not count. Collective.
   *
   * @param points where they are now, with displacements
   * @param cell_size of the mesh
   * @param n_bodies of the scene
   * @param communicator of the ranks that have the points
   */
  template <int dim>
  std::vector<double>
  mean_strains(const PointSet<dim> &points,
               const double         cell_size,
               const unsigned int   n_bodies,
               const MPI_Comm      &communicator);

  /** The same of all bodies of a model. */
  template <int dim>
  std::vector<double>
  mean_strains(const Model<dim> &model);

  /** That small strain was taken for what is none: for each body that is
   * strained by more than 5 % while points move, since displacements count.
   * Collective. */
  template <int dim>
  std::vector<std::string>
  doubts_of_strain(const Model<dim> &model);
} // namespace moraine

#endif
