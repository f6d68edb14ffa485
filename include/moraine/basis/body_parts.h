// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_body_parts_h
#define moraine_basis_body_parts_h

#include <moraine/basis/basis.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

#include <vector>

namespace moraine
{
  /** Points of a body that hang together. */
  template <int dim>
  struct BodyPart
  {
    double             volume = 0; ///< [length^dim]
    dealii::Point<dim> centre;     ///< of the volume
  };

  /**
   * The parts of each body, the largest first. Two points hang together if they
   * share a node that both feel: one whose gradient at the point is more than
   * 1e-3 of the largest there, so that a box of GIMP that overlaps a cell by
   * less holds nothing. A body whose points drift apart until a cell between
   * them is empty falls into parts and carries no force across (numerical
   * fracture).
   *
   * Call it after Basis::batch_points(). Collective, the same on all ranks.
   */
  template <int dim>
  std::vector<std::vector<BodyPart<dim>>>
  parts_of_bodies(const GridSpace<dim> &space,
                  const PointSet<dim>  &points,
                  const Basis<dim>     &basis,
                  const unsigned int    n_bodies);
} // namespace moraine

#endif
