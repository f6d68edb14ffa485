// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/curved_surfaces.h>

#include <moraine/geometry/cell_cut.h>
#include <moraine/core/exceptions.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  RoundSurface::RoundSurface(const double radius, const bool body_inside)
    : radius(radius)
    , sign(body_inside ? 1. : -1.)
  {
    check_radius(radius);
  }

  double
  RoundSurface::level(const Point<3> &x) const
  {
    return sign * (radius - radial(x).norm());
  }

  Tensor<1, 3>
  RoundSurface::normal(const Point<3> &x) const
  {
    return sign * unit_or_any<3>(radial(x));
  }

  // (R² − r²)/(2R) has the zeros of the distance and is smooth at the centre
  double
  RoundSurface::function_value(const Point<3> &x) const
  {
    return sign * (radius * radius - radial(x).norm_square()) / (2. * radius);
  }

  Tensor<1, 3>
  RoundSurface::function_gradient(const Point<3> &x, const double) const
  {
    return -sign / radius * radial(x);
  }

  Sphere::Sphere(const Point<3> &centre,
                 const double    radius,
                 const bool      body_inside)
    : RoundSurface(radius, body_inside)
    , centre(centre)
  {}

  Tensor<1, 3>
  Sphere::radial(const Point<3> &x) const
  {
    return x - centre;
  }

  BoundingBox<3>
  Sphere::bounding_box() const
  {
    const Tensor<1, 3> reach({radius, radius, radius});
    return BoundingBox<3>({centre - reach, centre + reach});
  }

  SymmetricTensor<2, 3>
  Sphere::function_hessian(const Point<3> &, const double) const
  {
    return -sign / radius * unit_symmetric_tensor<3>();
  }

  Point<3>
  Sphere::foot_point(const Point<3> &x) const
  {
    return centre + radius * unit_or_any<3>(radial(x));
  }

  Cylinder::Cylinder(const Point<3> &axis_start,
                     const Point<3> &axis_end,
                     const double    radius,
                     const bool      body_inside)
    : RoundSurface(radius, body_inside)
    , start(axis_start)
    , end(axis_end)
    , axis(axis_end - axis_start)
  {
    if (!(axis.norm() > 0.))
      throw InputError("the axis of a cylinder must have a length");
    axis /= axis.norm();
    limits = {{axis, axis * start}, {-axis, -(axis * end)}};
  }

  Tensor<1, 3>
  Cylinder::radial(const Point<3> &x) const
  {
    return (x - start) - ((x - start) * axis) * axis;
  }

  BoundingBox<3>
  Cylinder::bounding_box() const
  {
    Tensor<1, 3> reach;
    for (unsigned int d = 0; d < 3; ++d)
      reach[d] = radius * std::sqrt(std::max(0., 1. - axis[d] * axis[d]));
    return BoundingBox<3>(std::vector<Point<3>>{
      start - reach, start + reach, end - reach, end + reach});
  }

  SymmetricTensor<2, 3>
  Cylinder::function_hessian(const Point<3> &, const double) const
  {
    return -sign / radius *
           (unit_symmetric_tensor<3>() - symmetrize(outer_product(axis, axis)));
  }

  Point<3>
  Cylinder::foot_point(const Point<3> &x) const
  {
    const Tensor<1, 3> r       = radial(x);
    Tensor<1, 3>       outward = unit_or_any<3>(r);
    // on the axis r is round-off in any direction
    outward -= (outward * axis) * axis;
    return x - r + radius * unit_or_any<3>(outward);
  }

  template <int dim>
  ExpressionSurface<dim>::ExpressionSurface(const std::string      &expression,
                                            const std::string      &place,
                                            const BoundingBox<dim> &extent)
    : function(expression, place, 1, {}, false)
    , box(extent)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> e = Point<dim>::unit_vector(d);
        if (box.lower_bound(d) > -unlimited_extent)
          this->limits.push_back({e, box.lower_bound(d)});
        if (box.upper_bound(d) < unlimited_extent)
          this->limits.push_back({-e, -box.upper_bound(d)});
      }
  }

  template <int dim>
  double
  ExpressionSurface<dim>::length_near(const Point<dim> &x) const
  {
    const double largest = coordinate_magnitude<dim>(x);
    if (!this->limits.empty())
      {
        const double side = box.side_length(0);
        return side < unlimited_extent ? side : std::max(largest, 1e-3);
      }
    return std::max(largest, 1e-3);
  }

  template <int dim>
  double
  ExpressionSurface<dim>::level(const Point<dim> &x) const
  {
    const double slope = function_gradient(x, length_near(x)).norm();
    const double value = function_value(x);
    return slope > 0. ? value / slope : value;
  }

  template <int dim>
  Tensor<1, dim>
  ExpressionSurface<dim>::normal(const Point<dim> &x) const
  {
    return -unit_or_any<dim>(function_gradient(x, length_near(x)));
  }

  template <int dim>
  BoundingBox<dim>
  ExpressionSurface<dim>::bounding_box() const
  {
    return box;
  }

  template <int dim>
  double
  ExpressionSurface<dim>::function_value(const Point<dim> &x) const
  {
    return function.value(x);
  }

  template <int dim>
  Tensor<1, dim>
  ExpressionSurface<dim>::function_gradient(const Point<dim> &x,
                                            const double      length) const
  {
    // step ~ eps^(1/3)
    const double   h = 1e-5 * length;
    Tensor<1, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> e = h * Point<dim>::unit_vector(d);
        gradient[d] =
          (function.value(x + e) - function.value(x - e)) / (2. * h);
      }
    return gradient;
  }

  template <int dim>
  SymmetricTensor<2, dim>
  ExpressionSurface<dim>::function_hessian(const Point<dim> &x,
                                           const double      length) const
  {
    // step ~ eps^(1/4)
    const double            h = 2e-4 * length;
    SymmetricTensor<2, dim> hessian;
    const double            middle = function.value(x);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> a = h * Point<dim>::unit_vector(d);
        hessian[d][d] =
          (function.value(x + a) - 2. * middle + function.value(x - a)) /
          (h * h);
        for (unsigned int e = d + 1; e < dim; ++e)
          {
            const Tensor<1, dim> b = h * Point<dim>::unit_vector(e);
            hessian[d][e] =
              (function.value(x + a + b) - function.value(x + a - b) -
               function.value(x - a + b) + function.value(x - a - b)) /
              (4. * h * h);
          }
      }
    return hessian;
  }

  template <int dim>
  Point<dim>
  ExpressionSurface<dim>::foot_point(const Point<dim> &x) const
  {
    const Tensor<1, dim> g      = function_gradient(x, length_near(x));
    const double         square = g.norm_square();
    return square > 0. ? x - function_value(x) / square * g : x;
  }

  template class ExpressionSurface<2>;
  template class ExpressionSurface<3>;
} // namespace moraine
