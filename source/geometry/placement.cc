// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/placement.h>

#include <moraine/core/exceptions.h>

#include <deal.II/base/numbers.h>

#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  BoundingBox<dim>
  unlimited_box()
  {
    Point<dim> corner;
    for (unsigned int d = 0; d < dim; ++d)
      corner[d] = unlimited_extent;
    return BoundingBox<dim>({-1. * corner, corner});
  }



  template <int dim>
  BoundingBox<dim>
  intersection(const BoundingBox<dim> &a, const BoundingBox<dim> &b)
  {
    Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::max(a.lower_bound(d), b.lower_bound(d));
        upper[d] =
          std::max(lower[d], std::min(a.upper_bound(d), b.upper_bound(d)));
      }
    return BoundingBox<dim>(std::make_pair(lower, upper));
  }



  template <int dim>
  bool
  is_inside(const BoundingBox<dim> &box,
            const Point<dim>       &x,
            const double            margin)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (x[d] < box.lower_bound(d) - margin ||
          x[d] > box.upper_bound(d) + margin)
        return false;
    return true;
  }



  template <int dim>
  bool
  is_finite(const BoundingBox<dim> &box)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!(box.lower_bound(d) > -unlimited_extent &&
            box.upper_bound(d) < unlimited_extent))
        return false;
    return true;
  }



  template <int dim>
  Placement<dim>::Placement(const double          degrees,
                            const Point<dim>     &centre,
                            const Tensor<1, dim> &axis,
                            const Tensor<1, dim> &translation)
    : centre(centre)
    , translation(translation)
  {
    const double angle = degrees * numbers::PI / 180.;
    if constexpr (dim == 2)
      matrix = Physics::Transformations::Rotations::rotation_matrix_2d(angle);
    else
      matrix = Physics::Transformations::Rotations::rotation_matrix_3d(
        Point<dim>(axis / axis.norm()), angle);
    // no round-off where the exact entry is 0, 1 or -1
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        if (std::abs(matrix[i][j] - std::round(matrix[i][j])) < 4e-16)
          matrix[i][j] = std::round(matrix[i][j]);
  }



  template <int dim>
  Placement<dim>
  Placement<dim>::inverse() const
  {
    Placement<dim> result;
    result.centre      = centre + translation;
    result.translation = -translation;
    result.matrix      = transpose(matrix);
    return result;
  }



  template <int dim>
  BoundingBox<dim>
  Placement<dim>::map(const BoundingBox<dim> &box) const
  {
    if (!is_finite(box))
      return unlimited_box<dim>();
    std::vector<Point<dim>> corners;
    for (unsigned int v = 0; v < (1 << dim); ++v)
      corners.push_back(map(box.vertex(v)));
    return BoundingBox<dim>(corners);
  }



  template <int dim>
  RigidMotion<dim>::RigidMotion(const std::array<Curve, dim> &translation,
                                const Curve                  &angle,
                                const Point<dim>             &centre,
                                const Tensor<1, dim>         &axis)
    : translation(translation)
    , angle(angle)
    , centre(centre)
    , axis(axis)
  {
    if (dim == 3 && angle)
      {
        if (!(axis.norm() > 0.))
          throw InputError("the axis of a rotation must not be zero");
        this->axis /= axis.norm();
      }
  }



  template <int dim>
  Placement<dim>
  RigidMotion<dim>::pose(const double t) const
  {
    if (!moves())
      return Placement<dim>();
    const auto value = [t](const Curve &curve, const std::string &what) {
      const double result = curve ? curve(t) : 0.;
      if (!std::isfinite(result))
        throw InputError("the prescribed " + what +
                         " is not a number at t = " + std::to_string(t));
      return result;
    };
    Tensor<1, dim> shift;
    for (unsigned int d = 0; d < dim; ++d)
      shift[d] =
        value(translation[d], std::string("translation in ") + "xyz"[d]);
    const double degrees = value(angle, "rotation angle");
    return Placement<dim>(degrees, centre, axis, shift);
  }



  template <int dim>
  bool
  RigidMotion<dim>::moves() const
  {
    return angle || std::any_of(translation.begin(),
                                translation.end(),
                                [](const Curve &curve) { return bool(curve); });
  }



  template <int dim>
  double
  RigidMotion<dim>::moment(const Point<dim>     &x,
                           const Tensor<1, dim> &f,
                           const Placement<dim> &pose) const
  {
    const Tensor<1, dim> arm = x - pose.map(centre);
    if constexpr (dim == 2)
      return arm[0] * f[1] - arm[1] * f[0];
    else
      return axis * cross_product_3d(arm, f);
  }



#define INSTANTIATE(dim)                                    \
  template decltype(unlimited_box<dim>) unlimited_box<dim>; \
  template decltype(intersection<dim>)  intersection<dim>;  \
  template decltype(is_inside<dim>)     is_inside<dim>;     \
  template decltype(is_finite<dim>)     is_finite<dim>;     \
  template class Placement<dim>;                            \
  template class RigidMotion<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
