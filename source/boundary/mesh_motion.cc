// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/mesh_motion.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Point<dim>
  MeshMotion<dim>::Master::map(const Point<dim> &x,
                               const double      t_start,
                               const double      t_end) const
  {
    Point<dim> y = motion.pose(t_end).map(motion.pose(t_start).inverse(x));
    if (displacement)
      y += displacement(t_end) - displacement(t_start);
    return y;
  }



  template <int dim>
  MeshMotion<dim>::MeshMotion(const Master &master)
    : first(master)
  {}



  template <int dim>
  MeshMotion<dim>::MeshMotion(const Master &A,
                              const Master &B,
                              const double  t_0)
    : first(A)
    , second(B)
    , t_0(t_0)
    , direction(B.place - A.place)
  {
    direction /= direction.norm();
  }



  template <int dim>
  Point<dim>
  MeshMotion<dim>::map(const Point<dim> &x,
                       const double      t_start,
                       const double      t_end) const
  {
    if (!first)
      return x;
    if (!second)
      return first->map(x, t_start, t_end);
    const Point<dim> A = first->map(first->place, t_0, t_start);
    const Point<dim> B = second->map(second->place, t_0, t_start);
    const double     s = ((x - A) * direction) / ((B - A) * direction);
    return x + (1 - s) * (first->map(A, t_start, t_end) - A) +
           s * (second->map(B, t_start, t_end) - B);
  }



  template class MeshMotion<2>;
  template class MeshMotion<3>;
} // namespace moraine
