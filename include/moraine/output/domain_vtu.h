// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_domain_vtu_h
#define moraine_output_domain_vtu_h

#include <moraine/basis/basis.h>
#include <moraine/core/units.h>

#include <string>

namespace moraine
{
  /**
   * Write the domains of the points of one step as quadrilaterals or hexahedra
   * in one VTU file, each with the fields of its point (write_point_vtu()).
   * The basis has to have domains. Collective. The file appears at @p path only
   * when it is complete.
   *
   * @throws InputError naming the file if it cannot be written.
   */
  template <int dim>
  void
  write_domain_vtu(const Basis<dim>    &basis,
                   const PointSet<dim> &points,
                   const std::string   &path,
                   const double         time,
                   const unsigned int   step,
                   const Units         &units = Units());
} // namespace moraine

#endif
