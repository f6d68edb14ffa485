// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/surface.h>
#include <moraine/core/exceptions.h>

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

  /** The direction of v, or any where v is zero. */
  template <int dim>
  Tensor<1, dim>
  unit_or_any(const Tensor<1, dim> &v)
  {
    const double length = v.norm();
    return length > 0. ? v / length : Point<dim>::unit_vector(0);
  }

  void
  check_radius(const double radius)
  {
    if (!(radius > 0.) || !std::isfinite(radius))
      throw InputError("a radius must be positive, found " +
                       std::to_string(radius));
  }

#define INSTANTIATE(dim)                     \
  template BoundingBox<dim> unlimited_box(); \
  template Tensor<1, dim>   unit_or_any(const Tensor<1, dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
