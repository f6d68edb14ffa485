// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// A material that answers in tensors, against closed forms.

#include "transversely_isotropic.h"

#include <moraine/material/linear_elastic.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace dealii;
using moraine::StepTime;
using moraine::StrainMeasure;
using moraine::TensorState;
using moraine::TransverseConstants;
using moraine::TransverselyIsotropic;

namespace
{
  using Stress = SymmetricTensor<2, 3>;
  using Matrix = Tensor<2, 3>;

  /** Of slate, about [GPa]. */
  constexpr TransverseConstants slate{50., 90., 0.2, 0.3, 25.};

  Tensor<1, 3>
  direction(const double angle)
  {
    return Tensor<1, 3>({std::cos(angle), std::sin(angle), 0.});
  }

  TensorState
  respond(const TransverselyIsotropic &material,
          const StrainMeasure          measure,
          TensorState                  point)
  {
    material.respond(StepTime(), measure, ArrayView<TensorState>(&point, 1));
    return point;
  }

  /** The strain that uniaxial stress 1 in direction @p n causes. */
  Stress
  strain_of_pull(const TransverselyIsotropic &material, const Tensor<1, 3> &n)
  {
    return invert(material.stiffness()) * symmetrize(outer_product(n, n));
  }

  Matrix
  rotation(const double a, const double b)
  {
    const Matrix about_z({{std::cos(a), -std::sin(a), 0},
                          {std::sin(a), std::cos(a), 0},
                          {0, 0, 1}});
    const Matrix about_x({{1, 0, 0},
                          {0, std::cos(b), -std::sin(b)},
                          {0, std::sin(b), std::cos(b)}});
    return about_z * about_x;
  }

  const Matrix
    stretched({{1.1, 0.05, 0.02}, {-0.03, 0.95, 0.04}, {0, 0.1, 1.02}});
} // namespace



TEST(TransverselyIsotropic, PullAlongAndAcross)
{
  const auto                 &c = slate;
  const TransverselyIsotropic material(c, direction(0.), 1.);
  const Stress                along = strain_of_pull(material, direction(0.));
  EXPECT_NEAR(along[0][0], 1 / c.axial_modulus, 1e-15);
  EXPECT_NEAR(along[1][1], -c.axial_ratio / c.axial_modulus, 1e-15);
  EXPECT_NEAR(along[2][2], -c.axial_ratio / c.axial_modulus, 1e-15);
  const Stress across = strain_of_pull(material, direction(numbers::PI_2));
  EXPECT_NEAR(across[0][0], -c.axial_ratio / c.axial_modulus, 1e-15);
  EXPECT_NEAR(across[1][1], 1 / c.transverse_modulus, 1e-15);
  EXPECT_NEAR(across[2][2], -c.transverse_ratio / c.transverse_modulus, 1e-15);
}



// Lekhnitskii 1963: the modulus at an angle to the axis.
TEST(TransverselyIsotropic, PullAtAnAngle)
{
  const auto &c = slate;
  for (const double axis : {0., 0.4, 1.9})
    {
      const TransverselyIsotropic material(c, 3. * direction(axis), 1.);
      for (double angle = 0; angle < 3.2; angle += 0.2)
        {
          const double C2 = std::pow(std::cos(angle), 2), S2 = 1 - C2;
          const double compliance =
            C2 * C2 / c.axial_modulus + S2 * S2 / c.transverse_modulus +
            (1 / c.axial_shear_modulus - 2 * c.axial_ratio / c.axial_modulus) *
              C2 * S2;
          const Tensor<1, 3> n = direction(axis + angle);
          EXPECT_NEAR(strain_of_pull(material, n) * n * n, compliance, 1e-15);
        }
    }
}



TEST(TransverselyIsotropic, Shear)
{
  const auto                 &c = slate;
  const TransverselyIsotropic material(c, direction(0.), 1.);
  const double G_t = c.transverse_modulus / (2 * (1 + c.transverse_ratio));
  EXPECT_NEAR(material.stiffness()[0][1][0][1], c.axial_shear_modulus, 1e-13);
  EXPECT_NEAR(material.stiffness()[0][2][0][2], c.axial_shear_modulus, 1e-13);
  EXPECT_NEAR(material.stiffness()[1][2][1][2], G_t, 1e-13);
}



TEST(TransverselyIsotropic, AddsToTheStressAtSmallStrain)
{
  const TransverselyIsotropic material(slate, direction(0.3), 1.);
  TensorState                 point;
  point.strain_increment[0][1] = 1e-3;
  point.strain_increment[2][2] = -2e-3;
  point.stress[0][0]           = 5;
  const TensorState answer     = respond(material, StrainMeasure::small, point);
  EXPECT_NEAR((answer.stress - point.stress -
               material.stiffness() * point.strain_increment)
                .norm(),
              0.,
              1e-14);
  EXPECT_EQ((answer.tangent - material.stiffness()).norm(), 0.);
}



TEST(TransverselyIsotropic, WithEqualConstantsItIsHookes)
{
  const double                 E = 200, nu = 0.25;
  const TransverselyIsotropic  material({E, E, nu, nu, E / (2 * (1 + nu))},
                                       direction(0.7),
                                       1.);
  const moraine::LameConstants lame = moraine::lame_constants(E, nu);
  const SymmetricTensor<4, 3>  C =
    lame.lambda *
      outer_product(unit_symmetric_tensor<3>(), unit_symmetric_tensor<3>()) +
    2 * lame.mu * identity_tensor<3>();
  EXPECT_NEAR((material.stiffness() - C).norm(), 0., 1e-11);
  EXPECT_NEAR(material.elastic_stiffness().lambda, lame.lambda, 1e-11);
  EXPECT_NEAR(material.elastic_stiffness().mu, lame.mu, 1e-11);
}



TEST(TransverselyIsotropic, TurnsWithTheMaterial)
{
  const TransverselyIsotropic material(slate, direction(0.3), 1.);
  const Matrix                R = rotation(1.1, -0.8);
  TensorState                 point;
  point.F            = R;
  TensorState answer = respond(material, StrainMeasure::finite, point);
  EXPECT_NEAR(answer.stress.norm(), 0., 1e-13);

  point.F             = stretched;
  const Matrix tau    = respond(material, StrainMeasure::finite, point).stress;
  point.F             = R * stretched;
  const Matrix turned = respond(material, StrainMeasure::finite, point).stress;
  EXPECT_NEAR((turned - R * tau * transpose(R)).norm(), 0., 1e-12);
  EXPECT_GT(tau.norm(), 1.);
}



// L_v tau = dtau/dt - l tau - tau l^T = c : d, with the velocity gradient l.
TEST(TransverselyIsotropic, SpatialTangentIsTheDerivative)
{
  const TransverselyIsotropic material(slate, direction(0.3), 1.);
  TensorState                 point;
  point.F                  = stretched;
  const TensorState answer = respond(material, StrainMeasure::finite, point);
  const Matrix      tau    = answer.stress;
  const Matrix      l({{0.3, -0.4, 0.2}, {0.1, 0.5, -0.3}, {0.6, 0.2, -0.1}});
  const double      h  = 1e-5;
  const auto        at = [&](const double t) {
    TensorState moved;
    moved.F =
      (static_cast<Matrix>(unit_symmetric_tensor<3>()) + t * l) * stretched;
    return static_cast<Matrix>(
      respond(material, StrainMeasure::finite, moved).stress);
  };
  const Matrix rate = (at(h) - at(-h)) / (2 * h) - l * tau - tau * transpose(l);
  const Matrix c_d  = answer.tangent * symmetrize(l);
  EXPECT_NEAR((rate - c_d).norm() / c_d.norm(), 0., 1e-8);
}
