// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/curved_shapes.h>

#include <moraine/geometry/round_moments.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  RoundShape<dim>::RoundShape(const double                 radius,
                              const CurveSubdivision<dim> &subdivision)
    : radius(radius)
    , subdivision(subdivision)
  {}



  template <int dim>
  Overlap
  RoundShape<dim>::overlap(const ConvexPolytope<dim> &cell) const
  {
    const Overlap answer = Shape<dim>::overlap(cell);
    if (answer != Overlap::part)
      return answer;
    // a convex shape holds a polytope if it holds its vertices
    for (const auto &x : cell.vertices())
      if (this->level(x) < -cell.tolerance())
        return Overlap::part;
    return Overlap::all;
  }



  template <int dim>
  void
  RoundShape<dim>::add_pieces_of_part(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    subdivision.add_pieces([this](
                             const Point<dim> &p) { return this->level(p); },
                           true,
                           cell,
                           sign,
                           pieces);
  }



  template <int dim>
  BallShape<dim>::BallShape(const Point<dim>            &centre,
                            const double                 radius,
                            const CurveSubdivision<dim> &subdivision)
    : RoundShape<dim>(radius, subdivision)
    , centre(centre)
  {}



  template <int dim>
  double
  BallShape<dim>::level(const Point<dim> &p) const
  {
    return this->radius - p.distance(centre);
  }



  template <int dim>
  BoundingBox<dim>
  BallShape<dim>::bounding_box() const
  {
    Point<dim> lower = centre, upper = centre;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] -= this->radius;
        upper[d] += this->radius;
      }
    return BoundingBox<dim>(std::make_pair(lower, upper));
  }



  template <int dim>
  VolumeMoments<dim>
  BallShape<dim>::moments_of_part(const ConvexPolytope<dim> &cell,
                                  const Point<dim>          &reference) const
  {
    return moments_in_ball(cell, centre, this->radius, reference);
  }



  CylinderShape::CylinderShape(const Point<3>            &start,
                               const Point<3>            &end,
                               const double               radius,
                               const CurveSubdivision<3> &subdivision)
    : RoundShape<3>(radius, subdivision)
    , start(start)
    , axis((end - start) / start.distance(end))
    , length(start.distance(end))
  {}



  double
  CylinderShape::radial_level(const Point<3> &p) const
  {
    const Tensor<1, 3> arm = p - start;
    return radius - (arm - (arm * axis) * axis).norm();
  }



  double
  CylinderShape::level(const Point<3> &p) const
  {
    const double height = (p - start) * axis;
    return std::min({radial_level(p), height, length - height});
  }



  BoundingBox<3>
  CylinderShape::bounding_box() const
  {
    Point<3> lower, upper;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double end = start[d] + length * axis[d];
        const double side =
          radius * std::sqrt(std::max(0., 1. - axis[d] * axis[d]));
        lower[d] = std::min(start[d], end) - side;
        upper[d] = std::max(start[d], end) + side;
      }
    return BoundingBox<3>(std::make_pair(lower, upper));
  }



  ConvexPolytope<3>
  CylinderShape::between_ends(const ConvexPolytope<3> &cell) const
  {
    ConvexPolytope<3> part = cell;
    part.clip(start, axis);
    if (!part.empty())
      part.clip(start + length * axis, -axis);
    return part;
  }



  VolumeMoments<3>
  CylinderShape::moments_of_part(const ConvexPolytope<3> &cell,
                                 const Point<3>          &reference) const
  {
    const ConvexPolytope<3> part = between_ends(cell);
    return part.empty() ?
             VolumeMoments<3>() :
             moments_in_cylinder(part, start, axis, radius, reference);
  }



  void
  CylinderShape::add_pieces_of_part(const ConvexPolytope<3>     &cell,
                                    const double                 sign,
                                    std::vector<SignedPiece<3>> &pieces) const
  {
    const ConvexPolytope<3> part = between_ends(cell);
    if (!part.empty())
      subdivision.add_pieces([this](
                               const Point<3> &p) { return radial_level(p); },
                             true,
                             part,
                             sign,
                             pieces);
  }



  template <int dim>
  ExpressionShape<dim>::ExpressionShape(
    const std::string           &expression,
    const std::string           &place,
    const CurveSubdivision<dim> &subdivision)
    : expression(expression, place, 1, {}, false)
    , subdivision(subdivision)
  {}



  template <int dim>
  double
  ExpressionShape<dim>::level(const Point<dim> &p) const
  {
    return expression.value(p);
  }



  template <int dim>
  BoundingBox<dim>
  ExpressionShape<dim>::bounding_box() const
  {
    return infinite_box<dim>();
  }



  template <int dim>
  Overlap
  ExpressionShape<dim>::overlap(const ConvexPolytope<dim> &cell) const
  {
    return CurveSubdivision<dim>::overlap(
      [this](const Point<dim> &p) { return level(p); }, cell);
  }



  template <int dim>
  void
  ExpressionShape<dim>::add_pieces_of_part(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    subdivision.add_pieces([this](const Point<dim> &p) { return level(p); },
                           false,
                           cell,
                           sign,
                           pieces);
  }



  template class RoundShape<2>;
  template class RoundShape<3>;
  template class BallShape<2>;
  template class BallShape<3>;
  template class ExpressionShape<2>;
  template class ExpressionShape<3>;
} // namespace moraine
