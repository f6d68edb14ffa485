// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape.h>

#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  bool
  Shape<dim>::contains(const Point<dim> &p) const
  {
    return level(p) > 0.;
  }



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
    const double     reach  = cell.radius(centre) - cell.tolerance();
    return value >= reach ? Overlap::all :
                            (value <= -reach ? Overlap::none : Overlap::part);
  }



  template <int dim>
  VolumeMoments<dim>
  Shape<dim>::moments(const ConvexPolytope<dim> &cell,
                      const Point<dim>          &reference) const
  {
    if (!cell.empty())
      switch (overlap(cell))
        {
          case Overlap::all:
            return cell.moments(reference);
          case Overlap::part:
            return moments_of_part(cell, reference);
          case Overlap::none:
            break;
        }
    return {};
  }



  template <int dim>
  void
  Shape<dim>::add_pieces(const ConvexPolytope<dim>     &cell,
                         const double                   sign,
                         std::vector<SignedPiece<dim>> &pieces) const
  {
    if (!cell.empty())
      switch (overlap(cell))
        {
          case Overlap::all:
            pieces.push_back({sign, cell});
            break;
          case Overlap::part:
            add_pieces_of_part(cell, sign, pieces);
            break;
          case Overlap::none:
            break;
        }
  }



  template <int dim>
  bool
  Shape<dim>::is_straight() const
  {
    return false;
  }



  template <int dim>
  VolumeMoments<dim>
  Shape<dim>::moments_of_part(const ConvexPolytope<dim> &cell,
                              const Point<dim>          &reference) const
  {
    std::vector<SignedPiece<dim>> pieces;
    add_pieces_of_part(cell, 1., pieces);
    VolumeMoments<dim> sum;
    for (const auto &piece : pieces)
      sum.add(piece.sign, piece.polytope.moments(reference));
    return sum;
  }



  template <int dim>
  BoundingBox<dim>
  infinite_box()
  {
    Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = -std::numeric_limits<double>::infinity();
        upper[d] = std::numeric_limits<double>::infinity();
      }
    return BoundingBox<dim>(std::make_pair(lower, upper));
  }



  template <int dim>
  bool
  is_finite(const BoundingBox<dim> &box)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!std::isfinite(box.lower_bound(d)) ||
          !std::isfinite(box.upper_bound(d)))
        return false;
    return true;
  }



  template class Shape<2>;
  template class Shape<3>;
  template BoundingBox<2>
  infinite_box();
  template BoundingBox<3>
  infinite_box();
  template bool
  is_finite(const BoundingBox<2> &);
  template bool
  is_finite(const BoundingBox<3> &);
} // namespace moraine
