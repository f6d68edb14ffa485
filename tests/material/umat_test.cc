// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Materials by UMATs in Fortran, compiled here, against our own ones.

#include <moraine/material/drucker_prager.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/material/material_library.h>
#include <moraine/material/material_point.h>
#include <moraine/material/material_test.h>
#include <moraine/material/umat.h>

#include "../core/message.h"
#include "soil_point.h"

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <fstream>
#include <map>

#include <unistd.h>

namespace umat_test
{
  using namespace dealii;
  using moraine::InputError;
  using moraine::Material;
  using moraine::MaterialPoint;
  using moraine::StepTime;
  using moraine::StrainMeasure;
  using moraine::TensorState;
  using moraine::Umat;
  using moraine::UmatExit;

  namespace
  {
    namespace fs = std::filesystem;

    using Stress = SymmetricTensor<2, 3>;
    using Matrix = Tensor<2, 3>;

    const Matrix one = unit_symmetric_tensor<3>();

    std::string
    shipped(const std::string &name)
    {
      return (fs::path(__FILE__).parent_path() / "../../prm/umat" / name)
        .lexically_normal()
        .string();
    }

    /** A source with a UMAT of linear elasticity, E = 100 and nu = 0, in which
     * STATEV(1) counts calls; @p body and @p after are added. */
    class Source
    {
    public:
      explicit Source(const std::string &body, const std::string &after = "")
        : path(fs::temp_directory_path() /
               ("umat-test-" + std::to_string(getpid()) + "-" +
                std::to_string(n_sources++) + ".for"))
      {
        std::ofstream(path)
          << "      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,\n"
             "     1 RPL,DDSDDT,DRPLDE,DRPLDT,\n"
             "     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,\n"
             "     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,\n"
             "     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,KSTEP,KINC)\n"
             "      include 'aba_param.inc'\n"
             "      CHARACTER*80 CMNAME\n"
             "      DIMENSION STRESS(NTENS),STATEV(*),DDSDDE(NTENS,NTENS),\n"
             "     1 STRAN(NTENS),DSTRAN(NTENS),TIME(2),PROPS(*),COORDS(3),\n"
             "     2 DROT(3,3),DFGRD0(3,3),DFGRD1(3,3),KSTEP(4)\n"
             "      SAVE NCALLS\n"
             "      DATA NCALLS /0/\n"
             "      DO I = 1, NTENS\n"
             "        DO J = 1, NTENS\n"
             "          DDSDDE(I,J) = 0.D0\n"
             "        END DO\n"
             "        DDSDDE(I,I) = 100.D0\n"
             "        IF (I.GT.3) DDSDDE(I,I) = 50.D0\n"
             "        STRESS(I) = STRESS(I) + DDSDDE(I,I)*DSTRAN(I)\n"
             "      END DO\n"
          << body << "      END\n"
          << after;
      }

      ~Source()
      {
        fs::remove(path);
      }

      Umat::Parameters
      parameters() const
      {
        Umat::Parameters result;
        result.file = path.string();
        result.name = "CLAY";
        return result;
      }

    private:
      const fs::path             path;
      static inline unsigned int n_sources = 0;
    };

    Umat::Parameters
    parameters(const std::string         &file,
               const std::vector<double> &constants,
               const unsigned int         n_state = 0)
    {
      Umat::Parameters result;
      result.file      = shipped(file);
      result.constants = constants;
      result.state.resize(n_state);
      return result;
    }

    /** Of Drucker and Prager's cone outside of Mohr and Coulomb's. */
    Umat::Parameters
    outer_cone(const double c, const double phi, const double psi)
    {
      const auto eta = [](const double angle) {
        const double s = std::sin(angle * soil_point::degree);
        return 6 * s / (std::sqrt(3.) * (3 - s));
      };
      return parameters("drucker-prager.f",
                        {20000,
                         0.3,
                         eta(phi),
                         eta(psi),
                         eta(phi) * c / std::tan(phi * soil_point::degree)},
                        1);
    }

    Matrix
    random_gradient(soil_point::Random &random, const double size)
    {
      Matrix H;
      for (unsigned int i = 0; i < 3; ++i)
        H[i] = random.vector(0, size);
      return H;
    }

    /** Both along random steps: stress, first internal variable, tangent. */
    void
    compare(const std::shared_ptr<const Material> &umat,
            const std::shared_ptr<const Material> &own,
            const double                           size,
            const bool                             has_history)
    {
      soil_point::Random random;
      for (unsigned int path = 0; path < 20; ++path)
        {
          MaterialPoint a(umat, StrainMeasure::small, Stress());
          MaterialPoint b(own, StrainMeasure::small, Stress());
          for (unsigned int i = 0; i < 50; ++i)
            {
              const Matrix H =
                random_gradient(random, size * std::pow(0.1, i % 3));
              ASSERT_TRUE(a.try_step({0, 1}, H));
              ASSERT_TRUE(b.try_step({0, 1}, H));
              ASSERT_NEAR((a.stress() - b.stress()).norm(),
                          0,
                          1e-10 * (1 + b.stress().norm()));
              const double history = has_history ? b.internal()[0] : 0;
              ASSERT_NEAR(has_history ? a.internal()[0] : 0, history, 1e-10);
              const Matrix l = random_gradient(random, 1);
              // Beside a kink round-off decides.
              ASSERT_NEAR((a.stress_rate(l) - b.stress_rate(l)).norm(),
                          0,
                          1e-7 * 20000)
                << path << ' ' << i;
              a.keep();
              b.keep();
            }
        }
    }

    /** One step from @p F_n with @p sigma to @p F. */
    TensorState
    step(const Umat   &umat,
         const Stress &sigma,
         const Matrix &F_n,
         const Matrix &F)
    {
      std::vector<double> internal;
      for (const auto &variable : umat.internal_variables())
        internal.push_back(variable.initial);
      TensorState point;
      point.F_n      = F_n;
      point.F        = F;
      point.stress   = sigma;
      point.internal = internal.data();
      umat.respond({0, 1},
                   StrainMeasure::finite,
                   ArrayView<TensorState>(&point, 1));
      point.internal = nullptr;
      return point;
    }

    /** L_v tau against central differences, over the tangent's size, for d; the
     * spin counts only if @p with_spin. */
    double
    tangent_error(const Umat   &umat,
                  const Stress &sigma,
                  const Matrix &F_n,
                  const Matrix &F,
                  const bool    with_spin)
    {
      soil_point::Random random;
      const TensorState  at    = step(umat, sigma, F_n, F);
      double             error = 0;
      for (unsigned int i = 0; i < 10; ++i)
        {
          Matrix l = random_gradient(random, 1);
          if (!with_spin)
            l = 0.5 * (l + transpose(l));
          const double h    = 1e-7;
          const Matrix tau  = at.stress;
          const Matrix up   = step(umat, sigma, F_n, (one + h * l) * F).stress;
          const Matrix down = step(umat, sigma, F_n, (one - h * l) * F).stress;
          const Matrix rate =
            (up - down) / (2 * h) - l * tau - tau * transpose(l);
          const Matrix c_d = at.tangent * symmetrize(l);
          error = std::max(error, (rate - c_d).norm() / (l.norm() * 20000));
        }
      return error;
    }

    /** tau_12 / k of perfect plasticity in simple shear. */
    double
    shear_stress(const bool hughes_winget, const double gamma)
    {
      auto of = parameters("drucker-prager.f", {1000, 0.3, 0, 0, 1}, 1);
      of.hughes_winget   = hughes_winget;
      auto          umat = std::make_shared<Umat>(of);
      MaterialPoint point(umat, StrainMeasure::finite, Stress());
      Matrix        H;
      H[0][1] = 0.01;
      for (unsigned int i = 0; i < std::lround(gamma / 0.01); ++i)
        {
          EXPECT_TRUE(point.try_step({0, 1}, H));
          point.keep();
        }
      return point.stress()[0][1];
    }

    const Stress sigma({-40, -20, -30, 8, -5, 3});
    const Matrix F_n({{1.1, 0.05, 0.02}, {-0.03, 0.95, 0.04}, {0, 0.1, 1.02}});
    const Matrix dF({{1.2, 0.3, -0.1}, {-0.2, 0.9, 0.15}, {0.1, 0.2, 0.85}});
  } // namespace



  TEST(Umat, LinearElasticAsOurs)
  {
    compare(std::make_shared<Umat>(
              parameters("linear-elastic.f", {20000, 0.3})),
            std::make_shared<moraine::LinearElastic>(20000, 0.3, 0.),
            0.01,
            false);
  }

  TEST(Umat, DruckerPragerAsOurs)
  {
    for (const double psi : {0., 10., 30.})
      for (const double size : {0.001, 0.02})
        compare(std::make_shared<Umat>(outer_cone(10, 30, psi)),
                std::make_shared<moraine::DruckerPrager>(
                  soil_point::soil(10, 30, psi, soil_point::none),
                  moraine::DruckerPrager::Match::outer_cone),
                size,
                true);
  }

  // The stress of DruckerPrager.Triaxial; true strains hardly change it.
  TEST(Umat, TriaxialTest)
  {
    Stress initial;
    for (unsigned int d = 0; d < 3; ++d)
      initial[d][d] = -100;
    moraine::MaterialTestLeg leg;
    leg.n_steps = 20;
    for (unsigned int i = 0; i < 6; ++i)
      {
        leg.sums[i].of_stress[i] = i == 1 || i == 2;
        leg.sums[i].of_strain[i] = i != 1 && i != 2;
      }
    leg.values[0] = -0.1;
    for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
      for (const bool hughes_winget : {false, true})
        {
          auto of          = outer_cone(10, 30, 30);
          of.hughes_winget = hughes_winget;
          moraine::MaterialTest test(std::make_shared<Umat>(of),
                                     measure,
                                     initial);
          unsigned int          most_iterations = 0;
          test.lead(leg, [&] {
            most_iterations = std::max(most_iterations, test.n_iterations());
            // That of Hughes and Winget is not exact for spins.
            EXPECT_LT(test.tangent_error(),
                      measure == StrainMeasure::finite && hughes_winget ? 2e-3 :
                                                                          1e-6);
          });
          const double J =
            measure == StrainMeasure::small ?
              1 :
              std::exp(test.strain()[0] + test.strain()[1] + test.strain()[2]);
          // At constant Kirchhoff stress Cauchy's is -100 / J across.
          const double across = test.stress()[1][1] / J;
          EXPECT_NEAR(test.stress()[1][1], -100, 1e-6);
          EXPECT_NEAR(test.stress()[0][0] / J,
                      3 * across - 2 * std::sqrt(3.) * 10,
                      1e-4);
          EXPECT_LE(most_iterations, 8);
        }
  }

  TEST(Umat, KnowsItsStiffness)
  {
    const Umat umat(parameters("linear-elastic.f", {20000, 0.3}));
    const auto C = moraine::lame_constants(20000, 0.3);
    EXPECT_NEAR(umat.elastic_stiffness().lambda, C.lambda, 1e-9);
    EXPECT_NEAR(umat.elastic_stiffness().mu, C.mu, 1e-9);
  }

  // The total logarithmic strain gives 0.974, 0.833 and 0.435.
  TEST(Umat, KeepsTheShearStrengthInLargeShear)
  {
    for (const bool hughes_winget : {false, true})
      for (const double gamma : {1., 2., 5.})
        EXPECT_NEAR(shear_stress(hughes_winget, gamma), 1, 1e-4) << gamma;
  }

  TEST(Umat, TurnsWithTheMaterial)
  {
    const double a = 1.1;
    const Matrix R({{std::cos(a), 0, -std::sin(a)},
                    {0, 1, 0},
                    {std::sin(a), 0, std::cos(a)}});
    for (const bool hughes_winget : {false, true})
      {
        auto of          = outer_cone(10, 30, 10);
        of.hughes_winget = hughes_winget;
        const Umat   umat(of);
        const double J      = determinant(F_n);
        const Matrix turned = step(umat, sigma, F_n, R * F_n).stress;
        EXPECT_NEAR(
          (turned - J * R * static_cast<Matrix>(sigma) * transpose(R)).norm(),
          0,
          1e-11);
        if (hughes_winget)
          continue;
        const Matrix tau = step(umat, sigma, F_n, dF * F_n).stress;
        EXPECT_NEAR((step(umat, sigma, F_n, R * dF * F_n).stress -
                     symmetrize(R * tau * transpose(R)))
                      .norm(),
                    0,
                    1e-10);
      }
  }

  TEST(Umat, FiniteTangentIsTheDerivative)
  {
    const Umat elastic(parameters("linear-elastic.f", {20000, 0.3}));
    const Umat plastic(outer_cone(10, 30, 10));
    const std::vector<Matrix> steps = {
      dF,
      one + 1e-2 * (dF - one),
      one + 1e-4 * (dF - one),
      Matrix({{1.3, 0, 0}, {0, 1.3, 0}, {0, 0, 0.8}}),
      one};
    for (const Matrix &by : steps)
      {
        EXPECT_LT(tangent_error(elastic, sigma, F_n, by * F_n, true), 1e-7);
        EXPECT_LT(tangent_error(plastic, sigma, F_n, by * F_n, true), 1e-7);
      }
  }

  TEST(Umat, TangentOfHughesAndWinget)
  {
    auto of          = outer_cone(10, 30, 10);
    of.hughes_winget = true;
    const Umat umat(of);
    for (const double size : {1., 1e-2, 0.})
      EXPECT_LT(
        tangent_error(umat, sigma, F_n, (one + size * (dF - one)) * F_n, false),
        1e-7);
  }

  TEST(Umat, TellsTheTotalStrain)
  {
    const Source source("      STATEV(1) = STRAN(4)\n"
                        "      STATEV(2) = DTIME\n"
                        "      STATEV(3) = TIME(1) + 10*KSTEP(3)\n");
    auto         of = source.parameters();
    of.state.resize(3);
    const auto umat = std::make_shared<Umat>(of);
    for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
      {
        const bool    finite = measure == StrainMeasure::finite;
        MaterialPoint point(umat, measure, Stress());
        Matrix        H;
        H[0][1] = 0.01;
        for (unsigned int i = 0; i < 3; ++i)
          {
            ASSERT_TRUE(point.try_step({2, 2.5}, H));
            point.keep();
          }
        EXPECT_NEAR(point.internal()[0], 0.02, finite ? 1e-5 : 1e-15);
        EXPECT_EQ(point.internal()[1], 0.5);
        EXPECT_EQ(point.internal()[2], finite ? 12 : 2);
        EXPECT_NEAR(point.stress()[0][1], 1.5, finite ? 1e-3 : 1e-13);
      }
  }

  TEST(Umat, ATrialLeavesTheStateAsItWas)
  {
    const Source source("      STATEV(1) = STATEV(1) + 1\n");
    auto         of = source.parameters();
    of.state        = {5};
    MaterialPoint point(std::make_shared<Umat>(of),
                        StrainMeasure::small,
                        Stress());
    for (unsigned int i = 0; i < 3; ++i)
      {
        point.try_step({0, 1}, Matrix());
        EXPECT_EQ(point.internal()[0], 6);
      }
  }

  TEST(Umat, StateByItsLibrary)
  {
    const Source source("",
                        "      SUBROUTINE SDVINI(STATEV,COORDS,NSTATV,NCRDS,\n"
                        "     1 NOEL,NPT,LAYER,KSPT)\n"
                        "      include 'ABA_PARAM.INC'\n"
                        "      DIMENSION STATEV(NSTATV),COORDS(NCRDS)\n"
                        "      STATEV(1) = 7\n"
                        "      STATEV(2) = COORDS(2)\n"
                        "      END\n");
    auto         of = source.parameters();
    of.state.resize(2);
    of.by_sdvini = true;
    const Umat umat(of);
    const auto state = umat.internal_at(Point<3>(1, 2, 3));
    EXPECT_EQ(state[0], 7);
    EXPECT_EQ(state[1], 2);
  }

  TEST(Umat, TwoMaterialsShareNoVariables)
  {
    const Source source("      NCALLS = NCALLS + 1\n"
                        "      STATEV(1) = NCALLS\n");
    auto         of = source.parameters();
    of.state.resize(1);
    const auto calls = [](const Umat &umat) {
      MaterialPoint point(std::make_shared<Umat>(umat),
                          StrainMeasure::small,
                          Stress());
      return point.internal()[0];
    };
    const Umat first(of), second(of);
    EXPECT_EQ(calls(first), 2); // the first at its construction
    EXPECT_EQ(calls(first), 3);
    EXPECT_EQ(calls(second), 2);
  }

  TEST(Umat, ExitAndErrorsAreExceptions)
  {
    const Source source(
      "      IF (DSTRAN(1).GT.0.1D0) CALL XIT\n"
      "      IF (DSTRAN(2).GT.0.1D0) CALL STDB_ABQERR(-3,\n"
      "     1 'STRAIN %R OF %S IN %I',7,DSTRAN(2),CMNAME(1:8))\n");
    const Umat umat(source.parameters());
    const auto message = [&](const unsigned int i) {
      return message_of<UmatExit>([&] {
        Matrix F = one;
        F[i][i]  = 1.5;
        step(umat, Stress(), one, F);
      });
    };
    EXPECT_EQ(message(0), "its UMAT ended the run (CALL XIT)");
    EXPECT_EQ(message(1),
              "its UMAT ended the run: STRAIN 0.405465 OF CLAY IN 7");
    EXPECT_EQ(message(2), "");
  }

  TEST(Umat, ASmallerStep)
  {
    const Source  source("      IF (DSTRAN(1).GT.0.1D0) PNEWDT = 0.25D0\n"
                         "      IF (DSTRAN(2).GT.0.1D0) STRESS(3) = LOG(-"
                         "DSTRAN(2))\n");
    MaterialPoint point(std::make_shared<Umat>(source.parameters()),
                        StrainMeasure::small,
                        Stress());
    Matrix        H;
    H[0][0] = 0.2;
    EXPECT_FALSE(point.try_step({0, 1}, H));
    EXPECT_EQ(point.law().why_no_stress(),
              "has a UMAT that asks for a smaller step (PNEWDT = 0.25)");
    EXPECT_EQ(point.law().wanted_cut({0, 1}), 0.25);
    EXPECT_EQ(point.law().wanted_cut({0, 0.5}), 1);
    H[0][0] = 0.05;
    EXPECT_TRUE(point.try_step({0, 1}, H));
    H[1][1] = 0.2;
    EXPECT_FALSE(point.try_step({0, 0.5}, H));
    EXPECT_EQ(point.law().why_no_stress(),
              "has a UMAT whose stress or DDSDDE is not a number");
  }

  TEST(Umat, RoutinesOfAbaqus)
  {
    const Source source(
      "      STATEV(1) = 0\n"
      "      CALL HELP(STRESS,STATEV)\n",
      "      SUBROUTINE HELP(STRESS,STATEV)\n"
      "      include 'aba_param.inc'\n"
      "      DIMENSION STRESS(6),STATEV(9),S(6),PS(3),AN(3,3),R(3,3),T(6)\n"
      "      CHARACTER*256 DIR\n"
      "      DATA S /3.D0,1.D0,2.D0,0.D0,0.D0,0.D0/\n"
      "      DATA R /0.D0,1.D0,0.D0,-1.D0,0.D0,0.D0,0.D0,0.D0,1.D0/\n"
      "      S(4) = 0\n"
      "      CALL SINV(S,STATEV(1),STATEV(2),3,3)\n"
      "      CALL SPRINC(S,PS,1,3,3)\n"
      "      STATEV(3) = PS(1) + PS(2) + PS(3)\n"
      "      CALL SPRIND(S,PS,AN,1,3,3)\n"
      "      STATEV(4) = 0\n"
      "      DO K = 1, 3\n"
      "        STATEV(4) = STATEV(4) + PS(K)*AN(K,1)**2\n"
      "      END DO\n"
      "      S(4) = 5\n"
      "      CALL ROTSIG(S,R,T,1,3,3)\n"
      "      STATEV(5) = T(1)\n"
      "      STATEV(6) = T(4)\n"
      "      CALL GETRANK(N)\n"
      "      CALL GETOUTDIR(DIR,LEN)\n"
      "      STATEV(7) = N\n"
      "      STATEV(8) = LEN\n"
      "      END\n");
    auto of = source.parameters();
    of.state.resize(9);
    MaterialPoint             point(std::make_shared<Umat>(of),
                        StrainMeasure::small,
                        Stress());
    const std::vector<double> expected = {2, std::sqrt(3.), 6, 3, 1, -5, 0};
    for (unsigned int i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(point.internal()[i], expected[i], 1e-14) << i;
    EXPECT_EQ(point.internal()[7], fs::current_path().string().size());
  }

  TEST(Umat, SymmetricTangent)
  {
    auto       of   = outer_cone(10, 30, 10);
    const auto skew = [&](const bool symmetrises) {
      of.symmetrises_tangent = symmetrises;
      const Umat umat(of);
      EXPECT_EQ(umat.has_symmetric_tangent(), symmetrises);
      const auto c =
        moraine::voigt_matrix<3>(step(umat, sigma, F_n, dF * F_n).tangent);
      double largest = 0;
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = 0; J < 6; ++J)
          largest = std::max(largest, std::abs(c[I][J] - c[J][I]));
      return largest;
    };
    EXPECT_GT(skew(false), 100);
    EXPECT_LT(skew(true), 1e-10);
  }

  TEST(Umat, FaultsOfALaw)
  {
    const auto faults = [](const Umat::Parameters &of) {
      std::string all;
      for (const std::string &fault :
           moraine::faults_of(std::make_shared<Umat>(of)))
        all += fault + '\n';
      return all;
    };
    const auto of_body = [&](const std::string &body) {
      const Source source(body);
      auto         of        = source.parameters();
      of.symmetrises_tangent = true;
      of.state               = {0};
      return faults(of);
    };
    EXPECT_EQ(of_body(""), "");
    EXPECT_EQ(faults(outer_cone(10, 30, 10)), "");
    EXPECT_EQ(faults(parameters("linear-elastic.f", {20000, 0.3})),
              "the tangent is symmetric in all trials: 'Tangent = symmetric' "
              "saves time at small strain\n");
    // An error of 10 in one shear is one of sqrt(2) 10 in the tensor.
    const std::string tangent = of_body("      DDSDDE(4,4) = 60\n");
    EXPECT_EQ(tangent.rfind("the tangent (DDSDDE) is not the derivative of the "
                            "stress (",
                            0),
              0u);
    EXPECT_NE(tangent.find(", by 14 %)\n"), std::string::npos) << tangent;
    EXPECT_EQ(of_body("      NCALLS = NCALLS + 1\n"
                      "      STATEV(1) = NCALLS\n"),
              "the same input gives another answer the second time "
              "(compression along 11 to 1e-05)\n");
    EXPECT_EQ(of_body("      STRESS(2) = STRESS(2) + 0.01\n")
                .rfind("the stress changes without a strain (", 0),
              0u);
    EXPECT_EQ(
      of_body("      DO I = 1, 6\n"
              "        STRESS(I) = STRESS(I)-200*DSTRAN(I)\n"
              "        IF (I.GT.3) STRESS(I) = STRESS(I)+100*DSTRAN(I)\n"
              "      END DO\n")
        .rfind("compression makes sigma_11 >= 0; tension is positive (", 0),
      0u);
    EXPECT_EQ(of_body("      IF (DSTRAN(4).GT.0.001) CALL XIT\n"),
              "shear 12: its UMAT ended the run (CALL XIT)\n"
              "compression and shear: its UMAT ended the run (CALL XIT)\n");
  }

  TEST(Umat, WhatIsWrongWithALibrary)
  {
    const auto message = [](const Umat::Parameters &of) {
      return message_of<InputError>([&] { Umat{of}; });
    };
    const auto has = [&](const Umat::Parameters &of, const std::string &text) {
      const std::string found = message(of);
      EXPECT_NE(found.find(text), std::string::npos) << found;
    };
    auto of = parameters("none.so", {});
    has(of, "there is no file '" + of.file + "'");
    has(parameters("ABA_PARAM.INC", {}), "cannot be loaded: ");
    of        = parameters("linear-elastic.f", {20000, 0.3});
    of.symbol = "Umat2";
    has(of, "has neither the symbol 'Umat2' nor 'umat2_'");
    of.symbol    = "UMAT";
    of.by_sdvini = true;
    has(of, "has no SDVINI");
    of.by_sdvini = false;
    EXPECT_EQ(message(of), "");
    of.constants = {0, 0.3};
    has(of, "has no stiffness without stress and strain: DDSDDE has 0 for");

    const Source bad("      THIS IS NOT FORTRAN\n");
    has(bad.parameters(), "says:\n");
    has(bad.parameters(), "Error");
    const Source incomplete("      CALL NOWHERE\n");
    has(incomplete.parameters(), "undefined symbol: nowhere_");
  }

  TEST(Umat, WhatIsWrongWithKeys)
  {
    const auto message = [](const std::map<std::string, std::string> &texts) {
      ParameterHandler            prm;
      moraine::MaterialParameters of;
      of.add_parameters(prm);
      of.model            = "UMAT";
      of.texts["Library"] = shipped("linear-elastic.f");
      for (const auto &[key, text] : texts)
        of.texts[key] = text;
      return message_of<InputError>(
        [&] { moraine::make_material(of, "Materials/clay"); });
    };
    const std::string section = "section 'Materials/clay'";
    EXPECT_EQ(message({{"Constants", "2e4, 0.3"}}), "");
    EXPECT_EQ(message({{"Constants", "2e4, 3*0.1, 2/3"}}), "");
    EXPECT_EQ(message({{"Library", ""}}),
              section + ", key 'Library': is not set, and has no default");
    EXPECT_EQ(message({}),
              section + ": with 0 constants and 0 state variables its UMAT "
                        "ended the run (CALL XIT)");
    EXPECT_EQ(message({{"Constants", "2e4; 0.3"}}),
              section + ", key 'Constants': found '2e4; 0.3', allowed: numbers "
                        "separated by commas; '3*0' is '0, 0, 0'");
    EXPECT_EQ(message({{"State variables", "by SDVINI"}}),
              section +
                ", key 'State variables': found 'by SDVINI', allowed: a number "
                "before 'by SDVINI', as '12 by SDVINI'");
    EXPECT_EQ(
      message({{"Constants", "2e4, 0.3"}, {"Cohesion", "1"}}),
      section +
        ", key 'Cohesion': found '1', allowed: nothing; the "
        "keys of 'UMAT' are Density, Saturated density, Library, Symbol, "
        "Constants, State variables, Objective rate, Tangent");
  }
} // namespace umat_test
