// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/combined_shapes.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

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
    return shape->level(motion.inverse(p));
  }

  template <int dim>
  BoundingBox<dim>
  MovedShape<dim>::bounding_box() const
  {
    return motion.map(shape->bounding_box());
  }

  template <int dim>
  std::vector<std::string>
  MovedShape<dim>::parts() const
  {
    return shape->parts();
  }

  template <int dim>
  void
  MovedShape<dim>::add_faces(const std::string          &part,
                             const bool                  body_inside,
                             const Extent<dim>          &extent,
                             typename Shape<dim>::Faces &faces) const
  {
    typename Shape<dim>::Faces unmoved;
    shape->add_faces(part, body_inside, extent.seen_from(motion), unmoved);
    for (const auto &face : unmoved)
      faces.push_back(std::make_shared<MovedSurface<dim>>(face, motion));
  }

  template <int dim>
  ConvexPolytope<dim>
  MovedShape<dim>::moved_back(const ConvexPolytope<dim> &cell) const
  {
    ConvexPolytope<dim> moved = cell;
    moved.transform([&](const Point<dim> &x) { return motion.inverse(x); });
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
      shape->moments(moved_back(cell), motion.inverse(reference));
    moved.first = motion.rotate(moved.first);
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
        [&](const Point<dim> &x) { return motion.map(x); });
  }

  template <int dim>
  CombinedShape<dim>::CombinedShape(const Operation operation,
                                    const std::shared_ptr<const Shape<dim>> &a,
                                    const std::shared_ptr<const Shape<dim>> &b,
                                    const std::array<std::string, 2> &names)
    : operation(operation)
    , a(a)
    , b(b)
    , names(names)
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

  template <int dim>
  std::vector<std::string>
  CombinedShape<dim>::parts() const
  {
    std::vector<std::string> result;
    for (const unsigned int k : {0, 1})
      {
        if (!names[k].empty())
          result.push_back(names[k]);
        for (const std::string &own : (k == 0 ? a : b)->parts())
          result.push_back(prefix(k) + own);
      }
    return result;
  }

  template <int dim>
  std::string
  CombinedShape<dim>::prefix(const unsigned int k) const
  {
    return names[k].empty() ? "" : names[k] + "/";
  }

  template <int dim>
  void
  CombinedShape<dim>::add_faces(const std::string          &part,
                                const bool                  body_inside,
                                const Extent<dim>          &extent,
                                typename Shape<dim>::Faces &faces) const
  {
    using Along = typename Extent<dim>::Along;
    const bool takes_off =
      operation == Operation::subtract || operation == Operation::hollow_out;
    for (const unsigned int k : {0, 1})
      {
        const auto &operand = k == 0 ? a : b;
        std::string own     = part == names[k] ? "" : part;
        if (!own.empty())
          {
            const auto known = operand->parts();
            if (own.rfind(prefix(k), 0) != 0)
              continue;
            own.erase(0, prefix(k).size());
            if (std::find(known.begin(), known.end(), own) == known.end())
              continue;
          }
        Extent<dim> limited = extent;
        // a rim that both have belongs to the first, if it bounds the result
        const bool outer = (operation == Operation::unite) == body_inside;
        if (operation != Operation::hollow_out)
          limited.limits.push_back(
            {k == 0 ? b : a,
             operation == Operation::intersect || (k == 1 && takes_off),
             k == 1 ? Along::never : (outer ? Along::outer : Along::inner)});
        operand->add_faces(own,
                           body_inside != (k == 1 && takes_off),
                           limited,
                           faces);
      }
  }

  template class MovedShape<2>;
  template class MovedShape<3>;
  template class CombinedShape<2>;
  template class CombinedShape<3>;
} // namespace moraine
