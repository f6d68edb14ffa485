// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape.h>

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



  template <int dim>
  double
  Extent<dim>::value(const Point<dim>     &x,
                     const Tensor<1, dim> &normal,
                     const double          tolerance) const
  {
    double value = std::numeric_limits<double>::infinity();
    for (const auto &[shape, inside, along] : limits)
      for (const auto &[side, other] : {std::make_pair(-1., Along::outer),
                                        std::make_pair(1., Along::inner)})
        if (along != other)
          {
            const double sign  = inside ? 1. : -1.;
            double       level = shape->level(x + side * tolerance * normal);
            // along a boundary of the shape, further off there is a distance
            // from the end that is not round-off
            if (std::abs(level) <= 1.5 * tolerance)
              {
                const double off =
                  shape->level(x + side * 1e8 * tolerance * normal);
                level =
                  level > 0. ? std::max(level, off) : std::min(level, off);
              }
            value = std::min(value, sign * level);
          }
    return value;
  }



  template <int dim>
  bool
  Extent<dim>::contains(const Point<dim> &x, const Tensor<1, dim> &normal) const
  {
    const double tolerance = 1e-10 * coordinate_magnitude<dim>(x);
    return limits.empty() || value(x, normal, tolerance) >= -2. * tolerance;
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
    for (const auto &[shape, inside, along] : limits)
      result.limits.push_back(
        {make_moved(shape, placement.inverse()), inside, along});
    return result;
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
  template SurfacePointer<dim> join(const std::vector<SurfacePointer<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
