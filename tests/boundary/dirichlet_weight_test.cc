// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/dirichlet_weight.h>

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include "../geometry/surface_cases.h"

using namespace dealii;
using namespace moraine;
using namespace moraine_tests;

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
  double          d = 0., dd = 0., p = 0., dp = 0., pp = 0.;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double phi = .3 * gauss.point(q)[0], JxW = .3 * gauss.weight(q);
      d += JxW * w.value(phi);
      dd += JxW * w.value(phi) * w.value(phi);
      p += JxW * w.derivative(phi);
      dp += JxW * w.value(phi) * w.derivative(phi);
      pp += JxW * w.derivative(phi) * w.derivative(phi);
    }
  EXPECT_NEAR(d, w.integral_value(), 1e-15);
  EXPECT_NEAR(dd, w.integral_value_squared(), 1e-15);
  EXPECT_NEAR(p, w.integral_derivative(), 1e-14);
  EXPECT_NEAR(dp, w.integral_value_derivative(), 1e-14);
  EXPECT_NEAR(pp, w.integral_derivative_squared(), 1e-13);
}

namespace
{
  template <int dim>
  SymmetricTensor<4, dim>
  stiffness()
  {
    const double lambda = 576.9, mu = 384.6;
    return lambda * outer_product(unit_symmetric_tensor<dim>(),
                                  unit_symmetric_tensor<dim>()) +
           2. * mu * identity_tensor<dim>();
  }

  /** K2 and K3 across the band by three Gauss points against closed forms. */
  template <int dim>
  void
  compare_band(const Tensor<1, dim>          &n,
               const SymmetricTensor<2, dim> &M,
               const double                   delta,
               Numbers                       &random)
  {
    const auto                  C       = stiffness<dim>();
    const unsigned int          n_nodes = 1 << dim;
    std::vector<double>         N(n_nodes);
    std::vector<Tensor<1, dim>> grad_N(n_nodes);
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        N[i]      = random.between(0., 1.);
        grad_N[i] = random.template point<dim>(-1., 1.);
      }
    const DirichletWeight w(delta);
    const QGauss<1>       gauss(3);
    const unsigned int    n_dofs = n_nodes * dim;
    FullMatrix<double>    K2(n_dofs, n_dofs), K3(n_dofs, n_dofs);
    WeightedValues<dim>   values;
    for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        values.reinit(N, grad_N, {{w, delta * gauss.point(q)[0], n, M}});
        for (unsigned int a = 0; a < n_dofs; ++a)
          for (unsigned int b = 0; b < n_dofs; ++b)
            {
              const auto   s   = C * values.B2(b / dim, b % dim);
              const double JxW = delta * gauss.weight(q);
              K2(a, b) += JxW * (values.B1(a / dim, a % dim) * s);
              K3(a, b) += JxW * (values.B2(a / dim, a % dim) * s);
            }
      }
    const Tensor<2, dim> Q = normal_stiffness<dim>(C, n), full_M = M;
    const Tensor<2, dim> MQM = full_M * Q * full_M;
    for (unsigned int a = 0; a < n_dofs; ++a)
      for (unsigned int b = 0; b < n_dofs; ++b)
        {
          const unsigned int i = a / dim, k = a % dim, j = b / dim, l = b % dim;
          Tensor<1, dim>     e_k = Point<dim>::unit_vector(k),
                         e_l     = Point<dim>::unit_vector(l);
          // weight 1/2 on what is held, 1 on what is free: ∫ d' D dn = 1 − M/2
          const SymmetricTensor<2, dim> strain =
            symmetrize(outer_product(e_k - .5 * (full_M * e_k), grad_N[i]));
          const Tensor<1, dim> traction = C * strain * n;
          EXPECT_NEAR(K2(a, b), traction * (full_M * e_l) * N[j], 1e-11);
          const double closed = 4. / (3. * delta) * N[i] * MQM[k][l] * N[j];
          EXPECT_NEAR(K3(a, b) * delta, closed * delta, 1e-11);
        }
  }

  template <int dim>
  void
  compare_all()
  {
    Numbers random(17);
    for (const double delta : {1e-6, 1e-3, .1})
      for (unsigned int i = 0; i < 5; ++i)
        {
          const auto n = random.direction<dim>();
          compare_band<dim>(n, fixed_projection<dim>(), delta, random);
          compare_band<dim>(n, direction_projection<dim>(n), delta, random);
          compare_band<dim>(n,
                            direction_projection<dim>(3. *
                                                      random.direction<dim>()),
                            delta,
                            random);
        }
  }
} // namespace

TEST(WeightedValues, BandIntegralsMatchClosedForms)
{
  compare_all<2>();
  compare_all<3>();
}

TEST(WeightedValues, AlignedRollersGiveThePapersMatrices)
{
  // x held at one wall, y at another: D = diag(d1, d2) and the rows of eq. 17
  const DirichletWeight w1(1.), w2(2.);
  const double          N = .3, d1 = w1.value(.4), d2 = w2.value(.5);
  const Tensor<1, 2>    g = Point<2>(.7, -.2), ex = Point<2>(1, 0),
                     ey = Point<2>(0, 1);
  WeightedValues<2> values;
  values.reinit({N},
                {g},
                {{w1, .4, ex, direction_projection<2>(ex)},
                 {w2, .5, ey, direction_projection<2>(ey)}});
  EXPECT_EQ(values.n_shape_functions(), 1u);
  EXPECT_DOUBLE_EQ(values.weight()[0][0], d1);
  EXPECT_DOUBLE_EQ(values.weight()[1][1], d2);
  EXPECT_DOUBLE_EQ(values.value(0)[1][1], d2 * N);
  const auto x = values.B1(0, 0) + values.B2(0, 0),
             y = values.B1(0, 1) + values.B2(0, 1);
  EXPECT_DOUBLE_EQ(x[0][0], d1 * g[0] + N * w1.derivative(.4));
  EXPECT_DOUBLE_EQ(x[1][1], 0.);
  EXPECT_DOUBLE_EQ(2. * x[0][1], d1 * g[1]);
  EXPECT_DOUBLE_EQ(y[1][1], d2 * g[1] + N * w2.derivative(.5));
  EXPECT_DOUBLE_EQ(2. * y[0][1], d2 * g[0]);
}

TEST(WeightedValues, DerivativeOfTwoObliqueBoundaries)
{
  // against differences of D, where the factors do not commute
  Numbers               random(19);
  const DirichletWeight w1(1.), w2(1.5);
  const auto            n1 = random.direction<3>(), n2 = random.direction<3>();
  const auto            at = [&](const Point<3> &x) {
    WeightedValues<3> values;
    values.reinit({1.},
                  {Tensor<1, 3>()},
                  {{w1, .4 + n1 * x, n1, direction_projection<3>(n1)},
                   {w2, .5 + n2 * x, n2, direction_projection<3>(n2)}});
    return values;
  };
  const double h = 1e-5;
  for (unsigned int l = 0; l < 3; ++l)
    {
      const Point<3> step = Point<3>(h * Point<3>::unit_vector(l));
      const auto     difference =
        (at(step).weight() - at(-1. * step).weight()) / (2. * h);
      EXPECT_NEAR((difference - at({}).weight_derivative(l)).norm(), 0., 1e-9);
    }
}
