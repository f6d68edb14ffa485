// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape.h>

#include <moraine/core/exceptions.h>
#include <moraine/geometry/curved_parts.h>
#include <moraine/geometry/shapes.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    part.centroid              = cell.centroid();
    const VolumeMoments<dim> m = moments(cell, part.centroid);
    // what cancellation may leave of nothing
    if (m.volume > 1e-15 * cell.volume())
      {
        part.volume   = m.volume;
        part.centroid = cell.pull_inside(part.centroid + m.first / m.volume);
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



  template <int dim>
  bool
  Surface<dim>::may_touch(const CellVertices<dim> &cell) const
  {
    const BoundingBox<dim> around(cell);
    // Vertices have the round-off of their coordinates.
    const double slack =
      std::max(1e-6 * cell_size<dim>(cell),
               std::ldexp(coordinate_magnitude<dim>(cell[0]), -43));
    for (unsigned int d = 0; d < dim; ++d)
      if (around.lower_bound(d) > box.upper_bound(d) + slack ||
          around.upper_bound(d) < box.lower_bound(d) - slack)
        return false;
    return true;
  }



  namespace
  {
    /** The level of a shape beside a place of a surface, as far off along @p
     * off as round-off reaches. */
    template <int dim>
    double
    level_beside(const Shape<dim>     &shape,
                 const Point<dim>     &x,
                 const Tensor<1, dim> &off)
    {
      const double level = shape.level(x + off);
      // along a boundary of the shape, further off there is a distance
      // from the end that is not round-off
      if (std::abs(level) > 1.5 * off.norm())
        return level;
      const double further = shape.level(x + 1e8 * off);
      return level > 0. ? std::max(level, further) : std::min(level, further);
    }



    /**
     * Whether the rim of a shape at @p x, just inside it, runs across the unit
     * vector @p outward: in each direction it does so on one side at least, as
     * beside an edge.
     */
    template <int dim>
    bool
    is_rim_across(const Shape<dim>     &shape,
                  const Point<dim>     &x,
                  const Tensor<1, dim> &outward,
                  const double          step)
    {
      constexpr double     largest_slope = 0.2;
      const Tensor<1, dim> up            = largest_slope * step * outward;
      const auto           is_flat       = [&](const Tensor<1, dim> &way) {
        return shape.covers(x + step * way - up, 0) &&
               !shape.covers(x + step * way + up, 0);
      };
      if constexpr (dim == 2)
        {
          const Tensor<1, 2> along = cross_product_2d(outward);
          return is_flat(along) || is_flat(-along);
        }
      else
        {
          const PlaneFrame frame(x, outward);
          return (is_flat(frame.first) || is_flat(-frame.first)) &&
                 (is_flat(frame.second) || is_flat(-frame.second));
        }
    }



    /** Of a place of a surface before a shape, positive if the shape's rim runs
     * along the surface at most @p reach behind it, against @p outward. */
    template <int dim>
    double
    level_behind_gap(const Shape<dim>     &shape,
                     const Point<dim>     &x,
                     const Tensor<1, dim> &outward,
                     const double          reach,
                     const double          tolerance)
    {
      double depth = 0;
      for (unsigned int k = 0; k < 100 && depth <= reach; ++k)
        {
          const Point<dim> there = x - depth * outward;
          const double     level = shape.distance(there, reach);
          if (level > 0)
            return is_rim_across(shape, there, outward, 20 * tolerance) ?
                     std::max(tolerance,
                              shape.level(there - 1e8 * tolerance * outward)) :
                     -reach;
          depth += std::max(-level, tolerance);
        }
      return -reach;
    }



    /** Positive where a shape is at a place of a surface, or at most @p reach
     * before or behind it. Where an expression is no number it is. */
    template <int dim>
    double
    level_near(const Shape<dim>     &shape,
               const Point<dim>     &x,
               const Tensor<1, dim> &normal,
               const double          reach,
               const double          tolerance)
    {
      try
        {
          const double level =
            std::max(level_beside<dim>(shape, x, tolerance * normal),
                     level_beside<dim>(shape, x, -tolerance * normal));
          if (level > 0)
            return level;
          const double behind_gap = std::max(
            level_behind_gap<dim>(shape, x, normal, reach, tolerance),
            level_behind_gap<dim>(shape, x, -normal, reach, tolerance));
          return behind_gap > 0 ? behind_gap : level;
        }
      catch (const InputError &)
        {
          return reach;
        }
    }
  } // namespace



  template <int dim>
  double
  Extent<dim>::value(const Point<dim>     &x,
                     const Tensor<1, dim> &normal,
                     const double          tolerance) const
  {
    double value = std::numeric_limits<double>::infinity();
    for (const auto &[shape, inside, along, reach] : limits)
      if (along == Along::beside)
        {
          const double round_off =
            std::ldexp(coordinate_magnitude<dim>(x), -46);
          value = std::min(value,
                           level_near(*shape,
                                      x,
                                      normal,
                                      reach,
                                      std::max(tolerance, round_off)));
        }
      else
        for (const auto &[side, other] : {std::make_pair(-1., Along::outer),
                                          std::make_pair(1., Along::inner)})
          if (along != other)
            value = std::min(value,
                             (inside ? 1. : -1.) *
                               level_beside<dim>(*shape,
                                                 x,
                                                 side * tolerance * normal));
    return value;
  }



  template <int dim>
  std::vector<Stretch>
  Extent<dim>::stretches(
    const Stretch &piece,
    const double   tolerance,
    const std::function<std::pair<Point<dim>, Tensor<1, dim>>(double)> &curve)
    const
  {
    if (limits.empty())
      return {piece};
    const auto [from, to] = piece;
    const auto is_within  = [&](const double s) {
      const auto [x, normal] = curve(s);
      return value(x, normal, tolerance) > 0.;
    };
    constexpr unsigned int n    = 32;
    const double           step = (to - from) / n;
    std::vector<Stretch>   result;
    double                 last   = from;
    bool                   inside = is_within(from + 1e-9 * step);
    if (inside)
      result.push_back(piece);
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double next = std::min(from + (i + .5) * step, to - 1e-9 * step);
        if (is_within(next) != inside)
          {
            double       here = last, there = next;
            const double tiny = 1e-16 * (to - from);
            for (double middle = (here + there) / 2.;
                 middle > here + tiny && middle < there - tiny;
                 middle = (here + there) / 2.)
              (is_within(middle) == inside ? here : there) = middle;
            if (inside)
              result.back().second = there;
            else
              result.emplace_back(there, to);
            inside = !inside;
          }
        last = next;
      }
    return result;
  }



  template <int dim>
  Extent<dim>
  Extent<dim>::seen_from(const Placement<dim> &placement) const
  {
    Extent<dim> result;
    result.box = placement.inverse().map(box);
    for (const auto &[shape, inside, along, reach] : limits)
      result.limits.push_back(
        {make_moved(shape, placement.inverse()), inside, along, reach});
    return result;
  }



  template <int dim>
  Extent<dim>
  Extent<dim>::and_within(const Extent &other) const
  {
    Extent<dim> both = *this;
    both.limits.insert(both.limits.end(),
                       other.limits.begin(),
                       other.limits.end());
    both.box = intersection(box, other.box);
    return both;
  }



  template <int dim>
  MovedSurface<dim>::MovedSurface(const SurfacePointer<dim> &reference,
                                  const Placement<dim>      &pose)
    : Surface<dim>(pose.map(reference->bounding_box()), reference->curved())
    , reference(reference)
    , present(pose)
  {}

  template <int dim>
  void
  MovedSurface<dim>::set_pose(const Placement<dim> &pose)
  {
    present   = pose;
    this->box = pose.map(reference->bounding_box());
  }



  template <int dim>
  NearestPoint<dim>
  MovedSurface<dim>::nearest(const Point<dim> &x, const double length) const
  {
    NearestPoint<dim> point =
      reference->nearest(present.inverse(x), length > 0 ? length : seen_over);
    point.normal = present.rotate(point.normal);
    return point;
  }



  template <int dim>
  void
  MovedSurface<dim>::pieces(const CellVertices<dim>        &cell,
                            const unsigned int              n_gauss,
                            std::vector<SurfacePoint<dim>> &out) const
  {
    CellVertices<dim> mapped;
    for (unsigned int v = 0; v < cell.size(); ++v)
      mapped[v] = present.inverse(cell[v]);
    const std::size_t before = out.size();
    reference->pieces(mapped, n_gauss, out);
    for (std::size_t i = before; i < out.size(); ++i)
      {
        out[i].x      = present.map(out[i].x);
        out[i].normal = present.rotate(out[i].normal);
      }
  }



  template <int dim>
  SurfacePointer<dim>
  MovedSurface<dim>::within(const Extent<dim> &extent) const
  {
    const auto part = reference->within(extent.seen_from(present));
    if (!part)
      return nullptr;
    const auto moved = std::make_shared<MovedSurface<dim>>(part, present);
    moved->see_over(seen_over);
    return moved;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  MovedSurface<dim>::normal_gradient(const Point<dim> &x, const double h) const
  {
    // Largest |grad n| h of a smooth surface; across a corner it is far more.
    constexpr double corner = 4;
    const double     step   = 1e-4 * h;
    Tensor<2, dim>   gradient;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> ahead = step * Point<dim>::unit_vector(d);
        gradient[d] =
          (this->normal(x + ahead) - this->normal(x - ahead)) / (2 * step);
      }
    return gradient.norm() * h < corner ? symmetrize(gradient) :
                                          SymmetricTensor<2, dim>();
  }



  namespace
  {
    template <int dim>
    class SurfaceList : public Surface<dim>
    {
    public:
      SurfaceList(const std::vector<SurfacePointer<dim>> &members)
        : Surface<dim>(members[0]->bounding_box(),
                       std::any_of(members.begin(),
                                   members.end(),
                                   [](const auto &m) { return m->curved(); }))
        , members(members)
      {
        for (const auto &member : members)
          this->box.merge_with(member->bounding_box());
      }

      NearestPoint<dim>
      nearest(const Point<dim> &x, const double length) const override
      {
        NearestPoint<dim> best = members[0]->nearest(x, length);
        for (unsigned int i = 1; i < members.size(); ++i)
          {
            const NearestPoint<dim> other = members[i]->nearest(x, length);
            if (other.in_extent != best.in_extent ?
                  other.in_extent :
                  std::abs(other.level) < std::abs(best.level))
              best = other;
          }
        return best;
      }

      void
      pieces(const CellVertices<dim>        &cell,
             const unsigned int              n_gauss,
             std::vector<SurfacePoint<dim>> &out) const override
      {
        for (const auto &member : members)
          member->pieces(cell, n_gauss, out);
      }

      SurfacePointer<dim>
      within(const Extent<dim> &extent) const override
      {
        std::vector<SurfacePointer<dim>> parts;
        for (const auto &member : members)
          parts.push_back(member->within(extent));
        return std::find(parts.begin(), parts.end(), nullptr) == parts.end() ?
                 join(parts) :
                 nullptr;
      }

    private:
      std::vector<SurfacePointer<dim>> members;
    };
  } // namespace



  template <int dim>
  SurfacePointer<dim>
  join(const std::vector<SurfacePointer<dim>> &members)
  {
    if (members.size() < 2)
      return members.empty() ? nullptr : members[0];
    return std::make_shared<SurfaceList<dim>>(members);
  }



#define INSTANTIATE(dim)            \
  template class Shape<dim>;        \
  template class Surface<dim>;      \
  template struct Extent<dim>;      \
  template class MovedSurface<dim>; \
  template decltype(join<dim>) join<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
