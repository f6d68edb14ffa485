// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Undrained materials at one point: elasticity of total stress, closed forms of
// tests of clay and sand, cavities, drainage, energies, tangents.

#include <moraine/core/exceptions.h>
#include <moraine/material/cam_clay.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/material/material_test.h>
#include <moraine/material/mohr_coulomb.h>
#include <moraine/material/neo_hookean.h>
#include <moraine/material/succession.h>
#include <moraine/material/undrained.h>
#include <moraine/material/von_mises.h>

#include "soil_point.h"

namespace undrained_test
{
  using namespace dealii;
  using moraine::CamClay;
  using moraine::CamClayParameters;
  using moraine::ElasticPoint;
  using moraine::lame_constants;
  using moraine::LameConstants;
  using moraine::LinearElastic;
  using moraine::Material;
  using moraine::MaterialPoint;
  using moraine::MaterialTest;
  using moraine::MaterialTestLeg;
  using moraine::MohrCoulomb;
  using moraine::NeoHookean;
  using moraine::PoreWaterParameters;
  using moraine::PrincipalState;
  using moraine::StepTime;
  using moraine::StrainMeasure;
  using moraine::Undrained;
  using moraine::VonMises;
  using soil_point::Random;
  using soil_point::soil;
  using Pointer = std::shared_ptr<const Material>;

  namespace
  {
    constexpr double E = 20000, nu = 0.3, nu_u = 0.495;
    constexpr double G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
    constexpr double K_w =
      2 * G / 3 * ((1 + nu_u) / (1 - 2 * nu_u) - (1 + nu) / (1 - 2 * nu));

    const Pointer skeleton = std::make_shared<LinearElastic>(E, nu, 0.);

    std::shared_ptr<const Undrained>
    undrained(const Pointer &inner, const PoreWaterParameters &water = {})
    {
      return std::make_shared<Undrained>(inner, water);
    }

    PoreWaterParameters
    water(const double modulus,
          const double suction = std::numeric_limits<double>::infinity())
    {
      PoreWaterParameters result;
      result.modulus = modulus;
      result.suction = suction;
      return result;
    }

    SymmetricTensor<2, 3>
    pressure(const double p)
    {
      return -p * unit_symmetric_tensor<3>();
    }

    Pointer
    sand(const double c, const double phi, const double psi)
    {
      return std::make_shared<MohrCoulomb>(soil(c, phi, psi, 0));
    }

    /** M = 1.2, loaded by an isotropic pressure of @p OCR times the present. */
    Pointer
    clay(const double OCR)
    {
      CamClayParameters result{};
      result.friction_angle = std::asin(0.5);
      result.compression    = 0.1;
      result.swelling       = 0.02;
      result.shear_modulus  = 4000;
      result.least_pressure = 1;
      result.normal_K0      = 1;
      result.critical_state = CamClayParameters::CriticalState::lode_angle;
      result.OCR            = OCR;
      return std::make_shared<CamClay>(result);
    }

    struct End
    {
      double q, p, excess; ///< p effective, compression positive
    };

    /** Compressed along z while the total lateral stress stays. */
    End
    triaxial(const Pointer      &material,
             const double        axial,
             const unsigned int  n_steps,
             const StrainMeasure measure = StrainMeasure::small)
    {
      MaterialTest    test(material, measure, pressure(100));
      MaterialTestLeg leg;
      for (unsigned int I = 0; I < 6; ++I)
        (I < 2 ? leg.sums[I].of_stress : leg.sums[I].of_strain)[I] = 1;
      leg.values[2] = -axial;
      leg.n_steps   = n_steps;
      test.lead(leg, [&]() { EXPECT_LE(test.tangent_error(), 1e-4); });
      const double excess = test.internal()[test.internal().size() - 2];
      return {test.stress()[0][0] - test.stress()[2][2],
              -trace(test.stress()) / 3 - excess,
              excess};
    }

    /** One answer, from internal variables @p at. */
    PrincipalState
    answer(const Material      &material,
           const Tensor<1, 3>  &strain,
           std::vector<double> &at,
           const StepTime      &time = {})
    {
      PrincipalState point;
      point.strain   = strain;
      point.internal = at.data();
      material.respond(time, ArrayView<PrincipalState>(&point, 1));
      return point;
    }

    std::vector<double>
    start_of(const Material &material, const double p = 0)
    {
      std::vector<double> internal = material.internal_at({});
      material.initialise(pressure(p), 2, internal.data());
      return internal;
    }

    double
    energy(const Material            &material,
           const Tensor<1, 3>        &strain,
           const std::vector<double> &internal)
    {
      const ElasticPoint point{strain, internal.data()};
      double             result;
      material.stored_energies(ArrayView<const ElasticPoint>(&point, 1),
                               ArrayView<double>(&result, 1));
      return result;
    }
  } // namespace



  // E_u = E' (1 + nu_u) / (1 + nu'): stress, tangent, energy.
  TEST(Undrained, ElasticIsTotalStress)
  {
    const Pointer total =
      std::make_shared<LinearElastic>(E * (1 + nu_u) / (1 + nu), nu_u, 0.);
    const auto   wet = undrained(skeleton);
    Random       random;
    const double scale = total->elastic_stiffness().lambda;
    EXPECT_NEAR(wet->elastic_stiffness().lambda / scale, 1, 1e-13);
    EXPECT_EQ(wet->elastic_stiffness().mu, skeleton->elastic_stiffness().mu);
    EXPECT_TRUE(wet->may_lock());
    for (const StrainMeasure measure :
         {StrainMeasure::small, StrainMeasure::finite})
      {
        MaterialPoint a(total, measure, {}), b(wet, measure, {});
        for (unsigned int i = 0; i < 200; ++i)
          {
            Tensor<2, 3> H;
            for (unsigned int d = 0; d < 3; ++d)
              H[d] = random.vector(0, 1e-2);
            ASSERT_TRUE(a.try_step({}, H) && b.try_step({}, H));
            ASSERT_LE((a.stress() - b.stress()).norm(), 1e-12 * scale);
            for (unsigned int I = 0; I < 6; ++I)
              for (unsigned int J = 0; J < 6; ++J)
                ASSERT_NEAR(a.tangent_matrix()[I][J],
                            b.tangent_matrix()[I][J],
                            1e-12 * scale);
            a.keep();
            b.keep();
          }
      }
    auto               internal = start_of(*wet);
    const Tensor<1, 3> e({0.01, -0.02, 0.003});
    answer(*wet, e, internal);
    EXPECT_NEAR(energy(*wet, e, internal) / energy(*total, e, {}), 1, 1e-12);
  }



  // p_e = q K_w / (K_w + M), M = K + 4/3 G, in the last of several steps.
  TEST(Undrained, Oedometer)
  {
    const double    M = K + 4. / 3. * G, q = 50;
    MaterialTestLeg leg;
    for (unsigned int I = 0; I < 6; ++I)
      (I == 2 ? leg.sums[I].of_stress : leg.sums[I].of_strain)[I] = 1;
    leg.values[2] = -q - 100;
    leg.n_steps   = 7;
    for (const auto &[of, modulus] :
         {std::make_pair(PoreWaterParameters(), K_w),
          std::make_pair(water(3e5), 3e5)})
      {
        MaterialTest test(undrained(skeleton, of),
                          StrainMeasure::small,
                          pressure(100));
        test.lead(leg, [] {});
        const double p = q * modulus / (modulus + M);
        EXPECT_NEAR(test.internal()[0] / p, 1, 1e-10);
        EXPECT_NEAR(test.stress()[0][0],
                    -100 - p - (q - p) * nu / (1 - nu),
                    1e-8);
      }
  }



  // Without dilation p' = p_0 + r q / 3 with r = K / (K + K_w), on the yield
  // surface q = M p' + k.
  TEST(Undrained, MohrCoulomb)
  {
    const double M = 1.2;
    for (const double c : {0., 10.})
      {
        const double k     = 6 * c * std::sqrt(0.75) / 2.5;
        const double limit = c > 0 ? 140.784610 : 120;
        EXPECT_NEAR(100 * M + k, limit, 1e-6);
        for (const double stiff : {K_w, 1e3 * K, 1e6 * K})
          {
            const double r = K / (K + stiff);
            const auto   end =
              triaxial(undrained(sand(c, 30, 0), water(stiff)), 0.02, 20);
            const double q = limit / (1 - M * r / 3);
            EXPECT_NEAR(end.q / q, 1, 1e-8);
            EXPECT_NEAR(end.p, 100 + r * q / 3, 1e-5);
            EXPECT_NEAR(end.excess, q / 3 * (1 - r), 1e-5);
          }
        // 0.88 % with nu_u = 0.495.
        EXPECT_NEAR(triaxial(undrained(sand(c, 30, 0)), 0.02, 20).q / limit - 1,
                    0.0087719,
                    1e-6);
      }
    const Pointer tresca =
      std::make_shared<VonMises>(E,
                                 nu,
                                 0.,
                                 std::vector<std::pair<double, double>>{
                                   {0, std::sqrt(2. / 3) * 80}});
    EXPECT_NEAR(triaxial(undrained(tresca), 0.02, 20).q, 80, 1e-8);
  }



  // p_f = p_0 (OCR / 2)^(1 - kappa / lambda) at the critical state as water
  // becomes stiff. What is left is Delta u n / (K_w lambda) of it; the error of
  // n implicit steps is 1 / n, and goes with its extrapolation.
  TEST(Undrained, CamClay)
  {
    const auto at_end = [](const double OCR, const double stiff) {
      const auto material = undrained(clay(OCR), water(stiff));
      const End  coarse   = triaxial(material, 0.3, 400),
                fine      = triaxial(material, 0.3, 800);
      EXPECT_NEAR(fine.q / fine.p, 1.2, 1e-4);
      EXPECT_NEAR(fine.excess, 100 + fine.q / 3 - fine.p, 1e-6);
      return End{2 * fine.q - coarse.q,
                 2 * fine.p - coarse.p,
                 2 * fine.excess - coarse.excess};
    };
    for (const double OCR : {1., 2., 4.})
      {
        const double p_f   = 100 * std::pow(OCR / 2, 0.8);
        const End    stiff = at_end(OCR, 1e6), rigid = at_end(OCR, 1e8);
        EXPECT_NEAR(rigid.p / p_f, 1, 1e-5) << OCR;
        // The water's volume makes ln p of the critical state larger.
        const double share = (1e-6 - 1e-8) / 0.1;
        EXPECT_NEAR(std::log(stiff.p / rigid.p) / share,
                    rigid.excess,
                    2e-3 * std::abs(rigid.excess))
          << OCR;
      }
    const End end = at_end(1, 1e8);
    EXPECT_NEAR(end.p, 57.434918, 1e-3);
    EXPECT_NEAR(end.q, 68.921901, 1e-3);
    EXPECT_NEAR(end.excess, 65.539050, 1e-3);
    // K_w / n of the stiffness at the start, 5000 of skeleton.
    const auto by_ratio = undrained(clay(1));
    const auto internal = start_of(*by_ratio, 100);
    EXPECT_NEAR(internal.back(),
                2 * 4000. / 3 * 1.495 / 0.01 - 100 / 0.02,
                1e-8);
    EXPECT_NEAR(by_ratio->elastic_stiffness_at(internal.data()).lambda,
                2 * 4000. * 0.495 / 0.01,
                1e-8);
  }



  TEST(Undrained, StiffSkeletonIsRefused)
  {
    PoreWaterParameters soft;
    soft.poisson_ratio = 0.3;
    soft.section       = "Materials/clay";
    EXPECT_NO_THROW(start_of(*undrained(clay(1), soft), 100));
    EXPECT_THROW(start_of(*undrained(clay(1), soft), 1000),
                 moraine::InputError);
  }



  // Pulled, water takes its share up to -s, then the skeleton takes all;
  // cavities close before pressure rises.
  TEST(Undrained, Cavitation)
  {
    const double  s   = 30;
    const auto    wet = undrained(skeleton, water(K_w, s));
    auto          at  = start_of(*wet);
    Tensor<1, 3>  e;
    LameConstants C  = skeleton->elastic_stiffness();
    const auto    go = [&](const double volume) {
      const Tensor<1, 3> step({0.6 * volume, 0.3 * volume, 0.1 * volume});
      e += step;
      const PrincipalState to = answer(*wet, e, at);
      EXPECT_NEAR(wet->dissipated_by_water(0,
                                           {Tensor<1, 3>(), at.data()},
                                           start_of(*wet).data()),
                  0.5 * at[0] * (0 - (0 - at[2] + at[0] / K_w)),
                  1e-12);
      return to;
    };
    const double limit = s / K_w;
    auto         to    = go(0.9 * limit);
    EXPECT_NEAR(at[0], -0.9 * s, 1e-11);
    EXPECT_NEAR(to.tangent[0][1], C.lambda + K_w, 1e-8);
    to = go(0.6 * limit);
    EXPECT_NEAR(at[0], -s, 1e-12);
    EXPECT_NEAR(at[2], 0.5 * limit, 1e-15);
    EXPECT_NEAR(to.tangent[0][1], C.lambda, 1e-9);
    const double v = 1.5 * limit;
    for (unsigned int A = 0; A < 3; ++A)
      EXPECT_NEAR(to.stress[A], C.lambda * v + 2 * C.mu * e[A] + s, 1e-9);
    // s times its volume, and that of the pressure.
    EXPECT_NEAR(energy(*wet, e, at) - energy(*skeleton, e, {}),
                0.5 * s * limit + s * 0.5 * limit,
                1e-10);
    to = go(-0.3 * limit);
    EXPECT_NEAR(at[0], -s, 1e-12);
    to = go(-0.7 * limit);
    EXPECT_NEAR(at[0], -0.5 * s, 1e-10);
    EXPECT_NEAR(at[2], 0, 1e-15);
    to = go(-0.5 * limit);
    EXPECT_NEAR(at[0], 0, 1e-10);
  }



  // In a span in which it drains the pressure falls linearly, in steps of any
  // size; later strains change nothing until the span ends.
  TEST(Undrained, Drainage)
  {
    PoreWaterParameters parameters;
    parameters.drained = {{1, 3, 4}};
    const auto   wet   = undrained(skeleton, parameters);
    auto         at    = start_of(*wet);
    Tensor<1, 3> e({0, 0, -1e-3});
    answer(*wet, e, at, {0, 1});
    const double p = K_w * 1e-3;
    EXPECT_NEAR(at[0] / p, 1, 1e-12);
    double stored = energy(*wet, e, at), work = 0, dissipated = 0;
    for (const auto &[start, end, share] :
         {std::array<double, 3>{{1, 1.3, 0.85}},
          {{1.3, 2.5, 0.25}},
          {{2.5, 3, 0}},
          {{3, 4, 0}}})
      {
        const auto   before = at;
        Tensor<1, 3> step({1e-4, 0, -3e-4});
        const double middle = 0.5 * before[0];
        e += step;
        const auto to = answer(*wet, e, at, {start, end});
        EXPECT_NEAR(at[0], share * p, 1e-12 * p);
        EXPECT_EQ(to.tangent[0][1], skeleton->elastic_stiffness().lambda);
        work += -(middle + 0.5 * at[0]) * (step[0] + step[2]);
        dissipated += wet->dissipated_by_water(e[0] + e[2],
                                               {to.strain, at.data()},
                                               before.data());
      }
    // Of the water: what was stored and what was pressed out is dissipated.
    EXPECT_NEAR(dissipated, 0.5 * p * p / K_w + work, 1e-12);
    EXPECT_GT(stored, 0);
    // Undrained again.
    e[2] -= 1e-4;
    answer(*wet, e, at, {4, 5});
    EXPECT_NEAR(at[0], K_w * 1e-4, 1e-9);

    const auto frozen = wet->with_frozen_water(5);
    e[2] -= 1e-4;
    const auto to = answer(*frozen, e, at, {5, 6});
    EXPECT_NEAR(at[0], K_w * 1e-4, 1e-9);
    EXPECT_EQ(to.tangent[0][1], skeleton->elastic_stiffness().lambda);
    EXPECT_EQ(skeleton->with_frozen_water(5), nullptr);
  }



  // Initial stress is effective, whatever the elastic law.
  TEST(Undrained, InitialStress)
  {
    for (const Pointer &inner :
         {skeleton,
          Pointer(std::make_shared<NeoHookean>(E, nu, 0.)),
          clay(2),
          sand(5, 30, 0)})
      for (const StrainMeasure measure :
           {StrainMeasure::small, StrainMeasure::finite})
        {
          if (measure == StrainMeasure::small &&
              !inner->has_small_strain_limit())
            continue;
          const auto          stress = soil_point::diagonal(-60, -70, -100);
          const MaterialPoint point(undrained(inner), measure, stress);
          // Strains are known to round-off, which water makes a pressure of.
          const unsigned int p     = inner->internal_variables().size();
          const double       error = 3e-14 * K_w;
          EXPECT_LE((point.stress() - stress).norm(), error);
          EXPECT_NEAR(point.internal()[p], 0, error);
        }
  }



  TEST(Undrained, StrengthReduction)
  {
    const auto wet   = undrained(sand(10, 30, 0));
    const auto weak  = wet->with_strength_over(1.5);
    const auto later = std::make_shared<moraine::Succession>(wet, weak, 2.);
    EXPECT_EQ(undrained(skeleton)->with_strength_over(1.5), nullptr);
    const double M =
      6 * std::sin(std::atan(std::tan(30 * soil_point::degree) / 1.5));
    const double sin_F = M / 6;
    const double M_F   = M / (3 - sin_F);
    const double k = 6 * 10 / 1.5 * std::sqrt(1 - sin_F * sin_F) / (3 - sin_F);
    EXPECT_NEAR(triaxial(weak, 0.02, 20).q,
                (100 * M_F + k) / (1 - M_F / (3 * 46)),
                1e-6);
    const Tensor<1, 3> e({0.004, 0.004, -0.012});
    for (const double t : {1., 2.})
      {
        auto       a = start_of(*wet), b = a;
        const auto by = answer(t < 2 ? *wet : *weak, e, a, {t, t + 1});
        EXPECT_EQ(answer(*later, e, b, {t, t + 1}).stress, by.stress);
        EXPECT_EQ(a, b);
      }
  }



  // Against difference quotients, on random paths through yielding, cavities
  // and their closing.
  TEST(Undrained, Tangent)
  {
    constexpr double h = 1e-9;
    for (const Pointer &inner :
         {skeleton, sand(10, 30, 10), sand(10, 30, 0), clay(2)})
      {
        const auto   wet = undrained(inner, water(4e5, 20));
        Random       random;
        auto         at = start_of(*wet, 100);
        Tensor<1, 3> e;
        for (unsigned int A = 0; A < 3; ++A)
          e[A] = at[inner->internal_variables().size() + 1] / 3;
        unsigned int n_kinks = 0, n_cavities = 0;
        for (unsigned int i = 0; i < 1000; ++i)
          {
            const auto         before = at;
            const Tensor<1, 3> trial  = e + random.vector(0, 3e-4);
            const auto         to     = answer(*wet, trial, at);
            ASSERT_TRUE(std::isfinite(to.stress.norm()))
              << inner->why_no_stress() << ' ' << i << ' ' << trial << ' ' << e;
            for (unsigned int B = 0; B < 3; ++B)
              {
                const auto moved = [&](const double by) {
                  Tensor<1, 3> there = trial;
                  there[B] += by;
                  auto from = before;
                  return answer(*wet, there, from).stress;
                };
                const auto ahead  = (moved(h) - to.stress) / h,
                           behind = (to.stress - moved(-h)) / h;
                if ((ahead - behind).norm() > 5e-2 * 4e5)
                  {
                    ++n_kinks;
                    continue;
                  }
                for (unsigned int A = 0; A < 3; ++A)
                  ASSERT_NEAR(0.5 * (ahead[A] + behind[A]),
                              to.tangent[A][B],
                              2e-4 * 4e5)
                    << i;
              }
            e = to.strain;
            n_cavities += at[inner->internal_variables().size()] == -20;
          }
        EXPECT_LE(n_kinks, 20);
        EXPECT_GE(n_cavities, 50);
      }
  }
} // namespace undrained_test
