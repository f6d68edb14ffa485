// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Drucker and Prager's plasticity at one point.

#include <moraine/material/drucker_prager.h>

#include "soil_point.h"

namespace soil_point
{
  using moraine::DruckerPrager;

  namespace
  {
    constexpr auto outer = DruckerPrager::Match::outer_cone;
    constexpr auto plane = DruckerPrager::Match::plane_strain;

    SoilParameters
    softening_cone()
    {
      SoilParameters result = soil(10, 30, 10, none);
      result.cohesion       = {{0, 10}, {0.01, 12}, {0.05, 2}};
      result.friction_angle = {{0, 30}, {0.02, 33}, {0.06, 25}};
      result.dilation_angle = {{0, 10}, {0.04, 0}};
      return result;
    }
  } // namespace

  TEST(DruckerPrager, Triaxial)
  {
    const DruckerPrager cone(soil(10, 30, 30, none), outer);
    EXPECT_NEAR(-100 - triaxial(cone, -0.1), 234.641016, 1e-6);
    EXPECT_NEAR(triaxial(cone, 0.2) + 100, 100.560435, 1e-6);
    const DruckerPrager matched(soil(10, 30, 30, none));
    EXPECT_NEAR(-100 - triaxial(matched, -0.1), 135.081404, 1e-6);
    EXPECT_NEAR(triaxial(matched, 0.2) + 100, 76.421150, 1e-6);
  }

  TEST(DruckerPrager, CollapsesInPlaneStrainAsMohrCoulomb)
  {
    for (const double psi : {0., 10., 30.})
      {
        const DruckerPrager material(soil(10, 30, psi, none));
        Sample              point(material, diagonal(-100, -100, -100));
        point.drive({strain(-0.3),
                     stress(-100),
                     strain(0),
                     strain(0),
                     strain(0),
                     strain(0)},
                    300);
        EXPECT_NEAR(point.stress[0][0], -334.641016, 1e-4) << psi;
      }
  }

  TEST(DruckerPrager, Constants)
  {
    // eta and k from the yield function at two stresses.
    const std::vector<std::array<double, 3>> rows = {{{30, 0.480384, 0.832050}},
                                                     {{10, 0.488372, 0.845886}},
                                                     {{0, 0.5, 0.866025}}};
    const double                             kappa = 0;
    for (const auto &[psi, eta, xi] : rows)
      {
        const DruckerPrager material(soil(10, 30, psi, none));
        const double k = -material.yield_function(Tensor<1, 3>(), &kappa);
        EXPECT_NEAR(k, 10 * xi, 1e-5);
        EXPECT_NEAR(material.yield_function(Tensor<1, 3>({1, 1, 1}), &kappa) +
                      k,
                    eta,
                    1e-6);
        // The apex is c cot(phi), whatever psi.
        const auto at = respond(material, Tensor<1, 3>({0.01, 0.011, 0.012}));
        EXPECT_NEAR(at.stress[0], 10 / std::tan(30 * degree), 1e-12);
        EXPECT_EQ(material.has_symmetric_tangent(), psi == 30);
      }
  }

  TEST(DruckerPrager, Tangent)
  {
    for (const auto &parameters : {soil(10, 30, 30, none),
                                   soil(10, 30, 0, none),
                                   soil(10, 0, 0, none),
                                   softening_cone()})
      for (const auto match : {plane, outer})
        {
          const DruckerPrager material(parameters, match);
          Random              random;
          unsigned int        n_kinks = 0;
          for (unsigned int i = 0; i < 2000; ++i)
            {
              const auto   strain = random.vector(-5e-4, i % 2 ? 1e-3 : 1e-2);
              const double kappa  = i % 5 * 0.012;
              const double error =
                tangent_error(material, strain, {{kappa, 0}});
              n_kinks += error < 0;
              ASSERT_LE(error, 1e-5) << strain << ' ' << kappa;
            }
          EXPECT_LE(n_kinks, 5);
        }
  }

  TEST(DruckerPrager, RandomPaths)
  {
    for (const double psi : {0., 10., 30.})
      for (const auto match : {plane, outer})
        walk(DruckerPrager(soil(10, 30, psi, none), match), 15000, 3e-3);
    walk(DruckerPrager(soil(0, 30, 0, none)), 10000, 3e-3);
    walk(DruckerPrager(softening_cone()), 10000, 3e-3);
  }

  TEST(DruckerPrager, StrengthReductionAndSteepSoftening)
  {
    const double F     = 1.3;
    const double phi_F = std::atan(std::tan(30 * degree) / F) / degree;
    const auto   weak =
      DruckerPrager(soil(10, 30, 28, none)).with_strength_over(F);
    const DruckerPrager expected(soil(10 / F, phi_F, phi_F, none));
    Random              random;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const auto strain = random.vector(0, 5e-3);
        EXPECT_LE((respond(*weak, strain).stress -
                   respond(expected, strain).stress)
                    .norm(),
                  1e-10);
      }
    // phi = psi = 0: kappa = gamma / sqrt(3), and q falls by G gamma.
    const double G = moraine::lame_constants(20000, 0.3).mu;
    for (const double factor : {0.99, 1.01})
      {
        auto parameters     = soil(10, 0, 0, none);
        parameters.cohesion = {{0, 10}, {8 / (factor * std::sqrt(3.) * G), 2}};
        const auto at =
          respond(DruckerPrager(parameters), Tensor<1, 3>({6 / G, 0, -6 / G}));
        EXPECT_EQ(std::isnan(at.stress.norm()), factor > 1);
      }
  }
} // namespace soil_point
