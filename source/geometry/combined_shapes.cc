// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shapes.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    class MovedShape : public Shape<dim>
    {
    public:
      MovedShape(const ShapePointer<dim> &shape, const Placement<dim> &motion)
        : Shape<dim>(motion.map(shape->bounding_box()),
                     shape->is_straight(),
                     shape->parts())
        , shape(shape)
        , motion(motion)
      {}

      double
      level(const Point<dim> &p) const override
      {
        return shape->level(motion.inverse(p));
      }

      bool
      covers(const Point<dim> &p, const double margin) const override
      {
        return shape->covers(motion.inverse(p), margin);
      }

      double
      distance(const Point<dim> &p, const double length) const override
      {
        return shape->distance(motion.inverse(p), length);
      }

      bool
      estimates_distance() const override
      {
        return shape->estimates_distance();
      }

      Overlap
      overlap(const ConvexPolytope<dim> &cell) const override
      {
        return shape->overlap(moved_back(cell));
      }

      typename Shape<dim>::Faces
      faces(const std::string &part,
            const bool         body_inside,
            const Extent<dim> &extent) const override
      {
        auto faces = shape->faces(part, body_inside, extent.seen_from(motion));
        for (auto &face : faces)
          face = std::make_shared<MovedSurface<dim>>(face, motion);
        return faces;
      }

    protected:
      VolumeMoments<dim>
      moments_of_part(const ConvexPolytope<dim> &cell,
                      const Point<dim>          &reference) const override
      {
        VolumeMoments<dim> moved =
          shape->moments(moved_back(cell), motion.inverse(reference));
        moved.first = motion.rotate(moved.first);
        return moved;
      }

      void
      add_pieces_of_part(const ConvexPolytope<dim> &cell,
                         const double               sign,
                         SignedPieces<dim>         &pieces) const override
      {
        const std::size_t n_before = pieces.size();
        shape->add_pieces(moved_back(cell), sign, pieces);
        for (std::size_t i = n_before; i < pieces.size(); ++i)
          pieces[i].polytope.transform(
            [&](const Point<dim> &x) { return motion.map(x); });
      }

    private:
      ConvexPolytope<dim>
      moved_back(const ConvexPolytope<dim> &cell) const
      {
        ConvexPolytope<dim> moved = cell;
        moved.transform([&](const Point<dim> &x) { return motion.inverse(x); });
        return moved;
      }

      ShapePointer<dim> shape;
      Placement<dim>    motion;
    };



    template <int dim>
    BoundingBox<dim>
    box_of(const Operation op, const Shape<dim> &a, const Shape<dim> &b)
    {
      BoundingBox<dim> box = a.bounding_box();
      if (op == Operation::intersect)
        return intersection(box, b.bounding_box());
      if (op == Operation::unite)
        box.merge_with(b.bounding_box());
      return box;
    }



    template <int dim>
    class CombinedShape : public Shape<dim>
    {
    public:
      CombinedShape(const Operation                   operation,
                    const ShapePointer<dim>          &a,
                    const ShapePointer<dim>          &b,
                    const std::array<std::string, 2> &names)
        : Shape<dim>(box_of(operation, *a, *b),
                     a->is_straight() && b->is_straight(),
                     parts_of(*a, *b, names))
        , operation(operation)
        , takes_off(operation == Operation::subtract ||
                    operation == Operation::hollow_out)
        , a(a)
        , b(b)
        , names(names)
      {}

      double
      level(const Point<dim> &p) const override
      {
        return joined(a->level(p), b->level(p));
      }

      double
      distance(const Point<dim> &p, const double length) const override
      {
        return joined(a->distance(p, length), b->distance(p, length));
      }

      bool
      estimates_distance() const override
      {
        return a->estimates_distance() || b->estimates_distance();
      }

      bool
      covers(const Point<dim> &p, const double margin) const override
      {
        if (operation == Operation::unite)
          return a->covers(p, margin) || b->covers(p, margin);
        return a->covers(p, margin) &&
               (takes_off ? !b->covers(p, -margin) : b->covers(p, margin));
      }

      Overlap
      overlap(const ConvexPolytope<dim> &cell) const override
      {
        const Overlap in_a = a->overlap(cell);
        // a alone decides
        if (operation == Operation::unite ? in_a == Overlap::all :
                                            in_a == Overlap::none)
          return in_a;
        Overlap in_b = b->overlap(cell);
        if (operation == Operation::unite)
          return in_b == Overlap::none ? in_a : in_b;
        if (takes_off && in_b != Overlap::part)
          in_b = in_b == Overlap::all ? Overlap::none : Overlap::all;
        return in_b == Overlap::all ? in_a : in_b;
      }

      typename Shape<dim>::Faces
      faces(const std::string &part,
            const bool         body_inside,
            const Extent<dim> &extent) const override
      {
        using Along = typename Extent<dim>::Along;
        typename Shape<dim>::Faces result;
        for (const unsigned int k : {0, 1})
          {
            const Shape<dim> &operand = k == 0 ? *a : *b;
            const bool        whole   = part.empty() || part == names[k];
            const auto        own =
              std::find_if(operand.parts().begin(),
                           operand.parts().end(),
                           [&](const std::string &name) {
                             return prefix_of(names[k]) + name == part;
                           });
            if (!whole && own == operand.parts().end())
              continue;
            Extent<dim> limited = extent;
            limited.box = intersection(extent.box, this->bounding_box());
            // a rim that both have belongs to the first, if it bounds the
            // result
            const bool outer = (operation == Operation::unite) == body_inside;
            if (operation != Operation::hollow_out)
              limited.limits.push_back(
                {k == 0 ? b : a,
                 operation == Operation::intersect || (k == 1 && takes_off),
                 k == 1 ? Along::never :
                          (outer ? Along::outer : Along::inner)});
            const auto more =
              operand.faces(whole ? "" : *own,
                            body_inside != (k == 1 && takes_off),
                            limited);
            result.insert(result.end(), more.begin(), more.end());
          }
        return result;
      }

    protected:
      VolumeMoments<dim>
      moments_of_part(const ConvexPolytope<dim> &cell,
                      const Point<dim>          &reference) const override
      {
        VolumeMoments<dim> sum;
        const auto         add =
          [&](const double sign, const auto &shape, const auto &part) {
            sum.add(sign, shape.moments(part, reference));
          };
        // pieces are exact for the straight one, moments also for many curved
        // ones
        if (a->is_straight())
          for_each_term(cell, *a, *b, add);
        else
          for_each_term(cell, *b, *a, add);
        return sum;
      }

      void
      add_pieces_of_part(const ConvexPolytope<dim> &cell,
                         const double               sign,
                         SignedPieces<dim>         &pieces) const override
      {
        for_each_term(cell,
                      *a,
                      *b,
                      [&](const double own,
                          const auto  &shape,
                          const auto  &part) {
                        shape.add_pieces(part, sign * own, pieces);
                      });
      }

    private:
      /** The level of the combination, or the distance. */
      double
      joined(const double of_a, const double of_b) const
      {
        if (operation == Operation::unite)
          return std::max(of_a, of_b);
        return std::min(of_a, takes_off ? -of_b : of_b);
      }

      static std::string
      prefix_of(const std::string &name)
      {
        return name.empty() ? "" : name + "/";
      }

      static std::vector<std::string>
      parts_of(const Shape<dim>                 &a,
               const Shape<dim>                 &b,
               const std::array<std::string, 2> &names)
      {
        std::vector<std::string> result;
        for (const unsigned int k : {0, 1})
          {
            if (!names[k].empty())
              result.push_back(names[k]);
            for (const std::string &own : (k == 0 ? a : b).parts())
              result.push_back(prefix_of(names[k]) + own);
          }
        return result;
      }

      /**
       * Call @p action(sign, shape, polytope) for parts of polytopes in a or b
       * that sum up to the part of a cell in the combination. What both share
       * is that in the @p second of the pieces of the @p first.
       */
      template <typename Action>
      void
      for_each_term(const ConvexPolytope<dim> &cell,
                    const Shape<dim>          &first,
                    const Shape<dim>          &second,
                    const Action              &action) const
      {
        const double sign = operation == Operation::intersect ? 1. : -1.;
        if (operation == Operation::hollow_out)
          {
            action(1., *a, cell);
            return action(sign, *b, cell);
          }
        const auto counts = [this](const Shape<dim> &shape) {
          return operation == Operation::unite ||
                 (operation == Operation::subtract && &shape == a.get());
        };
        if (counts(second))
          action(1., second, cell);
        const bool both = second.overlap(cell) != Overlap::none;
        // Pieces serve twice: a chain of unions would double the work with
        // each.
        const bool by_pieces = both && first.is_straight() && counts(first);
        if (counts(first) && !by_pieces)
          action(1., first, cell);
        SignedPieces<dim> pieces;
        if (both)
          first.add_pieces(cell, 1., pieces);
        for (const auto &piece : pieces)
          {
            if (by_pieces)
              action(piece.sign, *everywhere, piece.polytope);
            action(sign * piece.sign, second, piece.polytope);
          }
      }

      Operation                  operation;
      bool                       takes_off;
      ShapePointer<dim>          a;
      ShapePointer<dim>          b;
      ShapePointer<dim>          everywhere = make_space<dim>();
      std::array<std::string, 2> names;
    };
  } // namespace



  template <int dim>
  ShapePointer<dim>
  make_moved(const ShapePointer<dim> &shape, const Placement<dim> &motion)
  {
    return std::make_shared<MovedShape<dim>>(shape, motion);
  }



  template <int dim>
  ShapePointer<dim>
  combine(const Operation                   operation,
          const ShapePointer<dim>          &a,
          const ShapePointer<dim>          &b,
          const std::array<std::string, 2> &names)
  {
    return std::make_shared<CombinedShape<dim>>(operation, a, b, names);
  }



#define INSTANTIATE(dim)                              \
  template decltype(make_moved<dim>) make_moved<dim>; \
  template decltype(combine<dim>)    combine<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
