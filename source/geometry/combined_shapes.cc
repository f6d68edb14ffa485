// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/combined_shapes.h>

#include <deal.II/base/numbers.h>

#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Placement<dim>::Placement()
    : rotation(unit_symmetric_tensor<dim>())
  {}



  template <int dim>
  Placement<dim>::Placement(const double          degrees,
                            const Point<dim>     &centre,
                            const Tensor<1, dim> &axis,
                            const Tensor<1, dim> &translation)
  {
    const double angle = degrees * numbers::PI / 180.;
    if constexpr (dim == 2)
      rotation = Physics::Transformations::Rotations::rotation_matrix_2d(angle);
    else
      rotation = Physics::Transformations::Rotations::rotation_matrix_3d(
        Point<dim>(axis / axis.norm()), angle);
    // no round-off where the exact entry is 0, 1 or -1
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        if (std::abs(rotation[i][j] - std::round(rotation[i][j])) < 4e-16)
          rotation[i][j] = std::round(rotation[i][j]);
    shift = centre - rotation * centre + translation;
  }



  template <int dim>
  Point<dim>
  Placement<dim>::apply(const Point<dim> &x) const
  {
    return Point<dim>(rotation * x + shift);
  }



  template <int dim>
  Point<dim>
  Placement<dim>::undo(const Point<dim> &x) const
  {
    return Point<dim>((x - shift) * rotation);
  }



  template <int dim>
  MovedShape<dim>::MovedShape(const std::shared_ptr<const Shape<dim>> &shape,
                              const Placement<dim>                    &motion)
    : shape(shape)
    , motion(motion)
  {}



  template <int dim>
  double
  MovedShape<dim>::level(const Point<dim> &p) const
  {
    return shape->level(motion.undo(p));
  }



  template <int dim>
  BoundingBox<dim>
  MovedShape<dim>::bounding_box() const
  {
    const BoundingBox<dim> box = shape->bounding_box();
    if (!is_finite(box))
      return infinite_box<dim>();
    std::vector<Point<dim>> corners;
    for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_cell; ++v)
      corners.push_back(motion.apply(box.vertex(v)));
    return BoundingBox<dim>(corners);
  }



  template <int dim>
  ConvexPolytope<dim>
  MovedShape<dim>::moved_back(const ConvexPolytope<dim> &cell) const
  {
    ConvexPolytope<dim> moved = cell;
    moved.transform([&](const Point<dim> &x) { return motion.undo(x); });
    return moved;
  }



  template <int dim>
  Overlap
  MovedShape<dim>::overlap(const ConvexPolytope<dim> &cell) const
  {
    return shape->overlap(moved_back(cell));
  }



  template <int dim>
  bool
  MovedShape<dim>::is_straight() const
  {
    return shape->is_straight();
  }



  template <int dim>
  VolumeMoments<dim>
  MovedShape<dim>::moments_of_part(const ConvexPolytope<dim> &cell,
                                   const Point<dim>          &reference) const
  {
    VolumeMoments<dim> moved =
      shape->moments(moved_back(cell), motion.undo(reference));
    moved.first = motion.rotation * moved.first;
    return moved;
  }



  template <int dim>
  void
  MovedShape<dim>::add_pieces_of_part(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    const std::size_t n_before = pieces.size();
    shape->add_pieces(moved_back(cell), sign, pieces);
    for (std::size_t i = n_before; i < pieces.size(); ++i)
      pieces[i].polytope.transform(
        [&](const Point<dim> &x) { return motion.apply(x); });
  }



  template <int dim>
  CombinedShape<dim>::CombinedShape(const Operation operation,
                                    const std::shared_ptr<const Shape<dim>> &a,
                                    const std::shared_ptr<const Shape<dim>> &b)
    : operation(operation)
    , a(a)
    , b(b)
  {}



  template <int dim>
  double
  CombinedShape<dim>::level(const Point<dim> &p) const
  {
    switch (operation)
      {
        case Operation::unite:
          return std::max(a->level(p), b->level(p));
        case Operation::intersect:
          return std::min(a->level(p), b->level(p));
        default:
          return std::min(a->level(p), -b->level(p));
      }
  }



  template <int dim>
  BoundingBox<dim>
  CombinedShape<dim>::bounding_box() const
  {
    const BoundingBox<dim> box_a = a->bounding_box();
    if (operation == Operation::subtract || operation == Operation::hollow_out)
      return box_a;
    const BoundingBox<dim> box_b = b->bounding_box();
    Point<dim>             lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      if (operation == Operation::unite)
        {
          lower[d] = std::min(box_a.lower_bound(d), box_b.lower_bound(d));
          upper[d] = std::max(box_a.upper_bound(d), box_b.upper_bound(d));
        }
      else
        {
          lower[d] = std::max(box_a.lower_bound(d), box_b.lower_bound(d));
          upper[d] =
            std::max(lower[d],
                     std::min(box_a.upper_bound(d), box_b.upper_bound(d)));
        }
    return BoundingBox<dim>(std::make_pair(lower, upper));
  }



  template <int dim>
  Overlap
  CombinedShape<dim>::overlap(const ConvexPolytope<dim> &cell) const
  {
    const Overlap in_a = a->overlap(cell);
    // a alone decides
    if (operation == Operation::unite ? in_a == Overlap::all :
                                        in_a == Overlap::none)
      return in_a;
    Overlap in_b = b->overlap(cell);
    if (operation == Operation::unite)
      return in_b == Overlap::none ? in_a : in_b;
    if (operation != Operation::intersect && in_b != Overlap::part)
      in_b = in_b == Overlap::all ? Overlap::none : Overlap::all;
    return in_b == Overlap::all ? in_a : in_b;
  }



  template <int dim>
  bool
  CombinedShape<dim>::is_straight() const
  {
    return a->is_straight() && b->is_straight();
  }



  template <int dim>
  VolumeMoments<dim>
  CombinedShape<dim>::moments_of_part(const ConvexPolytope<dim> &cell,
                                      const Point<dim> &reference) const
  {
    VolumeMoments<dim> sum;
    if (operation != Operation::intersect)
      sum = a->moments(cell, reference);
    if (operation == Operation::unite)
      sum.add(1., b->moments(cell, reference));
    sum.add(operation == Operation::intersect ? 1. : -1.,
            common_moments(cell, reference));
    return sum;
  }



  template <int dim>
  void
  CombinedShape<dim>::add_pieces_of_part(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    if (operation != Operation::intersect)
      a->add_pieces(cell, sign, pieces);
    if (operation == Operation::unite)
      b->add_pieces(cell, sign, pieces);
    add_common_pieces(cell,
                      operation == Operation::intersect ? sign : -sign,
                      pieces);
  }



  template <int dim>
  VolumeMoments<dim>
  CombinedShape<dim>::common_moments(const ConvexPolytope<dim> &cell,
                                     const Point<dim>          &reference) const
  {
    if (operation == Operation::hollow_out)
      return b->moments(cell, reference);
    VolumeMoments<dim> sum;
    if (a->overlap(cell) == Overlap::none || b->overlap(cell) == Overlap::none)
      return sum;
    // pieces are exact for the straight one, moments also for many curved ones
    const Shape<dim>             &first  = a->is_straight() ? *a : *b;
    const Shape<dim>             &second = a->is_straight() ? *b : *a;
    std::vector<SignedPiece<dim>> pieces;
    first.add_pieces(cell, 1., pieces);
    for (const auto &piece : pieces)
      sum.add(piece.sign, second.moments(piece.polytope, reference));
    return sum;
  }



  template <int dim>
  void
  CombinedShape<dim>::add_common_pieces(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    if (operation == Operation::hollow_out)
      {
        b->add_pieces(cell, sign, pieces);
        return;
      }
    if (a->overlap(cell) == Overlap::none || b->overlap(cell) == Overlap::none)
      return;
    std::vector<SignedPiece<dim>> first;
    a->add_pieces(cell, sign, first);
    for (const auto &piece : first)
      b->add_pieces(piece.polytope, piece.sign, pieces);
  }



  template struct Placement<2>;
  template struct Placement<3>;
  template class MovedShape<2>;
  template class MovedShape<3>;
  template class CombinedShape<2>;
  template class CombinedShape<3>;
} // namespace moraine
