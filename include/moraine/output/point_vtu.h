// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_point_vtu_h
#define moraine_output_point_vtu_h

#include <moraine/basis/basis.h>
#include <moraine/output/vtu_file.h>
#include <moraine/points/point_set.h>

namespace moraine
{
  /**
   * Write the points of one step as one VTU file, whatever the number of ranks.
   * Collective. The file appears only when it is complete.
   *
   * Every field of the layout is written under its name and with its unit: one
   * number as a scalar, dim numbers as a vector, a stress-like field as a
   * symmetric 3x3 tensor (in 2D with its zz component), anything else as
   * scalars name_0, name_1, .... Added are
   *
   * | field            | meaning                                            |
   * |------------------|----------------------------------------------------|
   * | id               | number of the point                                |
   * | von_mises_stress | @f$\sqrt{3/2\, s:s}@f$, @f$s@f$ the deviator       |
   * | mean_stress      | @f$(\sigma_{xx}+\sigma_{yy}+\sigma_{zz})/3@f$      |
   * | smoothed_mean_stress | that of smoothed_mean_stress()                 |
   * | effective_stress | that of effective_stress(), if a material is undrained
   * |
   *
   * Points are ordered by id within the part of each rank. Positions are
   * stored in double, other numbers in single precision; ids above 16 777 216
   * are rounded.
   *
   * @throws InputError naming the file if it cannot be written.
   */
  template <int dim>
  void
  write_point_vtu(const PointSet<dim> &points, const VtuTarget &target);

  /**
   * Write the domains of the points of one step as quadrilaterals or hexahedra
   * in one VTU file, each with the fields of its point (write_point_vtu()).
   * The basis has to have domains. Collective. The file appears only
   * when it is complete.
   *
   * @throws InputError naming the file if it cannot be written.
   */
  template <int dim>
  void
  write_domain_vtu(const Basis<dim>    &basis,
                   const PointSet<dim> &points,
                   const VtuTarget     &target);
} // namespace moraine

#endif
