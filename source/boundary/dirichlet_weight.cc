// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/dirichlet_weight.h>

#include <deal.II/base/exceptions.h>

namespace moraine
{
  using namespace dealii;

  DirichletWeight::DirichletWeight(const double delta)
    : delta(delta)
  {
    Assert(delta > 0., ExcMessage("The band width must be positive."));
  }

  double
  DirichletWeight::value(const double phi) const
  {
    if (phi < 0.)
      return 0.;
    if (phi > delta)
      return 1.;
    const double s = 1. - phi / delta;
    return 1. - s * s;
  }

  double
  DirichletWeight::derivative(const double phi) const
  {
    return phi < 0. || phi > delta ? 0. : 2. / delta * (1. - phi / delta);
  }

  double
  DirichletWeight::integral_derivative_squared() const
  {
    return 4. / (3. * delta);
  }
} // namespace moraine
