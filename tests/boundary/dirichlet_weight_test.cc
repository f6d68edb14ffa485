// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/dirichlet_weight.h>

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

using namespace dealii;
using namespace moraine;

TEST(DirichletWeight, ValuesAndIntegrals)
{
  const DirichletWeight w(0.3);
  EXPECT_EQ(w.value(-1.), 0.);
  EXPECT_EQ(w.value(0.), 0.);
  EXPECT_DOUBLE_EQ(w.value(.15), .75);
  EXPECT_EQ(w.value(.31), 1.);
  EXPECT_EQ(w.derivative(-1e-9), 0.);
  EXPECT_DOUBLE_EQ(w.derivative(0.), 2. / .3);
  EXPECT_EQ(w.derivative(.31), 0.);
  EXPECT_NEAR((w.value(.1 + 1e-6) - w.value(.1 - 1e-6)) / 2e-6,
              w.derivative(.1),
              1e-9);
  const QGauss<1> gauss(3);
  double          p = 0., dp = 0., pp = 0.;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double phi = .3 * gauss.point(q)[0], JxW = .3 * gauss.weight(q);
      p += JxW * w.derivative(phi);
      dp += JxW * w.value(phi) * w.derivative(phi);
      pp += JxW * w.derivative(phi) * w.derivative(phi);
    }
  EXPECT_NEAR(p, w.integral_derivative(), 1e-14);
  EXPECT_NEAR(dp, w.integral_value_derivative(), 1e-14);
  EXPECT_NEAR(pp, w.integral_derivative_squared(), 1e-13);
}
