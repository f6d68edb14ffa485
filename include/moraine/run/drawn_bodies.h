// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_drawn_bodies_h
#define moraine_run_drawn_bodies_h

#include <moraine/run/model.h>

#include <vector>

namespace moraine
{
  /** Whether no body comes from a file of points. */
  template <int dim>
  bool
  are_drawn(const std::vector<Body<dim>> &bodies);

  /** Whether a body that is there has been drawn at @p x; none of @p model may
   * come from a file of points. */
  template <int dim>
  bool
  in_a_body(const dealii::Point<dim> &x, const Model<dim> &model);

  /** Where the surface of @p boundary, as it is at the start of a step, is
   * beside a @p place that stands for a piece of it: the mean of a curve lies
   * off it. */
  template <int dim>
  SurfacePoint<dim>
  foot_of(const BoundaryPoint<dim>    &place,
          const ImplicitBoundary<dim> &boundary);
} // namespace moraine

#endif
