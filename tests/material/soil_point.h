// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_tests_material_soil_point_h
#define moraine_tests_material_soil_point_h

#include <moraine/material/soil_strength.h>
#include <moraine/material/spectral.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace soil_point
{
  using namespace dealii;
  using moraine::Material;
  using moraine::PrincipalState;
  using moraine::SoilParameters;

  constexpr double degree = 3.14159265358979323846 / 180;
  constexpr double none   = std::numeric_limits<double>::infinity();

  /** E = 20 000, nu = 0.3 and constants; angles in degrees. */
  inline SoilParameters
  soil(const double c, const double phi, const double psi, const double tension)
  {
    SoilParameters result;
    result.elasticity       = {20000., 0.3, 2.};
    result.cohesion         = {{0, c}};
    result.friction_angle   = {{0, phi}};
    result.dilation_angle   = {{0, psi}};
    result.tensile_strength = {{0, tension}};
    return result;
  }

  struct Response : PrincipalState
  {
    std::array<double, 2> variables;
  };

  inline Response
  respond(const Material             &material,
          const Tensor<1, 3>         &strain,
          const std::array<double, 2> variables = {{0, 0}})
  {
    Response point;
    point.strain    = strain;
    point.variables = variables;
    point.internal  = point.variables.data();
    material.respond(moraine::StepTime(), ArrayView<PrincipalState>(&point, 1));
    point.internal = nullptr;
    return point;
  }

  /** Of the components 11 22 33 12 13 23: the strain of a step, or the stress
   * at its end. */
  struct Control
  {
    bool   is_stress;
    double value;
  };
  inline Control
  strain(const double increment)
  {
    return {false, increment};
  }
  inline Control
  stress(const double value)
  {
    return {true, value};
  }
  using Controls = std::vector<Control>; ///< six

  /** A point at small strain. */
  class Sample
  {
  public:
    Sample(const Material &material, const SymmetricTensor<2, 3> &stress)
      : stress(stress)
      , elastic(material.elastic_stiffness().strain_of(stress))
      , material(material)
    {}

    /** Equal steps; stresses go to the end at once. */
    void
    drive(const Controls &controls, const unsigned int n_steps = 1)
    {
      Controls part = controls;
      for (Control &control : part)
        if (!control.is_stress)
          control.value /= n_steps;
      for (unsigned int i = 0; i < n_steps; ++i)
        step(part);
    }

    SymmetricTensor<2, 3> stress, elastic, total;
    std::array<double, 2> variables{{0, 0}};
    unsigned int          most_iterations = 0;

  private:
    void
    step(const Controls &controls)
    {
      const auto            pairs = moraine::voigt_pairs<3>();
      SymmetricTensor<2, 3> increment;
      for (unsigned int I = 0; I < 6; ++I)
        if (!controls[I].is_stress)
          increment[pairs[I][0]][pairs[I][1]] = controls[I].value;

      const double mu = material.elastic_stiffness().mu;
      for (unsigned int iteration = 1;; ++iteration)
        {
          ASSERT_LE(iteration, 30) << "no equilibrium";
          const auto     spectrum = moraine::spectrum<3>(elastic + increment);
          const Response at  = respond(material, spectrum.values, variables);
          const auto     now = spectrum.tensor(at.stress);
          FullMatrix<double> matrix(6);
          Vector<double>     rest(6), change(6);
          const auto         c = moraine::spatial_tangent<3>(
            spectrum, spectrum.values, at, moraine::StrainMeasure::small);
          for (unsigned int I = 0; I < 6; ++I)
            {
              matrix(I, I) = 1;
              if (!controls[I].is_stress)
                continue;
              rest[I] = controls[I].value - now[pairs[I][0]][pairs[I][1]];
              for (unsigned int J = 0; J < 6; ++J)
                matrix(I, J) = c[I][J] * (J < 3 ? 1 : 2);
              // The tangent of an edge is singular.
              matrix(I, I) += 1e-6 * mu;
            }
          if (rest.linfty_norm() < 1e-9)
            {
              most_iterations = std::max(most_iterations, iteration);
              stress          = now;
              elastic         = spectrum.tensor(at.strain);
              total += increment;
              variables = at.variables;
              return;
            }
          matrix.gauss_jordan();
          matrix.vmult(change, rest);
          for (unsigned int I = 0; I < 6; ++I)
            increment[pairs[I][0]][pairs[I][1]] += change[I];
        }
    }

    const Material &material;
  };

  inline SymmetricTensor<2, 3>
  diagonal(const double x, const double y, const double z)
  {
    SymmetricTensor<2, 3> result;
    result[0][0] = x;
    result[1][1] = y;
    result[2][2] = z;
    return result;
  }

  /** The axial stress in the end of a triaxial test with a cell pressure of
   * 100. */
  inline double
  triaxial(const Material &material, const double axial_strain)
  {
    Sample point(material, diagonal(-100, -100, -100));
    point.drive({strain(axial_strain),
                 stress(-100),
                 stress(-100),
                 strain(0),
                 strain(0),
                 strain(0)},
                20);
    EXPECT_NEAR(point.stress[1][1], -100, 1e-8);
    return point.stress[0][0];
  }

  class Random
  {
  public:
    Tensor<1, 3>
    vector(const double mean, const double size)
    {
      return Tensor<1, 3>({mean + size * normal(generator),
                           mean + size * normal(generator),
                           mean + size * normal(generator)});
    }

    SymmetricTensor<2, 3>
    tensor(const double size)
    {
      SymmetricTensor<2, 3> result;
      for (unsigned int i = 0; i < 6; ++i)
        result.access_raw_entry(i) = size * normal(generator);
      return result;
    }

  private:
    std::mt19937               generator{1};
    std::normal_distribution<> normal;
  };

  /** Largest entry of the tangent minus a difference quotient, over E; one-
   * sided quotients differ where a region ends, and then it is -1. */
  inline double
  tangent_error(const Material             &material,
                const Tensor<1, 3>         &strain,
                const std::array<double, 2> variables = {{0, 0}})
  {
    constexpr double h     = 1e-8;
    const Response   at    = respond(material, strain, variables);
    double           error = 0;
    for (unsigned int B = 0; B < 3; ++B)
      {
        Tensor<1, 3> up = strain, down = strain;
        up[B] += h;
        down[B] -= h;
        const auto s_up   = respond(material, up, variables).stress,
                   s_down = respond(material, down, variables).stress;
        for (unsigned int A = 0; A < 3; ++A)
          {
            const double ahead  = (s_up[A] - at.stress[A]) / h,
                         behind = (at.stress[A] - s_down[A]) / h;
            if (!(std::abs(ahead - behind) < 2e-2 * 20000))
              return -1;
            error =
              std::max(error,
                       std::abs(0.5 * (ahead + behind) - at.tangent[A][B]) /
                         20000);
          }
      }
    return error;
  }

  /** Random paths of 3 tensors: stress is a number, admissible and at rest, and
   * plastic strain grows. */
  template <typename Soil>
  void
  walk(const Soil &material, const unsigned int n_paths, const double size)
  {
    Random random;
    for (unsigned int path = 0; path < n_paths; ++path)
      {
        SymmetricTensor<2, 3> elastic;
        std::array<double, 2> variables{{0, 0}};
        for (unsigned int i = 0; i < 3; ++i)
          {
            const auto trial = moraine::spectrum<3>(
              elastic + random.tensor(size * std::pow(0.1, i)));
            const Response at = respond(material, trial.values, variables);
            ASSERT_TRUE(std::isfinite(at.stress.norm()) &&
                        std::isfinite(at.tangent.norm()));
            ASSERT_GE(at.variables[0], variables[0]);
            ASSERT_LE(material.yield_function(at.stress, at.variables.data()),
                      1e-9);
            const Response rests = respond(material, at.strain, at.variables);
            ASSERT_LE((rests.stress - at.stress).norm(),
                      1e-12 * (1 + at.stress.norm()));
            ASSERT_EQ(rests.variables[0], at.variables[0]);
            ASSERT_GT(rests.tangent[0][0], 26923); // elastic
            elastic   = trial.tensor(at.strain);
            variables = at.variables;
          }
      }
  }
} // namespace soil_point

#endif
