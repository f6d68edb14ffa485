// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Mohr and Coulomb's plasticity at one point: closed forms, all sets of active
// planes as an oracle, tangents against differences, random paths.

#include <moraine/material/mohr_coulomb.h>

#include <algorithm>
#include <bitset>
#include <map>

#include "soil_point.h"

namespace soil_point
{
  using moraine::MohrCoulomb;
  using moraine::MohrCoulombReturn;
  using moraine::SoilStrengthTables;

  namespace
  {
    const double G      = moraine::lame_constants(20000, 0.3).mu;
    const double lambda = moraine::lame_constants(20000, 0.3).lambda;

    /** Friction, dilation, tensile strength, cohesion. */
    const std::vector<std::array<double, 4>> grid = {{{0, 0, none, 10}},
                                                     {{0, 0, 5, 10}},
                                                     {{0, 0, 0, 10}},
                                                     {{30, 30, none, 10}},
                                                     {{30, 10, none, 10}},
                                                     {{30, 30, 0, 10}},
                                                     {{30, 10, 0, 10}},
                                                     {{30, 0, 0, 10}},
                                                     {{30, 0, 5, 10}},
                                                     {{30, 0, 17.3, 10}},
                                                     {{45, 0, 0, 10}},
                                                     {{45, 20, 3, 10}},
                                                     {{20, 20, 10, 10}},
                                                     {{30, 10, 0, 0}},
                                                     {{30, 30, none, 0}},
                                                     {{30, 0, none, 10}},
                                                     {{45, 0, none, 10}}};

    SoilParameters
    soil_of(const std::array<double, 4> &row)
    {
      return soil(row[3], row[0], row[1], row[2]);
    }

    Tensor<1, 3>
    to_strain(const Tensor<1, 3> &stress)
    {
      return moraine::principal_strain({lambda, G}, stress);
    }

    /** Falls from a peak. */
    SoilParameters
    softening()
    {
      SoilParameters result   = soil(10, 30, 10, 0);
      result.cohesion         = {{0, 10}, {0.01, 12}, {0.05, 2}};
      result.friction_angle   = {{0, 30}, {0.02, 33}, {0.06, 25}};
      result.dilation_angle   = {{0, 10}, {0.04, 0}};
      result.tensile_strength = {{0, 4}, {0.01, 0}, {0.05, 6}};
      return result;
    }

    struct Plane
    {
      Tensor<1, 3> normal, stress;
      double       strength;
    };

    std::vector<Plane>
    all_planes(const std::array<double, 4> &row)
    {
      const double s = std::sin(row[0] * degree), t = std::sin(row[1] * degree);
      std::vector<Plane> planes;
      for (unsigned int i = 0; i < 3; ++i)
        {
          for (unsigned int j = 0; j < 3; ++j)
            {
              if (i == j)
                continue;
              Tensor<1, 3> a, b;
              a[i] = 1 + s;
              a[j] = s - 1;
              b[i] = 1 + t;
              b[j] = t - 1;
              planes.push_back({a,
                                moraine::principal_stress({lambda, G}, b),
                                2 * row[3] * std::cos(row[0] * degree)});
            }
          Tensor<1, 3> e;
          e[i] = 1;
          if (std::isfinite(row[2]))
            planes.push_back(
              {e, moraine::principal_stress({lambda, G}, e), row[2]});
        }
      return planes;
    }

    /** The returns to all sets of up to three planes that have the right signs.
     */
    std::vector<Tensor<1, 3>>
    oracle(const std::vector<Plane> &planes, const Tensor<1, 3> &trial)
    {
      const double              tolerance = 1e-10 * (trial.norm() + 10);
      std::vector<Tensor<1, 3>> answers;
      const auto                excess = [&](const Tensor<1, 3> &stress) {
        double most = 0;
        for (const Plane &plane : planes)
          most = std::max(most, plane.normal * stress - plane.strength);
        return most;
      };
      const unsigned int n = planes.size();
      for (unsigned int set = 0; set < (1u << n); ++set)
        {
          std::vector<Plane> active;
          if (std::bitset<9>(set).count() > 3)
            continue;
          for (unsigned int i = 0; i < n; ++i)
            if (set & (1u << i))
              active.push_back(planes[i]);
          // Absent ones are identities.
          Tensor<2, 3> A = unit_symmetric_tensor<3>();
          Tensor<1, 3> h;
          for (unsigned int p = 0; p < active.size(); ++p)
            {
              h[p] = active[p].normal * trial - active[p].strength;
              for (unsigned int q = 0; q < active.size(); ++q)
                A[p][q] = active[p].normal * active[q].stress;
            }
          if (std::abs(determinant(A)) < 1e-6 * G * G * G && active.size() == 3)
            continue;
          if (active.size() == 2 && std::abs(determinant(A)) < 1e-6 * G * G)
            continue;
          const Tensor<1, 3> multipliers = invert(A) * h;
          Tensor<1, 3>       stress      = trial;
          bool               right       = true;
          for (unsigned int p = 0; p < active.size(); ++p)
            {
              stress -= multipliers[p] * active[p].stress;
              right = right && multipliers[p] * G > -tolerance;
            }
          if (right && excess(stress) < tolerance)
            answers.push_back(stress);
        }
      return answers;
    }
  } // namespace

  TEST(MohrCoulomb, AllSetsOfPlanes)
  {
    for (const auto &row : grid)
      {
        SCOPED_TRACE(testing::PrintToString(row));
        const MohrCoulomb material(soil_of(row));
        const auto        planes = all_planes(row);
        const double      apex   = row[3] / std::tan(row[0] * degree);
        Random            random;
        unsigned int      n_apex = 0;
        for (unsigned int i = 0; i < 3000; ++i)
          {
            const auto   trial     = random.vector(-20, i % 2 ? 20 : 100);
            const auto   found     = respond(material, to_strain(trial));
            const auto   exact     = oracle(planes, trial);
            const double tolerance = 1e-10 * (trial.norm() + 10);
            // A convention: there is no other answer.
            if (row[1] == 0 && row[0] > 0 && row[2] == none && exact.empty())
              {
                ++n_apex;
                for (unsigned int A = 0; A < 3; ++A)
                  ASSERT_NEAR(found.stress[A], apex, tolerance);
                continue;
              }
            ASSERT_FALSE(exact.empty()) << trial;
            for (const auto &stress : exact)
              ASSERT_LE((found.stress - stress).norm(), 3 * tolerance)
                << trial << ": " << found.stress << " instead of " << stress;
            ASSERT_LE((to_strain(found.stress) - found.strain).norm(), 1e-14);
            ASSERT_NEAR(found.variables[0],
                        std::sqrt(2. / 3.) *
                          (to_strain(trial) - found.strain).norm(),
                        1e-15);
          }
        EXPECT_EQ(n_apex > 0, row[1] == 0 && row[0] > 0 && row[2] == none);
      }
  }

  TEST(MohrCoulomb, EveryRegionAndItsTangent)
  {
    std::map<unsigned int, unsigned int> n_of;
    unsigned int                         n_kinks = 0, n = 0;
    for (const auto &row : grid)
      {
        SCOPED_TRACE(testing::PrintToString(row));
        const MohrCoulomb        material(soil_of(row));
        const SoilStrengthTables strengths(soil_of(row));
        const MohrCoulombReturn  planes(strengths.at(0, 0, nullptr).value,
                                       {lambda, G});
        Random                   random;
        for (unsigned int i = 0; i < 1000; ++i, ++n)
          {
            auto         trial  = random.vector(-20, i % 2 ? 20 : 100);
            const auto   strain = to_strain(trial);
            const double error  = tangent_error(material, strain);
            n_kinks += error < 0;
            ASSERT_LE(error, 1e-6) << trial;
            const auto D = respond(material, strain).tangent;
            if (material.has_symmetric_tangent())
              {
                ASSERT_LE((D - transpose(D)).norm(), 1e-9);
              }
            std::sort(&trial[0], &trial[0] + 3, std::greater<>());
            if (planes.yield_function(trial[0], trial[2]) > 0)
              ++n_of[planes.project(trial)];
          }
        EXPECT_EQ(material.has_symmetric_tangent(), row[0] == row[1]);
      }
    EXPECT_LE(n_kinks, n / 1000);
    for (unsigned int i = 0; i < MohrCoulombReturn::n_regions; ++i)
      EXPECT_GE(n_of[i], 50) << i;
  }

  TEST(MohrCoulomb, TangentWhereStrengthChanges)
  {
    SoilParameters tresca    = soil(10, 0, 0, none);
    tresca.cohesion          = {{0, 10}, {0.01, 4}, {0.03, 5}};
    SoilParameters limited   = soil(10, 30, 10, 0);
    limited.largest_dilation = 2e-3;
    SoilParameters both      = softening();
    both.largest_dilation    = 2e-3;
    for (const auto &parameters : {softening(), tresca, limited, both})
      {
        const MohrCoulomb material(parameters);
        EXPECT_FALSE(material.has_symmetric_tangent());
        Random       random;
        unsigned int n_kinks = 0;
        for (unsigned int i = 0; i < 3000; ++i)
          {
            const auto strain = to_strain(random.vector(-20, i % 2 ? 30 : 300));
            const double kappa = i % 5 * 0.012;
            const double v     = i % 3 * 0.9e-3;
            const double error = tangent_error(material, strain, {{kappa, v}});
            n_kinks += error < 0;
            ASSERT_LE(error, 3e-6) << strain << ' ' << kappa << ' ' << i;
          }
        EXPECT_LE(n_kinks, 10);
      }
  }

  TEST(MohrCoulomb, ImplicitStrengthIsThatOfTheEnd)
  {
    // The same as perfect plasticity with the strength at the end.
    const MohrCoulomb        material(softening());
    const SoilStrengthTables strengths(softening());
    Random                   random;
    for (unsigned int i = 0; i < 1000; ++i)
      {
        const auto   strain = to_strain(random.vector(-20, 100));
        const auto   at     = respond(material, strain);
        const double kappa  = at.variables[0];
        const auto   end =
          strengths.at(kappa, strengths.segment_at(kappa), nullptr).value;
        const MohrCoulomb perfect(soil(end.cohesion,
                                       std::asin(end.sin_phi) / degree,
                                       std::asin(end.sin_psi) / degree,
                                       end.tension));
        const auto        expected = respond(perfect, strain);
        if (kappa > 0)
          {
            EXPECT_NEAR(expected.variables[0], kappa, 1e-13);
            EXPECT_LE((expected.stress - at.stress).norm(), 1e-9);
          }
      }
  }

  TEST(MohrCoulomb, SteepSoftening)
  {
    for (const std::array<double, 2> &angles :
         {std::array<double, 2>{{0, 0}}, {{30, 0}}, {{30, 10}}})
      {
        const double s        = std::sin(angles[0] * degree),
                     t        = std::sin(angles[1] * degree);
        const double steepest = (4 * lambda * s * t + 4 * G * (1 + s * t)) /
                                (2 * std::cos(angles[0] * degree) *
                                 std::sqrt(4. / 3 + 4. / 9 * t * t));
        if (s == 0)
          {
            EXPECT_NEAR(steepest, std::sqrt(3.) * G, 1e-9);
          }
        for (const double factor : {0.99, 1.01})
          {
            auto parameters     = soil(10, angles[0], angles[1], none);
            parameters.cohesion = {{0, 10}, {8 / (factor * steepest), 2}};
            const MohrCoulomb material(parameters);
            // Beyond yield, on the plane.
            const auto at =
              respond(material, to_strain(Tensor<1, 3>({16, -22, -60})));
            EXPECT_EQ(std::isnan(at.stress.norm()), factor > 1) << factor;
          }
      }
    EXPECT_NE(MohrCoulomb(softening()).why_no_stress().find("too steeply"),
              std::string::npos);
  }

  TEST(MohrCoulomb, LargestDilation)
  {
    auto parameters             = soil(10, 30, 10, none);
    parameters.largest_dilation = 2e-3;
    const MohrCoulomb material(parameters);
    EXPECT_EQ(material.internal_variables().size(), 2);
    EXPECT_EQ(MohrCoulomb(soil(10, 30, 10, 0)).internal_variables().size(), 1);
    // A plane strain path in steps of any size.
    const Controls biaxial = {
      strain(-0.03), stress(-100), strain(0), strain(0), strain(0), strain(0)};
    std::vector<double> volume;
    for (const unsigned int n_steps : {1, 7, 300})
      {
        Sample point(material, diagonal(-100, -100, -100));
        point.drive(biaxial, n_steps);
        EXPECT_NEAR(point.variables[1], 2e-3, 1e-14);
        EXPECT_NEAR(trace(point.total - point.elastic),
                    2e-3 + 300. / (3 * lambda + 2 * G),
                    1e-12);
        EXPECT_NEAR(point.stress[0][0], -334.641016, 1e-6);
      }
  }

  TEST(MohrCoulomb, RandomPaths)
  {
    for (const auto &row : grid)
      walk(MohrCoulomb(soil_of(row)), 6000, 3e-3);
    walk(MohrCoulomb(softening()), 10000, 3e-3);
    auto limited             = softening();
    limited.largest_dilation = 5e-3;
    walk(MohrCoulomb(limited), 10000, 3e-3);
  }

  TEST(MohrCoulomb, PermutedInput)
  {
    Random random;
    for (const auto &parameters : {soil(10, 30, 10, 0), softening()})
      {
        const MohrCoulomb material(parameters);
        for (unsigned int i = 0; i < 1000; ++i)
          {
            const auto                  strain = random.vector(0, 5e-3);
            const auto                  at     = respond(material, strain);
            std::array<unsigned int, 3> p{{0, 1, 2}};
            do
              {
                const auto turned =
                  respond(material,
                          Tensor<1, 3>(
                            {strain[p[0]], strain[p[1]], strain[p[2]]}));
                for (unsigned int A = 0; A < 3; ++A)
                  {
                    EXPECT_NEAR(turned.stress[A], at.stress[p[A]], 1e-10);
                    for (unsigned int B = 0; B < 3; ++B)
                      EXPECT_NEAR(turned.tangent[A][B],
                                  at.tangent[p[A]][p[B]],
                                  1e-6);
                  }
              }
            while (std::next_permutation(p.begin(), p.end()));
          }
      }
  }

  TEST(MohrCoulomb, StrengthReduction)
  {
    const double F       = 1.3;
    const auto   reduced = [&](const double phi) {
      return std::atan(std::tan(phi * degree) / F) / degree;
    };
    Random random;
    for (const double psi : {0., 10., 30.})
      {
        const auto weak =
          MohrCoulomb(soil(10, 30, psi, 5)).with_strength_over(F);
        const MohrCoulomb expected(
          soil(10 / F, reduced(30), std::min(psi, reduced(30)), 5 / F));
        EXPECT_EQ(weak->has_symmetric_tangent(), psi == 30);
        for (unsigned int i = 0; i < 200; ++i)
          {
            const auto strain = random.vector(0, 5e-3);
            const auto at     = respond(*weak, strain),
                       other  = respond(expected, strain);
            EXPECT_LE((at.stress - other.stress).norm(), 1e-10);
            EXPECT_LE((at.tangent - other.tangent).norm(), 1e-7);
          }
      }
    // Twice is once, and tables are reduced at every plastic strain.
    const auto once = MohrCoulomb(softening()).with_strength_over(1.5 * F);
    const auto both =
      MohrCoulomb(softening()).with_strength_over(1.5)->with_strength_over(F);
    for (unsigned int i = 0; i < 200; ++i)
      {
        const auto   strain = random.vector(-1e-3, 5e-3);
        const double kappa  = i % 4 * 0.015;
        const auto   at     = respond(*once, strain, {{kappa, 0}});
        EXPECT_LE(
          (at.stress - respond(*both, strain, {{kappa, 0}}).stress).norm(),
          1e-10);
        const double error = tangent_error(*once, strain, {{kappa, 0}});
        EXPECT_LE(error, 3e-6);
      }
    auto middle           = soil(10, 30, 0, none);
    middle.friction_angle = {{0, 30}, {0.1, 20}};
    const double kappa    = 0.05;
    const auto   half     = std::static_pointer_cast<const MohrCoulomb>(
      MohrCoulomb(middle).with_strength_over(F));
    const double s = std::sin(reduced(25) * degree);
    EXPECT_NEAR(half->yield_function(Tensor<1, 3>({-10, 5, 0}), &kappa),
                5 * (1 + s) + 10 * (1 - s) -
                  20 / F * std::cos(reduced(25) * degree),
                1e-12);
  }

  TEST(MohrCoulomb, Triaxial)
  {
    for (const double psi : {0., 10., 30.})
      {
        const MohrCoulomb material(soil(10, 30, psi, 0));
        EXPECT_NEAR(triaxial(material, -0.1), -334.641016, 1e-6);
        EXPECT_NEAR(triaxial(material, 0.1), -21.786328, 1e-6);
      }
  }

  TEST(MohrCoulomb, Biaxial)
  {
    const MohrCoulomb material(soil(10, 30, 10, 0));
    Sample            point(material, diagonal(-100, -100, -100));
    Controls          controls = {strain(-0.010676166),
                                  stress(-100),
                                  strain(0),
                                  strain(0),
                                  strain(0),
                                  strain(0)};
    point.drive(controls, 3);
    EXPECT_NEAR(point.total[1][1], 0.004575500, 1e-9);
    EXPECT_NEAR(point.stress[2][2], -170.392305, 1e-5);
    EXPECT_NEAR(point.stress[0][0], -334.641016, 1e-5);
    EXPECT_NEAR(point.variables[0], 0, 1e-9);
    controls[0]         = strain(-0.01);
    const double before = point.total[1][1];
    point.drive(controls, 3);
    EXPECT_NEAR((point.total[1][1] - before) / -0.01, -1.420277, 1e-6);
    EXPECT_LE(point.most_iterations, 4);
  }

  TEST(MohrCoulomb, ConstantVolume)
  {
    for (const std::array<double, 2> &row :
         {std::array<double, 2>{{10, 140.784610}}, {{0, 120}}})
      {
        const MohrCoulomb material(soil(row[0], 30, 0, 0));
        Sample            point(material, diagonal(-100, -100, -100));
        point.drive({strain(-0.1),
                     strain(0.05),
                     strain(0.05),
                     strain(0),
                     strain(0),
                     strain(0)},
                    10);
        EXPECT_NEAR(point.stress[1][1] - point.stress[0][0], row[1], 1e-6);
      }
  }

  TEST(MohrCoulomb, Oedometer)
  {
    const MohrCoulomb material(soil(0, 20, 0, 0));
    for (const unsigned int n_steps : {1, 10})
      {
        Sample point(material, SymmetricTensor<2, 3>());
        point.drive({strain(-0.01),
                     strain(0),
                     strain(0),
                     strain(0),
                     strain(0),
                     strain(0)},
                    n_steps);
        EXPECT_NEAR(point.stress[1][1] / point.stress[0][0], 0.490291, 1e-6);
        EXPECT_NEAR(point.stress[0][0], -252.45115, 1e-5);
      }
  }

  TEST(MohrCoulomb, SimpleShear)
  {
    // y is vertical.
    const auto shear =
      [](const double psi, const double gamma, const unsigned n) {
        const MohrCoulomb material(soil(0, 30, psi, 0));
        Sample            point(material, diagonal(-50, -100, -50));
        point.drive({strain(0),
                     stress(-100),
                     strain(0),
                     strain(gamma / 2),
                     strain(0),
                     strain(0)},
                    n);
        return point.stress[0][1];
      };
    EXPECT_NEAR(shear(0, 0.01, 500), 41.860, 1e-3);
    EXPECT_NEAR(shear(0, 0.04, 2000), 49.770, 1e-3);
    EXPECT_NEAR(shear(0, 0.5, 500), 50, 1e-4);
    EXPECT_NEAR(shear(10, 0.5, 500), 53.9221, 1e-4);
    EXPECT_NEAR(shear(30, 0.5, 500), 57.7350, 1e-4);
  }
} // namespace soil_point
