// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Strain paths through every material: closed forms, objectivity, tangents
// against differences, and what is said about bad values.

#include <moraine/core/exceptions.h>
#include <moraine/material/material_library.h>
#include <moraine/material/spectral.h>
#include <moraine/material/von_mises.h>

#include <deal.II/base/parameter_handler.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <sstream>

#include "../core/message.h"

using namespace dealii;
using moraine::InputError;
using moraine::lame_constants;
using moraine::make_material;
using moraine::Material;
using moraine::MaterialParameters;
using moraine::PrincipalState;
using moraine::StrainMeasure;
using moraine::VonMises;

namespace
{
  using Stress = SymmetricTensor<2, 3>;
  using Matrix = Tensor<2, 3>;

  constexpr double E = 250, nu = 0.3, sigma_y = 2;

  const double G      = lame_constants(E, nu).mu;
  const double lambda = lame_constants(E, nu).lambda;
  const double K      = lambda + 2 * G / 3;

  /** Kinks at 0.01, 0.03 and 0.1, the last two softening. */
  const std::string hardening = "0: 2, 0.01: 3, 0.03: 3.5, 0.1: 5";
  const std::string softening = "0: 2, 0.01: 1.5, 0.03: 1.6, 0.1: 0.5";

  const std::vector<std::pair<double, double>> hardening_rows = {{0, 2},
                                                                 {0.01, 3},
                                                                 {0.03, 3.5},
                                                                 {0.1, 5}};
  const std::vector<std::pair<double, double>> softening_rows = {{0, 2},
                                                                 {0.01, 1.5},
                                                                 {0.03, 1.6},
                                                                 {0.1, 0.5}};

  MaterialParameters
  parameters(const std::string &model, const std::string &yield = "")
  {
    ParameterHandler   prm;
    MaterialParameters result;
    result.add_parameters(prm);
    result.model                          = model;
    result.texts["Young modulus"]         = "250";
    result.texts["Poisson ratio"]         = "0.3";
    result.texts["Uniaxial yield stress"] = yield;
    return result;
  }

  using Materials = std::map<std::string, std::shared_ptr<const Material>>;

  const Materials &
  all_materials()
  {
    const auto make = [](const std::string &model,
                         const std::string &yield = "") {
      return make_material(parameters(model, yield), "Materials/m");
    };
    static const Materials materials = {
      {"linear elastic", make("linear elastic")},
      {"neo-Hookean", make("neo-Hookean")},
      {"perfect", make("von Mises", "2")},
      {"hardening", make("von Mises", hardening)},
      {"softening", make("von Mises", softening)}};
    return materials;
  }

  /** With the one internal variable that they have, if any. */
  struct Response : PrincipalState
  {
    double plastic_strain;
  };

  Response
  respond(const Material     &material,
          const Tensor<1, 3> &strain,
          const double        kappa = 0)
  {
    Response point;
    point.strain         = strain;
    point.plastic_strain = kappa;
    point.internal       = &point.plastic_strain;
    material.respond(moraine::StepTime(), ArrayView<PrincipalState>(&point, 1));
    return point;
  }

  bool
  is_plastic(const Material &material)
  {
    return !material.internal_variables().empty();
  }

  Tensor<1, 3>
  vector(const double x, const double y, const double z)
  {
    return Tensor<1, 3>({x, y, z});
  }

  /** What a point with finite strain is committed to. */
  struct Committed
  {
    Stress b_e   = unit_symmetric_tensor<3>();
    double kappa = 0;
  };

  struct Answer
  {
    Stress                  tau;
    moraine::VoigtMatrix<3> tangent;
    Committed               committed;
  };

  /** One step with the deformation gradient DF of the step. */
  template <int dim = 3>
  Answer
  step(const Material &material, const Committed &from, const Matrix &DF)
  {
    const Stress b =
      symmetrize(DF * static_cast<const Matrix &>(from.b_e) * transpose(DF));
    const auto   spectrum = moraine::spectrum<dim>(b);
    Tensor<1, 3> strain;
    for (unsigned int A = 0; A < 3; ++A)
      strain[A] = 0.5 * std::log(spectrum.values[A]);
    const Response point = respond(material, strain, from.kappa);

    Answer answer;
    answer.tau     = spectrum.tensor(point.stress);
    answer.tangent = moraine::spatial_tangent<3>(spectrum,
                                                 strain,
                                                 point,
                                                 StrainMeasure::finite);
    Tensor<1, 3> values;
    for (unsigned int A = 0; A < 3; ++A)
      values[A] = std::exp(2 * point.strain[A]);
    answer.committed = {spectrum.tensor(values), point.plastic_strain};
    return answer;
  }

  using Path = std::function<Matrix(double)>;

  /** The path F(t) from t = 0, where F = 1, to 1 in equal steps. */
  Answer
  drive(const Material &material, const Path &F, const unsigned int n_steps)
  {
    Answer answer;
    for (unsigned int i = 0; i < n_steps; ++i)
      answer = step(material,
                    answer.committed,
                    F((i + 1.) / n_steps) * invert(F(double(i) / n_steps)));
    return answer;
  }

  Matrix
  diagonal(const Tensor<1, 3> &values)
  {
    Matrix result;
    for (unsigned int i = 0; i < 3; ++i)
      result[i][i] = values[i];
    return result;
  }

  /** F = diag(exp(a t), 1, 1) */
  Path
  uniaxial(const double a)
  {
    return
      [a](const double t) { return diagonal(vector(std::exp(a * t), 1, 1)); };
  }

  /** No symmetry, no constant principal directions. */
  Path
  general(const double size)
  {
    return [size](const double t) {
      Matrix F = unit_symmetric_tensor<3>();
      F += size * Matrix({{0.3 * t, t * t, 0.2 * std::sin(t)},
                          {-0.4 * t, -0.2 * t, 0.5 * t},
                          {0.1 * t * t, 0.3 * t, 0.35 * t}});
      return F;
    };
  }

  /** About an axis in space; Rodrigues' formula. */
  Matrix
  rotation(const double angle)
  {
    const Tensor<1, 3> a = vector(1, -2, 2) / 3.;
    Matrix             cross;
    cross[0][1] = -a[2];
    cross[0][2] = a[1];
    cross[1][0] = a[2];
    cross[1][2] = -a[0];
    cross[2][0] = -a[1];
    cross[2][1] = a[0];
    Matrix Q    = unit_symmetric_tensor<3>();
    return Q + std::sin(angle) * cross + (1 - std::cos(angle)) * cross * cross;
  }

  double
  value_of(const std::vector<std::pair<double, double>> &rows, const double x)
  {
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (x <= rows[i].first)
        return rows[i - 1].second + (x - rows[i - 1].first) *
                                      (rows[i].second - rows[i - 1].second) /
                                      (rows[i].first - rows[i - 1].first);
    return rows.back().second;
  }

  void
  record_largest(const double error)
  {
    std::ostringstream text;
    text << error;
    testing::Test::RecordProperty("largest_error", text.str());
  }

  void
  expect_near(const Stress      &found,
              const Stress      &expected,
              const double       tolerance,
              const std::string &what)
  {
    EXPECT_LE((found - expected).norm(), tolerance)
      << what << ": " << found << " instead of " << expected;
  }

  /** Largest entry of D minus central differences, over the largest of D. */
  double
  tangent_error(const Material     &material,
                const Tensor<1, 3> &strain,
                const double        kappa)
  {
    constexpr double h     = 1e-6;
    const auto       D     = respond(material, strain, kappa).tangent;
    double           error = 0, size = 0;
    for (unsigned int B = 0; B < 3; ++B)
      {
        Tensor<1, 3> up = strain, down = strain;
        up[B] += h;
        down[B] -= h;
        const auto difference = (respond(material, up, kappa).stress -
                                 respond(material, down, kappa).stress) /
                                (2 * h);
        for (unsigned int A = 0; A < 3; ++A)
          {
            error = std::max(error, std::abs(D[A][B] - difference[A]));
            size  = std::max(size, std::abs(D[A][B]));
          }
      }
    return std::isfinite(D.norm()) ? error / size :
                                     std::numeric_limits<double>::infinity();
  }

  /** c : l, by the symmetry of c, for any l. */
  Stress
  times(const moraine::VoigtMatrix<3> &c, const Matrix &l)
  {
    const auto pairs = moraine::voigt_pairs<3>();
    Stress     result;
    for (unsigned int I = 0; I < 6; ++I)
      for (unsigned int J = 0; J < 6; ++J)
        {
          const auto [k, m] = pairs[J];
          result[pairs[I][0]][pairs[I][1]] +=
            c[I][J] * (k == m ? l[k][k] : l[k][m] + l[m][k]);
        }
    return result;
  }

  /**
   * Largest norm of d(tau) - (c : l + l tau + tau l^T) for unit l with
   * d(F) = l F, by central differences, over the elastic stiffness.
   */
  double
  spatial_tangent_error(const Material  &material,
                        const Committed &from,
                        const Matrix    &DF)
  {
    constexpr double h      = 1e-6;
    const Answer     answer = step(material, from, DF);
    const Matrix     tau    = answer.tau;
    double           error  = 0;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          Matrix l;
          l[i][j]             = 1;
          const Stress differ = (step(material, from, DF + h * l * DF).tau -
                                 step(material, from, DF - h * l * DF).tau) /
                                (2 * h);
          const Stress exact =
            times(answer.tangent, l) + symmetrize(l * tau + tau * transpose(l));
          const double e = (differ - exact).norm();
          error          = std::isfinite(e) ? std::max(error, e) :
                                              std::numeric_limits<double>::infinity();
        }
    return error / (lambda + 2 * G);
  }
} // namespace

TEST(Materials, AllModelsAreDriven)
{
  ParameterHandler   prm;
  MaterialParameters declared;
  declared.add_parameters(prm);
  std::ostringstream described;
  prm.print_parameters(described, ParameterHandler::JSON);
  EXPECT_NE(described.str().find(
              "[Selection linear elastic|neo-Hookean|von "
              "Mises|Mohr-Coulomb|Tresca|Drucker-Prager|Cam-clay|UMAT ]"),
            std::string::npos)
    << "another model: drive it too (UMAT: umat_test.cc). " << described.str();
  for (const auto &[name, material] : all_materials())
    {
      EXPECT_DOUBLE_EQ(material->elastic_stiffness().mu, G) << name;
      EXPECT_EQ(material->is_linear(), name == "linear elastic") << name;
      EXPECT_EQ(material->has_small_strain_limit(), name != "neo-Hookean");
      EXPECT_EQ(is_plastic(*material),
                name != "linear elastic" && name != "neo-Hookean");
    }
}

TEST(Materials, UniaxialStrain)
{
  // Elastic all of them where 2 G a < sigma_y.
  for (const double a : {0.3, -0.4, 0.01, -0.01})
    for (const auto &[name, material] : all_materials())
      {
        const double mean = lambda * a;
        Tensor<1, 3> tau  = vector(mean + 2 * G * a, mean, mean);
        if (name == "neo-Hookean")
          tau[0] = mean + G * (std::exp(2 * a) - 1);
        else if (is_plastic(*material) && std::abs(a) > 0.1)
          {
            if (name != "perfect")
              continue;
            const double s = std::copysign(2. / 3. * sigma_y, a);
            tau            = vector(K * a + s, K * a - s / 2, K * a - s / 2);
          }
        for (const unsigned int n_steps : {1, 10})
          expect_near(drive(*material, uniaxial(a), n_steps).tau,
                      symmetrize(diagonal(tau)),
                      1e-12 * E,
                      name);
      }
}

TEST(Materials, SimpleShear)
{
  for (const double gamma : {0.01, 0.7, -3.})
    for (const auto &[name, material] : all_materials())
      {
        const Path shear = [gamma](const double t) {
          Matrix F = unit_symmetric_tensor<3>();
          F[0][1]  = gamma * t;
          return F;
        };
        // The principal logarithmic strains are e, -e and 0.
        const double e     = std::asinh(gamma / 2);
        const double cos_2 = gamma / std::sqrt(4 + gamma * gamma);
        const double sin_2 = 2 / std::sqrt(4 + gamma * gamma);
        double       size  = 2 * G * e;
        Stress       tau;
        if (is_plastic(*material) && std::abs(size) > sigma_y / std::sqrt(3.))
          {
            if (name != "perfect")
              continue;
            size = std::copysign(sigma_y / std::sqrt(3.), gamma);
            EXPECT_NEAR(drive(*material, shear, 1).committed.kappa,
                        (2 * std::abs(e) - std::abs(size) / G) / std::sqrt(3.),
                        1e-13);
          }
        tau[0][0] = size * cos_2;
        tau[1][1] = -size * cos_2;
        tau[0][1] = size * sin_2;
        if (name == "neo-Hookean")
          {
            tau       = Stress();
            tau[0][0] = G * gamma * gamma;
            tau[0][1] = G * gamma;
          }
        expect_near(drive(*material, shear, 1).tau, tau, 1e-12 * E, name);
        // Elastic stress does not depend on the path.
        if (!is_plastic(*material))
          expect_near(drive(*material, shear, 7).tau, tau, 1e-12 * E, name);
      }
}

TEST(VonMises, HardeningOverKinks)
{
  // In uniaxial strain a the trial deviator has the norm 2 G a sqrt(2/3), so
  // each accumulated plastic strain belongs to one a.
  for (const auto &[name, rows] : {std::make_pair("hardening", hardening_rows),
                                   std::make_pair("softening", softening_rows)})
    for (const double kappa :
         {1e-9, 0.004, 0.01, 0.02, 0.03, 0.06, 0.1, 0.15, 0.5})
      for (const double sign : {1., -1.})
        {
          const Material &material = *all_materials().at(name);
          const double    yield    = value_of(rows, kappa);
          const double    a        = sign * (yield + 3 * G * kappa) / (2 * G);
          const double    s        = sign * 2. / 3. * yield;
          const auto      tau =
            diagonal(vector(K * a + s, K * a - s / 2, K * a - s / 2));
          for (const unsigned int n_steps : {1, 2, 50})
            {
              const Answer answer = drive(material, uniaxial(a), n_steps);
              EXPECT_NEAR(answer.committed.kappa, kappa, 1e-13) << name;
              expect_near(answer.tau, symmetrize(tau), 1e-11, name);
            }
        }
}

namespace
{
  std::vector<std::pair<double, double>>
  yield_rows(const std::string &name)
  {
    return name == "hardening" ? hardening_rows :
           name == "softening" ? softening_rows :
                                 decltype(hardening_rows){{0, sigma_y}};
  }
} // namespace

TEST(VonMises, StaysOnItsSurfaceAndRests)
{
  for (const std::string name : {"perfect", "hardening", "softening"})
    {
      const Material &material = *all_materials().at(name);
      const auto      rows     = yield_rows(name);
      const Answer    loaded   = drive(material, general(0.4), 6);
      EXPECT_GT(loaded.committed.kappa, 0.1);
      EXPECT_NEAR(deviator(loaded.tau).norm(),
                  std::sqrt(2. / 3.) * value_of(rows, loaded.committed.kappa),
                  1e-13 * E);
      // The plastic flow keeps the volume.
      EXPECT_NEAR(std::sqrt(determinant(loaded.committed.b_e)),
                  determinant(general(0.4)(1)),
                  1e-12);

      // At rest nothing flows, and the answer is elastic; so is unloading.
      const Matrix one  = unit_symmetric_tensor<3>();
      const Answer rest = step(material, loaded.committed, one);
      EXPECT_EQ(rest.committed.kappa, loaded.committed.kappa);
      expect_near(rest.tau, loaded.tau, 1e-12 * E, name);
      const auto   spectrum = moraine::spectrum<3>(loaded.committed.b_e);
      Tensor<1, 3> strain;
      for (unsigned int A = 0; A < 3; ++A)
        strain[A] = 0.5 * std::log(spectrum.values[A]);
      const double kappa = loaded.committed.kappa;
      EXPECT_DOUBLE_EQ(respond(material, strain, kappa).tangent[0][0],
                       lambda + 2 * G);
      EXPECT_DOUBLE_EQ(respond(material, 0.9 * strain, kappa).tangent[0][1],
                       lambda);
      EXPECT_EQ(respond(material, 0.9 * strain, kappa).plastic_strain, kappa);
    }
}

/** Stress and tangent are numbers, and stress is on or within the surface. */
TEST(Materials, RandomPaths)
{
  std::mt19937               generator(1);
  std::normal_distribution<> normal;
  for (const auto &[name, material] : all_materials())
    for (unsigned int path = 0; path < 20000; ++path)
      {
        Stress elastic;
        double kappa = 0;
        for (unsigned int i = 0; i < 3; ++i)
          {
            Stress trial = elastic;
            for (unsigned int I = 0; I < 6; ++I)
              trial.access_raw_entry(I) +=
                0.02 * std::pow(0.1, i) * normal(generator);
            const auto     spectrum = moraine::spectrum<3>(trial);
            const Response at = respond(*material, spectrum.values, kappa);
            ASSERT_TRUE(std::isfinite(at.stress.norm()) &&
                        std::isfinite(at.tangent.norm()))
              << name;
            if (is_plastic(*material))
              {
                ASSERT_GE(at.plastic_strain, kappa) << name;
                kappa          = at.plastic_strain;
                const Stress s = deviator(spectrum.tensor(at.stress));
                ASSERT_LE(std::sqrt(1.5) * s.norm(),
                          value_of(yield_rows(name), kappa) + 1e-9)
                  << name;
              }
            elastic = spectrum.tensor(at.strain);
          }
      }
}



TEST(VonMises, NoDeviator)
{
  for (const double a : {0., 1e-300, 0.5, -0.5})
    {
      const auto point =
        respond(*all_materials().at("perfect"), vector(a, a, a));
      for (unsigned int A = 0; A < 3; ++A)
        {
          EXPECT_NEAR(point.stress[A], 3 * K * a, 1e-12 * E);
          EXPECT_DOUBLE_EQ(point.tangent[A][A], lambda + 2 * G);
        }
      EXPECT_EQ(point.plastic_strain, 0);
    }
}

TEST(VonMises, NoReturn)
{
  // Falls with -3G from 0.01 to 0.02; radii.
  const double   fall = 0.01 * std::sqrt(6.) * G;
  const VonMises steep(E, nu, 1, {{0, 4}, {0.01, 4}, {0.02, 4 - fall}});
  const auto     trial = [](const double radius) {
    return vector(1, -1, 0) * (radius / (2 * G * std::sqrt(2.)));
  };
  const auto before = respond(steep, trial(4 + 0.99 * fall));
  EXPECT_NEAR(before.plastic_strain, 0.0099, 1e-14);
  for (const double radius : {4 + 1.01 * fall, 100.})
    {
      const auto none = respond(steep, trial(radius));
      for (unsigned int A = 0; A < 3; ++A)
        EXPECT_TRUE(std::isnan(none.stress[A]));
    }
  EXPECT_TRUE(std::isfinite(respond(steep, trial(3)).stress.norm()));
  EXPECT_EQ(steep.why_no_stress().rfind("it cannot return to its yield "
                                        "surface",
                                        0),
            0u);

  for (const auto &[name, material] : all_materials())
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()})
      EXPECT_FALSE(
        std::isfinite(respond(*material, vector(bad, 0, 0)).stress.norm()))
        << name;
}

TEST(VonMises, MeaningOfTheKeys)
{
  const auto radius = [](const MaterialParameters &p) {
    const auto material = make_material(p, "Materials/m");
    return dynamic_cast<const VonMises &>(*material).yield_radius(0.5);
  };
  auto uniaxial = parameters("von Mises", "0: 1, 1: 5");
  EXPECT_DOUBLE_EQ(radius(uniaxial), 3 * std::sqrt(2. / 3.));
  auto shear                        = parameters("von Mises");
  shear.texts["Shear yield stress"] = "3";
  EXPECT_DOUBLE_EQ(radius(shear), 3 * std::sqrt(2.));
  auto direct                  = parameters("von Mises");
  direct.texts["Yield radius"] = "3";
  EXPECT_DOUBLE_EQ(radius(direct), 3);

  // In pure shear, at once far beyond yield, tau_12 is k.
  const auto sheared =
    respond(*make_material(shear, "m"), vector(0.1, -0.1, 0));
  EXPECT_NEAR(sheared.stress[0], 3, 1e-12);
  // In uniaxial tension, lateral strain as it is without lateral stress.
  const double a = 3 / E, p = 0.2;
  const auto pulled = respond(*make_material(parameters("von Mises", "3"), "m"),
                              vector(a + p, -nu * a - p / 2, -nu * a - p / 2));
  EXPECT_NEAR(pulled.stress[0], 3, 1e-11);
  EXPECT_NEAR(pulled.stress[1], 0, 1e-11);
  EXPECT_NEAR(pulled.plastic_strain, p, 1e-13);
}

TEST(NeoHookean, TendsToLinearElasticity)
{
  for (const double size : {1e-4, 1e-8})
    {
      const auto e = size * vector(1, -0.5, 0.2);
      EXPECT_LE((respond(*all_materials().at("neo-Hookean"), e).stress -
                 respond(*all_materials().at("linear elastic"), e).stress)
                  .norm(),
                3 * G * size * size);
    }
}

TEST(Materials, Objectivity)
{
  for (const auto &[name, material] : all_materials())
    {
      const Path   path  = general(0.4);
      const Answer plain = drive(*material, path, 5);
      // Rotating on the way, and through more than a full turn.
      const Path turning = [&](const double t) {
        return rotation(7 * t) * path(t);
      };
      const Answer turned = drive(*material, turning, 5);
      const Matrix Q      = rotation(7);
      const Matrix tau    = plain.tau;
      expect_near(turned.tau,
                  symmetrize(Q * tau * transpose(Q)),
                  1e-12 * E,
                  name);
      EXPECT_NEAR(turned.committed.kappa, plain.committed.kappa, 1e-13) << name;

      // An isotropic material does not see a rotation before the deformation.
      expect_near(step(*material, Committed(), path(1) * Q).tau,
                  step(*material, Committed(), path(1)).tau,
                  1e-12 * E,
                  name);
      // Rotation alone is no strain.
      expect_near(step(*material, Committed(), Q).tau,
                  Stress(),
                  1e-12 * E,
                  name);
    }
}

TEST(Materials, PlaneStrainIsTheSameLaw)
{
  for (const auto &[name, material] : all_materials())
    for (const double size : {0.01, 0.4, -0.4})
      {
        Matrix F = general(size)(1);
        for (unsigned int i = 0; i < 2; ++i)
          F[i][2] = F[2][i] = 0;
        F[2][2] = 1;
        expect_near(step<2>(*material, Committed(), F).tau,
                    step<3>(*material, Committed(), F).tau,
                    1e-12 * E,
                    name);
      }
}

TEST(Materials, TangentInPrincipalDirections)
{
  const std::vector<Tensor<1, 3>> strains = {vector(0, 0, 0),
                                             vector(1e-3, -2e-3, 5e-4),
                                             vector(0.05, -0.02, 0.01),
                                             vector(0.05, 0.05, 0.05),
                                             vector(0.05, 0.05, -0.05),
                                             vector(0.2, 0.2 + 1e-9, -0.3),
                                             vector(-0.2, 0.02, 0.1),
                                             vector(-0.02, -0.02, 0.001)};
  double                          largest = 0;
  for (const auto &[name, material] : all_materials())
    for (const double kappa : {0., 0.005, 0.02, 0.05, 0.2})
      for (const auto &strain : strains)
        {
          const double error = tangent_error(*material, strain, kappa);
          EXPECT_LE(error, 1e-6) << name << ' ' << strain << ' ' << kappa;
          largest       = std::max(largest, error);
          const auto &D = respond(*material, strain, kappa).tangent;
          EXPECT_LE((D - transpose(D)).norm(), 1e-12 * E);
        }
  record_largest(largest);
}

TEST(Materials, StressIsTheDerivativeOfTheStoredEnergy)
{
  const Tensor<1, 3> strain = vector(0.3, -0.2, 0.05);
  for (const auto &[name, material] : all_materials())
    {
      if (material->dissipates())
        continue;
      SCOPED_TRACE(name);
      const double size = 1e-5;
      for (unsigned int A = 0; A < 3; ++A)
        {
          std::vector<moraine::ElasticPoint> points(2, {strain, nullptr});
          points[0].strain[A] -= size;
          points[1].strain[A] += size;
          std::vector<double> energies(2);
          material->stored_energies(
            ArrayView<const moraine::ElasticPoint>(points.data(), 2),
            make_array_view(energies));
          const auto answer = respond(*material, strain);
          EXPECT_NEAR((energies[1] - energies[0]) / (2 * size),
                      answer.stress[A],
                      1e-7 * E);
        }
    }
}



TEST(VonMises, TangentAtKinks)
{
  // The slope that follows counts: against differences towards more strain.
  for (const auto &[name, rows] : {std::make_pair("hardening", hardening_rows),
                                   std::make_pair("softening", softening_rows)})
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        const Material &material  = *all_materials().at(name);
        const auto [kappa, yield] = rows[i];
        const auto strain_for     = [&](const double extra) {
          return vector(1, -0.5, -0.5) *
                 (yield * (1 + 1e-11) + 3 * G * kappa + extra) / (3 * G);
        };
        const auto at = respond(material, strain_for(0));
        EXPECT_NEAR(at.plastic_strain, kappa, 1e-11);
        const double h = 1e-6;
        const double ahead =
          (respond(material, strain_for(h)).stress[0] - at.stress[0]) /
          (h / (3 * G));
        const auto &D = at.tangent[0];
        EXPECT_NEAR(D[0] - 0.5 * D[1] - 0.5 * D[2], ahead, 1e-5 * E)
          << name << ' ' << i;
      }
}

TEST(Materials, SpatialTangent)
{
  const Matrix turn    = rotation(0.8);
  double       largest = 0;
  for (const auto &[name, material] : all_materials())
    {
      std::vector<std::pair<Committed, Matrix>> cases;
      // Stretches that are apart, nearly equal and equal; elastic and not.
      for (const double gap : {0., 1e-12, 1e-9, 1e-7, 1e-6, 3e-6, 1e-4, 0.1})
        for (const double size : {0., 0.003, 0.2, -0.2})
          for (const bool all : {false, true})
            cases.emplace_back(Committed(),
                               turn *
                                 diagonal(vector(std::exp(size + gap),
                                                 std::exp(size),
                                                 all ?
                                                   std::exp(size - 2 * gap) :
                                                   std::exp(-0.5 * size))) *
                                 rotation(-0.3));
      // After plastic steps, and just beyond yield.
      for (const double size : {0.05, 0.4})
        cases.emplace_back(drive(*material, general(size), 4).committed,
                           general(0.1)(1));
      for (const double beyond : {1e-4, 1e-2})
        cases.emplace_back(Committed(),
                           uniaxial(sigma_y / (2 * G) * (1 + beyond))(1));
      for (unsigned int i = 0; i < cases.size(); ++i)
        {
          const double error =
            spatial_tangent_error(*material, cases[i].first, cases[i].second);
          EXPECT_LE(error, 1e-6) << name << ' ' << i;
          largest = std::max(largest, error);
        }
    }
  record_largest(largest);
}

TEST(Materials, TangentAtSmallStrain)
{
  const auto at = [](const Material &material, const Stress &strain) {
    const auto spectrum = moraine::spectrum<3>(strain);
    const auto point    = respond(material, spectrum.values);
    return std::make_pair(spectrum.tensor(point.stress),
                          moraine::spatial_tangent<3>(spectrum,
                                                      spectrum.values,
                                                      point,
                                                      StrainMeasure::small));
  };
  constexpr double h = 1e-6;
  for (const auto &[name, material] : all_materials())
    for (const double size : {0.002, 0.1})
      {
        if (!material->has_small_strain_limit())
          continue;
        const Stress strain =
          size * symmetrize(Matrix({{1, 0.3, 0}, {0, -0.2, 0.6}, {0, 0, 1}}));
        const auto c = at(*material, strain).second;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              Matrix l;
              l[i][j]        = 1;
              const Stress d = symmetrize(l);
              expect_near((at(*material, strain + h * d).first -
                           at(*material, strain - h * d).first) /
                            (2 * h),
                          times(c, l),
                          1e-6 * E,
                          name);
            }
      }
}

namespace
{
  std::string
  complaint(const MaterialParameters &p)
  {
    return message_of<InputError>([&] { make_material(p, "Materials/m"); });
  }

  std::string
  yield_complaint(const std::string &yield)
  {
    return complaint(parameters("von Mises", yield));
  }

  /** That of section Materials/m, @p key. */
  std::string
  about(const std::string &key, const std::string &found)
  {
    return "section 'Materials/m', key '" + key + "': found '" + found + "'";
  }
} // namespace

TEST(MaterialLibrary, ElasticConstants)
{
  auto p                   = parameters("linear elastic");
  p.texts["Young modulus"] = "0";
  EXPECT_EQ(complaint(p),
            about("Young modulus", "0") + ", allowed: a number > 0");
  p                        = parameters("neo-Hookean");
  p.texts["Poisson ratio"] = "0.5";
  EXPECT_EQ(complaint(p),
            about("Poisson ratio", "0.5") +
              ", allowed: a number > -1 and < 0.5");
  EXPECT_EQ(complaint(parameters("linear elastic")), "");
}

TEST(MaterialLibrary, YieldKeys)
{
  const std::string uniaxial = "Uniaxial yield stress";
  EXPECT_EQ(yield_complaint(""),
            about(uniaxial, "") +
              ", allowed: a yield stress > 0, in this key, in 'Shear yield "
              "stress' or in 'Yield radius'");
  auto two                  = parameters("von Mises", "2");
  two.texts["Yield radius"] = "3";
  EXPECT_EQ(complaint(two),
            about("Yield radius", "3") +
              ", allowed: nothing; 'Uniaxial yield stress' gives the yield "
              "stress");
  auto elastic                        = parameters("linear elastic");
  elastic.texts["Shear yield stress"] = "3";
  EXPECT_EQ(complaint(elastic),
            about("Shear yield stress", "3") +
              ", allowed: nothing; the keys of 'linear elastic' are Density, "
              "Saturated density, "
              "Young modulus, Poisson ratio");
  EXPECT_EQ(complaint(parameters("neo-Hookean", "3")),
            about(uniaxial, "3") +
              ", allowed: nothing; the keys of 'neo-Hookean' are Density, "
              "Saturated density, Young "
              "modulus, Poisson ratio");
}

TEST(MaterialLibrary, YieldTables)
{
  const std::string key = "Uniaxial yield stress";
  for (const std::string bad : {"0", "-1"})
    EXPECT_EQ(yield_complaint(bad),
              about(key, bad) + ", allowed: a number > 0");
  for (const std::string bad : {"0: 1, 1: 0", "0: -1, 1: 2"})
    EXPECT_EQ(yield_complaint(bad),
              about(key, bad) + ", allowed: yield stresses > 0");
  EXPECT_EQ(yield_complaint("0: 1"),
            about(key, "0: 1") +
              ", allowed: a number, or a table with at least two rows");
  for (const std::string bad : {"0.1: 1, 1: 2", "-1: 1, 1: 2"})
    EXPECT_EQ(yield_complaint(bad),
              about(key, bad) + ", allowed: a table whose first kappa is 0");
  for (const std::string last : {"0.5: 3", "0.2: 3"})
    EXPECT_EQ(yield_complaint("0: 1, 0.5: 2, " + last),
              about(key, last) + " in a table, but kappa must increase");
  EXPECT_EQ(yield_complaint("0: 1, 1"),
            about(key, "1") +
              " in a table; allowed: 'kappa: value', two numbers");
  EXPECT_NE(yield_complaint("0: 1,").find(
              "Allowed: a number, or a table 'kappa: value, kappa: value, "
              "...' with increasing kappa"),
            std::string::npos)
    << yield_complaint("0: 1,");
  for (const std::string bad : {"soft", "1, 2", "nan", "2 + kappa"})
    EXPECT_NE(yield_complaint(bad).find("Allowed: an expression in x,y"),
              std::string::npos)
      << bad << yield_complaint(bad);
}

TEST(MaterialLibrary, SteepSoftening)
{
  // 3G is 288.46 for sigma_y, sqrt(3) G is 166.54 for k, sqrt(6) G is 235.53
  // for the radius.
  EXPECT_EQ(yield_complaint("0: 10, 1: 10, 1.01: 7.1"),
            about("Uniaxial yield stress", "0: 10, 1: 10, 1.01: 7.1") +
              ", allowed: a slope above -288.462, where sigma_y falls by 3G; "
              "between kappa = 1 and 1.01 it is -290");
  EXPECT_EQ(yield_complaint("0: 10, 1: 10, 1.01: 7.2"), "");
  const auto of = [](const std::string &key, const std::string &text) {
    auto p       = parameters("von Mises");
    p.texts[key] = text;
    return complaint(p);
  };
  EXPECT_NE(
    of("Shear yield stress", "0: 10, 0.01: 8.3").find("above -166.543,"),
    std::string::npos);
  EXPECT_EQ(of("Shear yield stress", "0: 10, 0.01: 8.4"), "");
  EXPECT_NE(of("Yield radius", "0: 10, 0.01: 7.6").find("above -235.528,"),
            std::string::npos);
  EXPECT_EQ(of("Yield radius", "0: 10, 0.01: 7.7"), "");
}
