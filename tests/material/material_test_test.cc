// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Tests of one point, stresses and strains led together, against closed forms.

#include "transversely_isotropic.h"

#include <moraine/core/exceptions.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/material/von_mises.h>
#include <moraine/scene/material_test_parameters.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../core/message.h"

namespace material_test_test
{
  using namespace dealii;
  using moraine::LinearElastic;
  using moraine::Material;
  using moraine::MaterialTest;
  using moraine::MaterialTestParameters;
  using moraine::StepTime;
  using moraine::StrainMeasure;
  using moraine::TensorState;
  using moraine::VonMises;

  namespace
  {
    using Pointer = std::shared_ptr<const Material>;

    constexpr double young = 200, ratio = 0.25, yield = 2;
    constexpr double shear      = young / (2 * (1 + ratio));
    constexpr double bulk       = young / (3 * (1 - 2 * ratio));
    constexpr double oedometric = bulk + 4 * shear / 3;

    const Pointer elastic = std::make_shared<LinearElastic>(young, ratio, 0.);
    const Pointer perfect =
      std::make_shared<VonMises>(young,
                                 ratio,
                                 0.,
                                 std::vector<std::pair<double, double>>{
                                   {0, std::sqrt(2. / 3) * yield}});

    /** The state at the end, and the largest error of a tangent on the way. */
    struct End
    {
      SymmetricTensor<2, 3> stress;
      moraine::SixNumbers   strain;
      double                tangent_error = 0;
      unsigned int          n_steps       = 0;
    };

    End
    driven(const Pointer                &material,
           const MaterialTestParameters &parameters,
           const StrainMeasure           measure = StrainMeasure::small)
    {
      MaterialTest test(material, measure, parameters.stress());
      End          end;
      for (const auto &leg : parameters.all_legs())
        test.lead(leg, [&]() {
          ++end.n_steps;
          end.tangent_error = std::max(end.tangent_error, test.tangent_error());
        });
      end.stress = test.stress();
      end.strain = test.strain();
      return end;
    }

    MaterialTestParameters
    test_of(const std::string         &kind,
            const std::string         &legs,
            const std::vector<double> &initial = {0, 0, 0},
            const std::string         &control = "")
    {
      MaterialTestParameters result;
      result.kind           = kind;
      result.legs           = legs;
      result.initial_stress = initial;
      result.control        = control;
      result.steps          = 7;
      return result;
    }

    /** A law C : strain with any C, of steps that are no longer than @p most.
     */
    class AnyStiffness : public moraine::TransverselyIsotropic
    {
    public:
      AnyStiffness(const SymmetricTensor<4, 3> &C,
                   const double                 claimed = 1,
                   const double most = std::numeric_limits<double>::infinity())
        : TransverselyIsotropic({50., 90., 0.2, 0.3, 25.},
                                Tensor<1, 3>({1., 0., 0.}),
                                0.)
        , C(C)
        , claimed(claimed)
        , most(most)
      {}

      using Material::respond;

      void
      respond(const StepTime &,
              const StrainMeasure,
              const ArrayView<TensorState> &points) const override
      {
        for (TensorState &point : points)
          {
            point.stress += C * point.strain_increment;
            if (point.strain_increment.norm() > most)
              point.stress *= std::numeric_limits<double>::quiet_NaN();
            point.tangent = claimed * C;
          }
      }

    private:
      const SymmetricTensor<4, 3> C;
      const double                claimed; ///< tangent over the true one
      const double                most;
    };

    /** The same, but for a step of no strain the tangent is 0, as at an apex.
     */
    class AtApex : public AnyStiffness
    {
    public:
      using AnyStiffness::AnyStiffness;
      using Material::respond;

      void
      respond(const StepTime               &time,
              const StrainMeasure           measure,
              const ArrayView<TensorState> &points) const override
      {
        AnyStiffness::respond(time, measure, points);
        for (TensorState &point : points)
          if (point.strain_increment.norm() == 0)
            point.tangent = SymmetricTensor<4, 3>();
      }
    };

    SymmetricTensor<4, 3>
    not_symmetric()
    {
      SymmetricTensor<4, 3> C =
        moraine::TransverselyIsotropic({50., 90., 0.2, 0.3, 25.},
                                       Tensor<1, 3>({1., 0.3, 0.2}),
                                       0.)
          .stiffness();
      C[0][0][1][1] += 20;
      C[2][2][0][1] -= 11;
      C[1][2][0][0] += 7;
      return C;
    }
  } // namespace



  TEST(MaterialTest, Oedometer)
  {
    const End end = driven(elastic, test_of("oedometer", "to strain -0.01"));
    EXPECT_NEAR(end.stress[2][2], -0.01 * oedometric, 1e-12);
    EXPECT_NEAR(end.stress[0][0], -0.01 * (bulk - 2 * shear / 3), 1e-12);
    EXPECT_EQ(end.strain[2], -0.01);
    EXPECT_EQ(end.n_steps, 7u);
    EXPECT_LE(end.tangent_error, 1e-8);
    // The same by logarithmic strain, a third of the height gone.
    const End large = driven(elastic,
                             test_of("oedometer", "to strain -0.4"),
                             StrainMeasure::finite);
    EXPECT_NEAR(large.stress[2][2], -0.4 * oedometric, 1e-10);
    EXPECT_LE(large.tangent_error, 1e-7);
  }



  TEST(MaterialTest, TriaxialYield)
  {
    for (const StrainMeasure measure :
         {StrainMeasure::small, StrainMeasure::finite})
      for (const double direction : {-1., 1.})
        {
          const End end =
            driven(perfect,
                   test_of("triaxial drained",
                           direction < 0 ? "to strain -0.05" : "to strain 0.05",
                           {-3, -3, -3}),
                   measure);
          EXPECT_NEAR(end.stress[2][2], -3 + direction * yield, 1e-10);
          EXPECT_NEAR(end.stress[0][0], -3, 1e-12);
          EXPECT_NEAR(end.stress[1][1], -3, 1e-12);
          EXPECT_NEAR(end.strain[0] + end.strain[1] + end.strain[2],
                      direction * yield / 3 / bulk,
                      1e-11);
          EXPECT_LE(end.tangent_error, 1e-5);
        }
  }



  TEST(MaterialTest, UndrainedKeepsVolume)
  {
    const auto test =
      test_of("triaxial undrained", "to strain -0.2", {-3, -3, -3});
    for (const StrainMeasure measure :
         {StrainMeasure::small, StrainMeasure::finite})
      {
        const End end = driven(perfect, test, measure);
        EXPECT_NEAR(end.strain[0] + end.strain[1] + end.strain[2], 0, 1e-14);
        EXPECT_NEAR(end.strain[0], 0.1, 1e-12);
        EXPECT_NEAR(trace(end.stress), -9, 1e-9);
        EXPECT_NEAR(end.stress[0][0] - end.stress[2][2], yield, 1e-10);
      }
  }



  TEST(MaterialTest, SimpleShearToK)
  {
    const double k = yield / std::sqrt(3.);
    for (const std::string kind : {"stress", "height"})
      {
        const End end = driven(perfect,
                               test_of("simple shear constant " + kind,
                                       "to strain 0.1",
                                       {-1, -1, -1}));
        EXPECT_NEAR(end.stress[0][2], k, 1e-9);
        EXPECT_NEAR(end.stress[2][2], -1, 1e-9);
        EXPECT_EQ(end.strain[4], 0.1);
        const End first =
          driven(elastic,
                 test_of("simple shear constant " + kind, "to stress 0.3"));
        EXPECT_NEAR(first.strain[4], 0.3 / shear, 1e-12);
      }
    // Far beyond yield the stress turns with the shear: k up to k / G.
    const Pointer stiff =
      std::make_shared<VonMises>(1e5 * young,
                                 ratio,
                                 0.,
                                 std::vector<std::pair<double, double>>{
                                   {0, std::sqrt(2. / 3) * yield}});
    auto far      = test_of("simple shear constant height", "to strain 2");
    far.steps     = 400;
    const End end = driven(stiff, far, StrainMeasure::finite);
    EXPECT_NEAR(end.stress[0][2], k, 1e-3 * k);
  }



  TEST(MaterialTest, BiaxialAndIsotropic)
  {
    const End plane = driven(elastic, test_of("biaxial", "to strain -0.01"));
    EXPECT_NEAR(plane.stress[2][2], -0.01 * young / (1 - ratio * ratio), 1e-12);
    EXPECT_NEAR(plane.stress[0][0], 0, 1e-14);
    EXPECT_NEAR(plane.strain[1], 0, 1e-17);
    const End all =
      driven(elastic, test_of("isotropic", "to stress -7", {-1, -2, -3}));
    for (unsigned int i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(all.strain[i], -4 / (3 * bulk), 1e-13);
        EXPECT_NEAR(all.stress[i][i], -5. - i, 1e-12);
      }
  }



  TEST(MaterialTest, UntilAndCycles)
  {
    const auto test = test_of(
      "triaxial drained",
      "to strain -0.05, until q = 0, 3 cycles, until q = -1, until p = -3",
      {-3, -3, -3});
    EXPECT_EQ(test.all_legs().size(), 8u);
    const End end = driven(perfect, test);
    EXPECT_EQ(end.n_steps, 56u);
    EXPECT_NEAR(end.stress[2][2], -3, 1e-11);
    EXPECT_NEAR(end.strain[2], -0.05 + yield / young, 1e-11);
    EXPECT_EQ(
      test_of("triaxial drained",
              "to strain -1, to strain 0, 2 cycles, to strain 3, 3 cycles")
        .all_legs()
        .size(),
      7u);
  }



  TEST(MaterialTest, UnloadsFromYieldByStress)
  {
    using Rows           = std::vector<std::pair<double, double>>;
    const double  radius = std::sqrt(2. / 3) * yield;
    const Pointer harder = std::make_shared<VonMises>(
      young, ratio, 0., Rows{{0, radius}, {1, radius * (1 + 1e-3)}});
    const Pointer softer = std::make_shared<VonMises>(
      young, ratio, 0., Rows{{0, radius}, {1, radius * (1 - 1e-3)}});
    for (const StrainMeasure measure :
         {StrainMeasure::small, StrainMeasure::finite})
      for (const Pointer &material : {perfect, harder, softer})
        for (unsigned int n = 1; n < 30; ++n)
          {
            auto test     = test_of("triaxial drained",
                                "to strain -0.03, to stress -2.5",
                                {-3, -3, -3});
            test.steps    = n;
            const End end = driven(material, test, measure);
            EXPECT_NEAR(end.stress[2][2], -2.5, 1e-10);
            EXPECT_NEAR(end.strain[2], -0.03 + (yield + 0.5) / young, 1e-6)
              << n;
          }
  }



  TEST(MaterialTest, GeneralOfAnyStiffness)
  {
    const std::vector<double> initial{-1, -2, -3, 0.1, 0.2, 0.3};
    const auto                C    = not_symmetric();
    const auto                test = test_of("general",
                              "to 2, to 1",
                              initial,
                              "stress xx 1; stress yy -4; stress xz 0.5");
    SymmetricTensor<2, 3>     change;
    change[0][0]                       = 2;
    change[1][1]                       = -2;
    change[0][2]                       = 0.3;
    const SymmetricTensor<2, 3> strain = invert(C) * change;
    for (const double most : {1., 0.002})
      {
        const End end =
          driven(std::make_shared<AnyStiffness>(C, 1., most), test);
        EXPECT_NEAR((end.stress - change - test.stress()).norm(), 0, 1e-11);
        for (unsigned int i = 0; i < 3; ++i)
          EXPECT_NEAR(end.strain[i], strain[i][i], 1e-13);
        EXPECT_NEAR(end.strain[4], 2 * strain[0][2], 1e-13);
        EXPECT_LE(end.tangent_error, 1e-7);
      }
    const End mixed = driven(
      elastic,
      test_of("general", "to 1", {0, 0, 0}, "strain xx 0.01; strain yz 0.02"));
    EXPECT_NEAR(mixed.stress[0][0], 0.01 * young, 1e-12);
    EXPECT_NEAR(mixed.strain[1], -0.01 * ratio, 1e-13);
    EXPECT_NEAR(mixed.stress[1][2], 0.02 * shear, 1e-12);
  }



  TEST(MaterialTest, LeavesAnApexByStress)
  {
    const auto C = not_symmetric();
    const End  end =
      driven(std::make_shared<AtApex>(C),
             test_of("general", "to 1", {0, 0, 0}, "stress xx -1"));
    SymmetricTensor<2, 3> stress;
    stress[0][0]                       = -1;
    const SymmetricTensor<2, 3> strain = invert(C) * stress;
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(end.strain[i], strain[i][i], 1e-13);
  }



  TEST(MaterialTest, TensorsAtFiniteStrain)
  {
    const Pointer slate = std::make_shared<moraine::TransverselyIsotropic>(
      moraine::TransverseConstants{50., 90., 0.2, 0.3, 25.},
      Tensor<1, 3>({1., 0.3, 0.2}),
      0.);
    const End end =
      driven(slate,
             test_of("general",
                     "to 1",
                     {0, 0, 0},
                     "strain xz 0.2; strain xx -0.1; stress yy 3"),
             StrainMeasure::finite);
    EXPECT_NEAR(end.stress[1][1], 3, 1e-9);
    EXPECT_NEAR(end.stress[2][2], 0, 1e-9);
    EXPECT_LE(end.tangent_error, 1e-6);
  }



  TEST(MaterialTest, WrongTangentIsFound)
  {
    const End end =
      driven(std::make_shared<AnyStiffness>(not_symmetric(), 1.01),
             test_of("oedometer", "to stress -1"));
    EXPECT_NEAR(end.stress[2][2], -1, 1e-9);
    EXPECT_NEAR(end.tangent_error, 0.01 / 1.01, 1e-4);
  }



  TEST(MaterialTest, WhereItEnds)
  {
    const auto complaint = [](const Pointer &material, const auto &test) {
      return message_of<moraine::ComputationError>(
        [&]() { driven(material, test); });
    };
    const std::string strength =
      complaint(perfect, test_of("triaxial drained", "to stress -2.1"));
    EXPECT_EQ(strength.rfind("no step leads on from eps_xx = 0.00", 0), 0u)
      << strength;
    EXPECT_NE(strength.find("eps_zz = -0.009"), std::string::npos) << strength;
    EXPECT_NE(strength.find("beyond the strength"), std::string::npos);
    EXPECT_EQ(
      complaint(std::make_shared<AnyStiffness>(not_symmetric(), 1., 1e-9),
                test_of("oedometer", "to strain 1")),
      "no step leads on from the initial state, not even a 1024th of one; its "
      "material has no stress at this strain");
  }



  TEST(MaterialTest, InitialStressBeyondYield)
  {
    for (const StrainMeasure measure :
         {StrainMeasure::small, StrainMeasure::finite})
      {
        const auto test = test_of("oedometer", "to strain 1", {0, 0, -3});
        const MaterialTest of(perfect, measure, test.stress());
        EXPECT_NEAR(deviator(of.stress()).norm(),
                    std::sqrt(2. / 3) * yield,
                    1e-10);
      }
  }
} // namespace material_test_test
