// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/points/body_cover.h>

#include <moraine/geometry/covered_pieces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  BodyCover<dim>::BodyCover(const PointSet<dim>       &points,
                            const ShapesOfBodies<dim> &shapes,
                            const bool                 moved)
    : points(&points)
    , shapes(&shapes)
    , moved(moved)
    , largest_displacements(shapes.size(), -1.)
  {
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        double &largest = largest_displacements[points.body(p)];
        largest         = std::max(largest, displacement(p).norm());
      }
    Utilities::MPI::max(largest_displacements,
                        points.mesh().triangulation().get_communicator(),
                        largest_displacements);
  }



  template <int dim>
  bool
  BodyCover<dim>::operator()(const unsigned int cell,
                             const Point<dim>  &x,
                             const double       margin) const
  {
    const auto [first, last] = points->points_in(cell);
    for (unsigned int p = first; p < last; ++p)
      if (p == first || points->body(p) != points->body(p - 1))
        if (covers(points->body(p), first, last, x, margin))
          return true;
    if (first == last)
      for (unsigned int body = 0; body < shapes->size(); ++body)
        if (largest_displacements[body] >= 0 &&
            (!(*shapes)[body] ||
             covers_place(*(*shapes)[body],
                          x,
                          margin + largest_displacements[body] +
                            points->forgotten_displacement())))
          return true;
    return false;
  }



  template <int dim>
  bool
  BodyCover<dim>::covers(const unsigned int body,
                         const unsigned int first,
                         const unsigned int last,
                         const Point<dim>  &x,
                         const double       margin) const
  {
    const auto &shape = (*shapes)[body];
    if (!shape)
      return true;
    unsigned int nearest = last, n = 0;
    double       least = 0;
    for (unsigned int p = first; p < last; ++p)
      if (points->body(p) == body)
        {
          const double distance = points->position(p).distance_square(x);
          if (n++ == 0 || distance < least)
            {
              nearest = p;
              least   = distance;
            }
        }
    const Tensor<1, dim> u = displacement(nearest);
    // A point alone says nothing of strains and turns.
    double uncertain = n == 1 ? u.norm() : 0.;
    for (unsigned int p = first; p < last; ++p)
      if (points->body(p) == body)
        uncertain = std::max(uncertain, (displacement(p) - u).norm());
    return covers_place(*shape,
                        x - u,
                        margin + uncertain + points->forgotten_displacement());
  }



  template class BodyCover<2>;
  template class BodyCover<3>;
} // namespace moraine
