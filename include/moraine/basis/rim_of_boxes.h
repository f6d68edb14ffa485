// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_rim_of_boxes_h
#define moraine_basis_rim_of_boxes_h

#include <moraine/basis/basis.h>
#include <moraine/geometry/shape.h>

#include <vector>

namespace moraine
{
  /**
   * The rim of a body whose points are given: the parts of the faces of its
   * points' boxes with no other box of it within a cell in front of them. A gap
   * between boxes adds no rim. The same on
   * all ranks, in the order of ids.
   *
   * @param points all of them
   * @param basis has their boxes, or else they are cubes of the points' volumes
   * @param body its number
   */
  template <int dim>
  std::vector<typename CarriedPlaces<dim>::Place>
  rim_of_boxes(const PointSet<dim> &points,
               const Basis<dim>    &basis,
               const unsigned int   body);
} // namespace moraine

#endif
