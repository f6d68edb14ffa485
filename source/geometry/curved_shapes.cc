// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/curved_shapes.h>

#include <moraine/core/exceptions.h>

#include <moraine/geometry/curve_subdivision.h>
#include <moraine/geometry/curved_surfaces.h>
#include <moraine/geometry/round_moments.h>
#include <moraine/geometry/straight_shapes.h>
#include <moraine/geometry/straight_surfaces.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  RoundShape<dim>::RoundShape(const Point<dim>     &centre,
                              const double          radius,
                              const Tensor<1, dim> &axis)
    : centre(centre)
    , radius(radius)
    , axis(axis)
  {
    if (!(radius > 0.) || !std::isfinite(radius))
      throw InputError("a radius must be positive, found " +
                       std::to_string(radius));
    if (axis.norm() > 0.)
      this->axis /= axis.norm();
  }

  template <int dim>
  Tensor<1, dim>
  RoundShape<dim>::radial(const Tensor<1, dim> &from_centre) const
  {
    return from_centre - (from_centre * axis) * axis;
  }

  template <int dim>
  double
  RoundShape<dim>::level(const Point<dim> &p) const
  {
    return radius - radial(p - centre).norm();
  }

  template <int dim>
  BoundingBox<dim>
  RoundShape<dim>::bounding_box() const
  {
    if (axis.norm() > 0.)
      return unlimited_box<dim>();
    Tensor<1, dim> arm;
    for (unsigned int d = 0; d < dim; ++d)
      arm[d] = radius;
    return BoundingBox<dim>(std::make_pair(centre - arm, centre + arm));
  }

  template <int dim>
  Overlap
  RoundShape<dim>::overlap(const ConvexPolytope<dim> &cell) const
  {
    const Overlap answer = Shape<dim>::overlap(cell);
    if (answer != Overlap::part)
      return answer;
    // a convex shape holds a polytope if it holds its vertices
    for (const auto &x : cell.vertices())
      if (level(x) < -cell.tolerance())
        return Overlap::part;
    return Overlap::all;
  }

  template <int dim>
  void
  RoundShape<dim>::add_faces(const std::string &,
                             const bool                  body_inside,
                             const Extent<dim>          &extent,
                             typename Shape<dim>::Faces &faces) const
  {
    if constexpr (dim == 2)
      faces.push_back(
        std::make_shared<Arc>(centre, radius, body_inside, 0., 360., extent));
    else
      faces.push_back(std::make_shared<LevelSetSurface<dim>>(
        std::make_shared<RoundShape<dim>>(*this),
        body_inside,
        extent,
        bounding_box()));
  }

  template <int dim>
  double
  RoundShape<dim>::value(const Point<dim> &x) const
  {
    return (radius * radius - radial(x - centre).norm_square()) / (2. * radius);
  }

  template <int dim>
  Tensor<1, dim>
  RoundShape<dim>::gradient(const Point<dim> &x, const double) const
  {
    return -1. / radius * radial(x - centre);
  }

  template <int dim>
  SymmetricTensor<2, dim>
  RoundShape<dim>::hessian(const Point<dim> &, const double) const
  {
    return -1. / radius *
           (unit_symmetric_tensor<dim>() -
            symmetrize(outer_product(axis, axis)));
  }

  template <int dim>
  NearestPoint<dim>
  RoundShape<dim>::nearest(const Point<dim> &x) const
  {
    const Tensor<1, dim> r = radial(x - centre);
    // on the axis r is round-off in any direction
    return {radius - r.norm(),
            unit_or_any<dim>(radial(unit_or_any<dim>(r))),
            true};
  }

  template <int dim>
  VolumeMoments<dim>
  RoundShape<dim>::moments_of_part(const ConvexPolytope<dim> &cell,
                                   const Point<dim>          &reference) const
  {
    if constexpr (dim == 3)
      if (axis.norm() > 0.)
        return moments_in_cylinder(cell, centre, axis, radius, reference);
    return moments_in_ball(cell, centre, radius, reference);
  }

  template <int dim>
  void
  RoundShape<dim>::add_pieces_of_part(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    add_curved_pieces<dim>([this](const Point<dim> &p) { return level(p); },
                           true,
                           cell,
                           sign,
                           pieces);
  }

  namespace
  {
    /** What is between the planes through both ends of an axis. */
    ConvexShape<3>
    slab(const Point<3> &start, const Point<3> &end)
    {
      if (start == end)
        throw InputError("the axis of a cylinder must have a length");
      const Tensor<1, 3> axis = (end - start) / start.distance(end);
      return ConvexShape<3>(
        std::vector<ConvexShape<3>::HalfSpace>{{start, -axis}, {end, axis}});
    }
  } // namespace

  CylinderShape::CylinderShape(const Point<3> &start,
                               const Point<3> &end,
                               const double    radius,
                               const double    inner_radius)
    : CombinedShape<3>(Operation::intersect,
                       std::make_shared<ConvexShape<3>>(slab(start, end)),
                       nullptr)
    , start(start)
    , end(end)
    , radius(radius)
    , outer(std::make_shared<RoundShape<3>>(start, radius, end - start))
  {
    b = outer;
    if (inner_radius > 0.)
      {
        inner =
          std::make_shared<RoundShape<3>>(start, inner_radius, end - start);
        b = std::make_shared<CombinedShape<3>>(Operation::hollow_out,
                                               outer,
                                               inner);
      }
  }

  BoundingBox<3>
  CylinderShape::bounding_box() const
  {
    const Tensor<1, 3> axis = (end - start) / start.distance(end);
    Tensor<1, 3>       arm;
    for (unsigned int d = 0; d < 3; ++d)
      arm[d] = radius * std::sqrt(std::max(0., 1. - axis[d] * axis[d]));
    return BoundingBox<3>(
      std::vector<Point<3>>{start - arm, start + arm, end - arm, end + arm});
  }

  std::vector<std::string>
  CylinderShape::parts() const
  {
    if (inner)
      return {"outer", "inner", "bottom", "top"};
    return {"side", "bottom", "top"};
  }

  void
  CylinderShape::add_faces(const std::string &part,
                           const bool         body_inside,
                           const Extent<3>   &extent,
                           Faces             &faces) const
  {
    using Along           = Extent<3>::Along;
    Extent<3>  between    = extent;
    const auto half_space = [](const Point<3> &p, const Tensor<1, 3> &outward) {
      return std::make_shared<ConvexShape<3>>(
        ConvexShape<3>::half_space(p, outward));
    };
    between.limits.push_back(
      {half_space(start, start - end), true, Along::inner});
    between.limits.push_back(
      {half_space(end, end - start), true, Along::inner});
    if (part.empty() || part == "side" || part == "outer")
      faces.push_back(std::make_shared<LevelSetSurface<3>>(
        outer, body_inside, between, bounding_box()));
    if (inner && (part.empty() || part == "inner"))
      faces.push_back(std::make_shared<LevelSetSurface<3>>(
        inner, !body_inside, between, bounding_box()));
    Extent<3> round = extent;
    round.limits.push_back({b, true, Along::inner});
    for (const bool top : {false, true})
      if (part.empty() || part == (top ? "top" : "bottom"))
        {
          // of a square around the disc
          const Tensor<1, 3>    outward = top ? end - start : start - end;
          const PlaneFrame      frame(top ? end : start, outward);
          std::vector<Point<3>> corners;
          for (const auto &[x, y] : {std::make_pair(-1., -1.),
                                     std::make_pair(1., -1.),
                                     std::make_pair(1., 1.),
                                     std::make_pair(-1., 1.)})
            corners.push_back(frame.to_space(Point<2>(x * radius, y * radius)));
          faces.push_back(
            std::make_shared<PlanePatch>(corners, !body_inside, round));
        }
  }

  template <int dim>
  ExpressionShape<dim>::ExpressionShape(const std::string &expression,
                                        const std::string &place,
                                        const double       length)
    : expression(expression, place, 1, {}, false)
    , text(expression)
    , place(place)
    , length(length)
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
    return unlimited_box<dim>();
  }

  template <int dim>
  Overlap
  ExpressionShape<dim>::overlap(const ConvexPolytope<dim> &cell) const
  {
    return overlap_by_values<dim>(
      [this](const Point<dim> &p) { return level(p); }, cell);
  }

  template <int dim>
  void
  ExpressionShape<dim>::add_faces(const std::string &,
                                  const bool                  body_inside,
                                  const Extent<dim>          &extent,
                                  typename Shape<dim>::Faces &faces) const
  {
    faces.push_back(std::make_shared<LevelSetSurface<dim>>(
      std::make_shared<ExpressionShape<dim>>(*this),
      body_inside,
      extent,
      unlimited_box<dim>()));
  }

  template <int dim>
  double
  ExpressionShape<dim>::value(const Point<dim> &x) const
  {
    return expression.value(x);
  }

  template <int dim>
  Tensor<1, dim>
  ExpressionShape<dim>::gradient(const Point<dim> &x, const double length) const
  {
    // step ~ eps^(1/3)
    const double   h = 1e-5 * length;
    Tensor<1, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> e = h * Point<dim>::unit_vector(d);
        gradient[d] =
          (expression.value(x + e) - expression.value(x - e)) / (2. * h);
      }
    return gradient;
  }

  template <int dim>
  SymmetricTensor<2, dim>
  ExpressionShape<dim>::hessian(const Point<dim> &x, const double length) const
  {
    // step ~ eps^(1/4)
    const double            h = 2e-4 * length;
    SymmetricTensor<2, dim> hessian;
    const double            middle = expression.value(x);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> a = h * Point<dim>::unit_vector(d);
        hessian[d][d] =
          (expression.value(x + a) - 2. * middle + expression.value(x - a)) /
          (h * h);
        for (unsigned int e = d + 1; e < dim; ++e)
          {
            const Tensor<1, dim> b = h * Point<dim>::unit_vector(e);
            hessian[d][e] =
              (expression.value(x + a + b) - expression.value(x + a - b) -
               expression.value(x - a + b) + expression.value(x - a - b)) /
              (4. * h * h);
          }
      }
    return hessian;
  }

  template <int dim>
  NearestPoint<dim>
  ExpressionShape<dim>::nearest(const Point<dim> &x) const
  {
    const double scale =
      length > 0. ? length : std::max(coordinate_magnitude<dim>(x), 1e-3);
    const Tensor<1, dim> g     = gradient(x, scale);
    const double         slope = g.norm();
    const double         phi   = value(x);
    return {slope > 0. ? phi / slope : phi, -unit_or_any<dim>(g), true};
  }

  template <int dim>
  void
  ExpressionShape<dim>::add_pieces_of_part(
    const ConvexPolytope<dim>     &cell,
    const double                   sign,
    std::vector<SignedPiece<dim>> &pieces) const
  {
    // A jump of the expression all along its boundary needs a fifth of this.
    constexpr unsigned int most_evaluations = (dim == 2 ? 300000 : 3000000);
    unsigned int           n_evaluations    = 0;
    const auto             counted          = [&](const Point<dim> &p) {
      if (++n_evaluations > most_evaluations)
        {
          std::ostringstream message;
          message << place << ": found '" << text
                  << "', whose boundary has too many details in the cell at ("
                  << cell.vertex_mean()
                  << "), allowed: details of about the size of a cell";
          throw InputError(message.str());
        }
      return level(p);
    };
    add_curved_pieces<dim>(counted, false, cell, sign, pieces);
  }

  template class RoundShape<2>;
  template class RoundShape<3>;
  template class ExpressionShape<2>;
  template class ExpressionShape<3>;
} // namespace moraine
