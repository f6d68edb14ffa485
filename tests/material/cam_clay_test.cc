// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Modified Cam-clay at one point: closed forms of undrained and drained tests,
// tangents against differences, random paths.

#include <moraine/material/cam_clay.h>
#include <moraine/material/material_test.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cam_clay_test
{
  using namespace dealii;
  using moraine::CamClay;
  using moraine::CamClayParameters;
  using moraine::MaterialTest;
  using moraine::MaterialTestLeg;
  using moraine::PrincipalState;
  using moraine::StrainMeasure;
  using State = CamClayParameters::CriticalState;

  namespace
  {
    // M = 1.2
    constexpr double M = 1.2, lambda = 0.1, kappa = 0.02;

    CamClayParameters
    clay(const State state = State::lode_angle)
    {
      CamClayParameters result;
      result.friction_angle = std::asin(0.5);
      result.compression    = lambda;
      result.swelling       = kappa;
      result.shear_modulus  = 4000;
      result.least_pressure = 1;
      result.normal_K0      = 0.5;
      result.critical_state = state;
      return result;
    }

    SymmetricTensor<2, 3>
    pressure(const double p)
    {
      return -p * unit_symmetric_tensor<3>();
    }

    /** Clay that was loaded by an isotropic pressure of @p OCR times the
     * present. initialise() goes through the vertical stress. */
    std::shared_ptr<const CamClay>
    isotropic(CamClayParameters parameters, const double OCR)
    {
      parameters.normal_K0 = 1;
      parameters.OCR       = OCR;
      return std::make_shared<CamClay>(parameters);
    }

    double
    p_of(const MaterialTest &test)
    {
      return -trace(test.stress()) / 3;
    }

    double
    q_of(const MaterialTest &test)
    {
      return test.stress()[0][0] - test.stress()[2][2];
    }

    /** Axial strain -@p axial; xx and yy: stress stays, or the volume, or
     * none. */
    enum class Side
    {
      stress,
      volume,
      none
    };

    void
    compress(MaterialTest      &test,
             const double       axial,
             const unsigned int n_steps,
             const Side         side)
    {
      MaterialTestLeg leg;
      for (unsigned int I = 0; I < 6; ++I)
        leg.sums[I].of_strain[I] = 1;
      leg.values[2] = -axial;
      for (unsigned int I = 0; I < 2; ++I)
        if (side == Side::stress)
          {
            leg.sums[I].of_strain[I] = 0;
            leg.sums[I].of_stress[I] = 1;
          }
        else if (side == Side::volume)
          leg.sums[I].of_strain[2] = 0.5;
      leg.n_steps = n_steps;
      test.lead(leg, [&]() { ASSERT_LE(test.tangent_error(), 1e-4); });
    }

    /** q = 0.9 p on the way of an undrained test, from the closed form. */
    double
    undrained_strain(const double eta)
    {
      return 2 * (1 - kappa / lambda) * kappa / M *
             (std::atanh(eta / M) - std::atan(eta / M));
    }
  } // namespace



  // Critical states, p_f = p_0 (OCR/2)^(1 - kappa/lambda).
  TEST(CamClay, Undrained)
  {
    for (const StrainMeasure measure :
         {StrainMeasure::small, StrainMeasure::finite})
      for (const double OCR : {1., 2., 4.})
        {
          MaterialTest test(isotropic(clay(), OCR), measure, pressure(100));
          compress(test, 0.6, 300, Side::volume);
          const double p_f = 100 * std::pow(OCR / 2, 1 - kappa / lambda);
          EXPECT_NEAR(p_of(test), p_f, 2e-3 * p_f);
          EXPECT_NEAR(q_of(test), M * p_of(test), 1e-3 * p_f);
          EXPECT_NEAR(test.internal()[2], p_of(test), 1e-9);
        }
  }

  // Of steps of finite size to a shear strain of 5 %, and their limit.
  TEST(CamClay, UndrainedSteps)
  {
    for (const auto &[n, p] : std::vector<std::pair<unsigned int, double>>{
           {10, 58.750}, {100, 58.193}, {1000, 58.140}})
      {
        MaterialTest test(isotropic(clay(), 1),
                          StrainMeasure::small,
                          pressure(100));
        compress(test, 0.05, n, Side::volume);
        EXPECT_NEAR(p_of(test), p, 5.1e-4);
      }
    MaterialTest test(isotropic(clay(), 1),
                      StrainMeasure::finite,
                      pressure(100));
    compress(test, 0.014033577, 2000, Side::volume);
    EXPECT_NEAR(undrained_strain(0.9) + 62.977655 / 12000, 0.014033577, 1e-8);
    EXPECT_NEAR(p_of(test), 69.975173, 0.01);
    EXPECT_NEAR(q_of(test), 62.977655, 0.01);
  }

  // sigma_3 = 100: eta = 0.9 and the critical state.
  TEST(CamClay, Drained)
  {
    MaterialTest test(isotropic(clay(), 1),
                      StrainMeasure::small,
                      pressure(100));
    compress(test, 0.106739342, 2000, Side::stress);
    EXPECT_NEAR(q_of(test), 128.571429, 0.03);
    EXPECT_NEAR(p_of(test), 142.857143, 0.01);
    const auto volume = [&]() {
      return -(test.strain()[0] + test.strain()[1] + test.strain()[2]);
    };
    EXPECT_NEAR(volume(), 0.071370463, 2e-5);
    // A leg begins where the one before ended: to 60 %.
    compress(test, 0.8, 400, Side::stress);
    EXPECT_NEAR(q_of(test), 200, 0.3);
    EXPECT_NEAR(p_of(test), 166.666667, 0.1);
    EXPECT_NEAR(volume(), 0.106534337, 1e-4);
  }

  TEST(CamClay, Oedometer)
  {
    MaterialTest test(isotropic(clay(), 1),
                      StrainMeasure::small,
                      pressure(100));
    for (const auto &[strain, sigma, K] :
         std::vector<std::array<double, 3>>{{{0.05, 193.1433, 0.643509}},
                                            {{0.1, 318.1017, 0.653062}}})
      {
        compress(test, strain, 1000, Side::none);
        EXPECT_NEAR(-test.stress()[2][2], sigma, 0.02);
        EXPECT_NEAR(test.stress()[0][0] / test.stress()[2][2], K, 2e-5);
      }
  }

  // OCR 2, POP, and a start beyond the surface.
  TEST(CamClay, Start)
  {
    CamClayParameters of = clay();
    of.OCR               = 2;
    SymmetricTensor<2, 3> stress;
    stress[2][2] = -100;
    stress[0][0] = stress[1][1] = -70;
    std::vector<double> internal(3);
    CamClay(of).initialise(stress, 2, internal.data());
    EXPECT_NEAR(internal[0], 185.4167, 5e-5);
    EXPECT_NEAR(CamClay(of).K0(100, internal.data()), std::sqrt(0.5), 1e-12);
    of.OCR = 1;
    of.POP = 100;
    CamClay(of).initialise(stress, 2, internal.data());
    EXPECT_NEAR(internal[0], 185.4167, 5e-5);

    // The shear stress 2 K0 = 0.2 is beyond.
    stress[0][0] = stress[1][1] = -10;
    of.POP                      = 0;
    const MaterialTest test(std::make_shared<CamClay>(of),
                            StrainMeasure::finite,
                            stress);
    EXPECT_GT((test.stress() - stress).norm(), 5);
  }

  // q/p at large undrained strain by the Lode angle. In plane strain the flow
  // out of the plane vanishes: of Sheng's M that is at 33.09 degrees.
  TEST(CamClay, CriticalStates)
  {
    for (const auto &[state, in_extension, angle_in_plane_strain] :
         std::vector<std::tuple<State, double, double>>{
           {State::lode_angle, 6. / 7, 33.09},
           {State::circle_in_compression, 1.2, 43.85},
           {State::circle_in_plane_strain, std::sqrt(3.) / 2, 30}})
      {
        MaterialTest extension(isotropic(clay(state), 1),
                               StrainMeasure::small,
                               pressure(100));
        compress(extension, -0.6, 200, Side::volume);
        EXPECT_NEAR(-q_of(extension) / p_of(extension), in_extension, 2e-3);

        MaterialTest    plane(isotropic(clay(state), 1),
                           StrainMeasure::small,
                           pressure(100));
        MaterialTestLeg leg;
        for (unsigned int I = 0; I < 6; ++I)
          leg.sums[I].of_strain[I] = 1;
        leg.values[2] = -0.6;
        leg.values[0] = 0.6;
        leg.n_steps   = 200;
        plane.lead(leg, []() {});
        const auto  &s = plane.stress();
        const double angle =
          std::asin((s[0][0] - s[2][2]) / -(s[0][0] + s[2][2])) * 180 /
          numbers::PI;
        EXPECT_NEAR(angle, angle_in_plane_strain, 0.1);
      }
  }

  // tan(phi) over F, but the surface that the soil starts with.
  TEST(CamClay, StrengthOverFactor)
  {
    const CamClay         full(clay());
    const auto            half = full.with_strength_over(2);
    std::vector<double>   at_full(3), at_half(3);
    SymmetricTensor<2, 3> stress = pressure(80);
    full.initialise(stress, 2, at_full.data());
    half->initialise(stress, 2, at_half.data());
    EXPECT_EQ(at_full, at_half);
    EXPECT_EQ(full.K0(80, at_full.data()), half->K0(80, at_half.data()));

    CamClayParameters of = clay();
    of.normal_K0         = 1;
    MaterialTest test(CamClay(of).with_strength_over(2),
                      StrainMeasure::small,
                      pressure(100));
    compress(test, 0.6, 200, Side::volume);
    const double sin_phi = std::sin(std::atan(std::tan(of.friction_angle) / 2));
    EXPECT_NEAR(q_of(test) / p_of(test), 6 * sin_phi / (3 - sin_phi), 2e-3);
  }

  // elastic_strain_of() and the energy, whose derivative is the stress.
  TEST(CamClay, Elasticity)
  {
    CamClayParameters of = clay();
    of.shear_modulus     = 30;
    const CamClay       material(of);
    std::vector<double> internal{1e9, 0, 0}; // elastic
    for (const double volume : {-0.03, -0.005, 0.01, 0.0199, 0.03, 0.15})
      {
        const Tensor<1, 3> strain(
          {-volume / 3 + 0.004, -volume / 3 + 0.001, -volume / 3 - 0.005});
        const auto respond = [&](const Tensor<1, 3> &e) {
          PrincipalState at;
          at.strain   = e;
          at.internal = internal.data();
          material.respond({}, ArrayView<PrincipalState>(&at, 1));
          return at;
        };
        const auto energy = [&](const Tensor<1, 3> &e) {
          const moraine::ElasticPoint point{e, internal.data()};
          double                      result;
          material.stored_energies(
            ArrayView<const moraine::ElasticPoint>(&point, 1),
            ArrayView<double>(&result, 1));
          return result;
        };
        if (volume <= 0) // tension is beyond the surface
          continue;
        const PrincipalState  at = respond(strain);
        SymmetricTensor<2, 3> stress;
        for (unsigned int A = 0; A < 3; ++A)
          {
            stress[A][A]    = at.stress[A];
            Tensor<1, 3> up = strain, down = strain;
            up[A] += 1e-6;
            down[A] -= 1e-6;
            EXPECT_NEAR((energy(up) - energy(down)) / 2e-6,
                        at.stress[A],
                        1e-6 * (1 + at.stress.norm()));
            for (unsigned int B = 0; B < 3; ++B)
              EXPECT_NEAR((respond(up).stress[B] - respond(down).stress[B]) /
                            2e-6,
                          at.tangent[B][A],
                          1e-5 * at.tangent.norm());
          }
        const auto back = material.elastic_strain_of(stress, internal.data());
        for (unsigned int A = 0; A < 3; ++A)
          EXPECT_NEAR(back[A][A], strain[A], 1e-13);
      }
  }

  // Three steps of random size and direction from random states: a stress on or
  // within the surface, at which the material rests, and its tangent.
  TEST(CamClay, RandomPaths)
  {
    std::mt19937                           engine(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    unsigned int                           failed = 0, steep = 0;
    for (unsigned int path = 0; path < 4000; ++path)
      {
        CamClayParameters of =
          clay(path % 2 ? State::lode_angle : State::circle_in_plane_strain);
        if (path % 3 == 0)
          of.shear_modulus = 400;
        const CamClay       material(of);
        const double        p_c = 100 * std::pow(10, uniform(engine));
        std::vector<double> internal{p_c, 0, 0};
        Tensor<1, 3>        strain;
        for (unsigned int A = 0; A < 3; ++A)
          strain[A] = -kappa * (1 + std::log(0.5 * p_c)) / 3;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const double size  = 0.1 * std::pow(0.2, i);
            Tensor<1, 3> trial = strain;
            for (unsigned int A = 0; A < 3; ++A)
              trial[A] += size * uniform(engine);
            const auto respond = [&](const Tensor<1, 3>  &e,
                                     std::vector<double> &variables) {
              PrincipalState at;
              at.strain   = e;
              at.internal = variables.data();
              material.respond({}, ArrayView<PrincipalState>(&at, 1));
              return at;
            };
            std::vector<double>  variables = internal;
            const PrincipalState at        = respond(trial, variables);
            if (!std::isfinite(at.stress.norm()))
              {
                ++failed;
                break;
              }
            ASSERT_LE(material.yield_function(at.stress, variables.data()),
                      1e-9 * variables[0] * variables[0]);
            ASSERT_GE(variables[1], internal[1]);
            std::vector<double>  again = variables;
            const PrincipalState rests = respond(at.strain, again);
            ASSERT_LE((rests.stress - at.stress).norm(),
                      1e-7 * (1 + at.stress.norm()));
            double error = 0;
            for (unsigned int A = 0; A < 3; ++A)
              {
                Tensor<1, 3> up = trial, down = trial;
                up[A] += 1e-8;
                down[A] -= 1e-8;
                std::vector<double> u = internal, d = internal;
                const auto          quotient =
                  (respond(up, u).stress - respond(down, d).stress) / 2e-8;
                for (unsigned int B = 0; B < 3; ++B)
                  error =
                    std::max(error, std::abs(quotient[B] - at.tangent[B][A]));
              }
            steep += error > 1e-4 * at.tangent.norm();
            strain   = at.strain;
            internal = variables;
          }
      }
    EXPECT_EQ(failed, 0u);
    EXPECT_LE(steep, 12u); // where a difference goes over a kink
  }
} // namespace cam_clay_test
