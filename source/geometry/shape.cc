// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape.h>

#include <moraine/geometry/curve_subdivision.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  ClippedVolume<dim>
  Shape<dim>::clip(const ConvexPolytope<dim> &cell) const
  {
    ClippedVolume<dim> part;
    if (cell.empty())
      return part;
    part.centroid        = cell.centroid();
    const Overlap answer = overlap(cell);
    if (answer == Overlap::all)
      part.volume = cell.volume();
    else if (answer == Overlap::part)
      {
        const VolumeMoments<dim> m = moments_of_part(cell, part.centroid);
        // what cancellation may leave of nothing
        if (m.volume > 1e-15 * cell.volume())
          {
            part.volume = m.volume;
            part.centroid =
              cell.pull_inside(part.centroid + m.first / m.volume);
          }
      }
    return part;
  }



  template <int dim>
  Overlap
  Shape<dim>::overlap(const ConvexPolytope<dim> &cell) const
  {
    const Point<dim> centre = cell.vertex_mean();
    const double     value  = level(centre);
    const double     radius = cell.radius(centre) - cell.tolerance();
    return value >= radius ? Overlap::all :
                             (value <= -radius ? Overlap::none : Overlap::part);
  }



  template <int dim>
  VolumeMoments<dim>
  Shape<dim>::moments(const ConvexPolytope<dim> &cell,
                      const Point<dim>          &reference) const
  {
    const Overlap answer = cell.empty() ? Overlap::none : overlap(cell);
    if (answer == Overlap::part)
      return moments_of_part(cell, reference);
    return answer == Overlap::all ? cell.moments(reference) :
                                    VolumeMoments<dim>();
  }



  template <int dim>
  void
  Shape<dim>::add_pieces(const ConvexPolytope<dim> &cell,
                         const double               sign,
                         SignedPieces<dim>         &pieces) const
  {
    const Overlap answer = cell.empty() ? Overlap::none : overlap(cell);
    if (answer == Overlap::all)
      pieces.push_back({sign, cell});
    else if (answer == Overlap::part)
      add_pieces_of_part(cell, sign, pieces);
  }



  template <int dim>
  VolumeMoments<dim>
  Shape<dim>::moments_of_part(const ConvexPolytope<dim> &cell,
                              const Point<dim>          &reference) const
  {
    SignedPieces<dim> pieces;
    add_pieces_of_part(cell, 1., pieces);
    VolumeMoments<dim> sum;
    for (const auto &piece : pieces)
      sum.add(piece.sign, piece.polytope.moments(reference));
    return sum;
  }



  template <int dim>
  void
  Shape<dim>::add_pieces_of_part(const ConvexPolytope<dim> &cell,
                                 const double               sign,
                                 SignedPieces<dim>         &pieces) const
  {
    add_curved_pieces<dim>([this](const Point<dim> &p) { return level(p); },
                           true,
                           cell,
                           sign,
                           pieces);
  }



  template class Shape<2>;
  template class Shape<3>;
} // namespace moraine
