// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/material_test.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/material/spectral.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_test_iterations = 30;
    constexpr double       smallest_test_part   = 1. / 1024;
    constexpr double       quotient_size        = 1e-7;

    /** Singular values are zero below this part of the largest. */
    constexpr double no_singular_value = 1e-12;



    double
    norm_of_six(const SixNumbers &x)
    {
      double sum = 0;
      for (const double value : x)
        sum += value * value;
      return std::sqrt(sum);
    }



    /** The least solution of A x = b, by singular values: at an edge or apex of
     * a yield surface A has none for some. */
    SixNumbers
    solve_six(const std::array<SixNumbers, 6> &A, const SixNumbers &b)
    {
      LAPACKFullMatrix<double> inverse(6);
      Vector<double>           x(6), right(b.begin(), b.end());
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          inverse(i, j) = A[i][j];
      inverse.compute_inverse_svd(no_singular_value);
      inverse.vmult(x, right);
      SixNumbers result;
      std::copy(x.begin(), x.end(), result.begin());
      return result;
    }



    /** F of the strains, or the small strain. */
    Tensor<2, 3>
    deformation(const StrainMeasure measure, const SixNumbers &strain)
    {
      constexpr auto pairs  = voigt_pairs<3>();
      const bool     finite = measure == StrainMeasure::finite;
      Tensor<2, 3>   F;
      for (unsigned int I = 0; I < 6; ++I)
        {
          const auto [k, m] = pairs[I];
          if (k == m)
            F[k][k] = finite ? std::exp(strain[I]) : strain[I];
          else
            F[k][m] = finite ? strain[I] : 0.5 * strain[I];
          if (k != m && !finite)
            F[m][k] = F[k][m];
        }
      return F;
    }



    double
    component_of(const SymmetricTensor<2, 3> &tensor, const unsigned int I)
    {
      constexpr auto pairs = voigt_pairs<3>();
      return tensor[pairs[I][0]][pairs[I][1]];
    }



    double
    value_of_sum(const StressStrainSum       &sum,
                 const SymmetricTensor<2, 3> &stress,
                 const SixNumbers            &strain)
    {
      double value = 0;
      for (unsigned int I = 0; I < 6; ++I)
        value += sum.of_stress[I] * component_of(stress, I) +
                 sum.of_strain[I] * strain[I];
      return value;
    }
  } // namespace



  MaterialTest::MaterialTest(const std::shared_ptr<const Material> &material,
                             const StrainMeasure                    measure,
                             const SymmetricTensor<2, 3> &initial_stress)
    : initial_stress(initial_stress)
    , point(material, measure, initial_stress)
    , stiffness(material->elastic_stiffness().lambda +
                2 * material->elastic_stiffness().mu)
  {}



  bool
  MaterialTest::try_strain(const StepTime &step, const SixNumbers &strain)
  {
    trial_strain                = strain;
    const StrainMeasure measure = point.strain_measure();
    const Tensor<2, 3>  before  = deformation(measure, committed_strain);
    const Tensor<2, 3>  after   = deformation(measure, strain);
    has_stress                  = point.try_step(step,
                                measure == StrainMeasure::small ?
                                                   after - before :
                                                   (after - before) * invert(before));
    return has_stress;
  }



  SymmetricTensor<2, 3>
  MaterialTest::slope(const unsigned int component, const bool elastic) const
  {
    const bool   finite = point.strain_measure() == StrainMeasure::finite;
    const auto   pair   = voigt_pairs<3>()[component];
    SixNumbers   unit{};
    Tensor<2, 3> l;
    unit[component] = 1;
    if (!finite)
      l = deformation(StrainMeasure::small, unit);
    else
      {
        l[pair[0]][pair[1]] =
          pair[0] == pair[1] ? std::exp(trial_strain[component]) : 1.;
        l = l * invert(deformation(StrainMeasure::finite, trial_strain));
      }
    return elastic ? point.law().elastic_stiffness() * symmetrize(l) :
                     point.stress_rate(l);
  }



  bool
  MaterialTest::try_values(const StepTime                       &step,
                           const std::array<StressStrainSum, 6> &sums,
                           const SixNumbers                     &values,
                           const bool                            elastic_first)
  {
    // Of sums with stresses: in units of strain.
    SixNumbers scale{};
    for (unsigned int i = 0; i < 6; ++i)
      scale[i] = norm_of_six(sums[i].of_stress) > 0 ? 1 / stiffness : 1.;
    double     tolerance = 0;
    SixNumbers strain    = committed_strain;
    for (unsigned int n = 0; n <= most_test_iterations; ++n)
      {
        if (!try_strain(step, strain))
          return false;
        SixNumbers residual;
        for (unsigned int i = 0; i < 6; ++i)
          residual[i] =
            scale[i] *
            (values[i] - value_of_sum(sums[i], point.stress(), strain));
        if (n == 0)
          tolerance = std::max(1e-10 * norm_of_six(residual),
                               1e-14 * (norm_of_six(strain) +
                                        point.stress().norm() / stiffness));
        if (norm_of_six(residual) <= tolerance)
          return true;
        std::array<SixNumbers, 6> matrix;
        for (unsigned int j = 0; j < 6; ++j)
          {
            const SymmetricTensor<2, 3> change =
              slope(j, elastic_first && n == 0);
            for (unsigned int i = 0; i < 6; ++i)
              {
                matrix[i][j] = scale[i] * sums[i].of_strain[j];
                for (unsigned int I = 0; I < 6; ++I)
                  matrix[i][j] +=
                    scale[i] * sums[i].of_stress[I] * component_of(change, I);
              }
          }
        const SixNumbers change = solve_six(matrix, residual);
        for (unsigned int j = 0; j < 6; ++j)
          strain[j] += change[j];
        ++iterations;
      }
    return false;
  }



  void
  MaterialTest::lead(const MaterialTestLeg       &leg,
                     const std::function<void()> &after_step)
  {
    SixNumbers first, last;
    for (unsigned int i = 0; i < 6; ++i)
      {
        first[i] = value_of_sum(leg.sums[i], stress(), strain());
        last[i]  = value_of_sum(leg.sums[i], initial_stress, SixNumbers());
        if (leg.values[i])
          last[i] += leg.factor * (*leg.values[i] - last[i]);
      }
    const unsigned int n_steps = leg.n_steps;
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        double at = 0, size = 1;
        iterations = 0;
        while (at < 1)
          {
            const double share = (n + at + size) / n_steps;
            SixNumbers   target;
            for (unsigned int i = 0; i < 6; ++i)
              target[i] = (1 - share) * first[i] + share * last[i];
            const StepTime step{time + (n + at) / n_steps, time + share};
            // Where it has flowed the tangent may be singular, though it
            // unloads.
            if (try_values(step, leg.sums, target, false) ||
                try_values(step, leg.sums, target, true))
              {
                at += size;
                if (at >= 1)
                  find_error_of_tangent(step);
                committed_strain = trial_strain;
                point.keep();
                size = std::min(2 * size, 1 - at);
                continue;
              }
            size /= 2;
            if (size < smallest_test_part)
              fail();
          }
        after_step();
      }
    time += 1;
  }



  void
  MaterialTest::find_error_of_tangent(const StepTime &step)
  {
    const SixNumbers                     strain = trial_strain;
    const SymmetricTensor<2, 3>          stress = point.stress();
    std::array<SymmetricTensor<2, 3>, 6> slopes;
    for (unsigned int j = 0; j < 6; ++j)
      slopes[j] = slope(j, false);
    double largest = 0, size = 0;
    for (unsigned int j = 0; j < 6; ++j)
      {
        const auto stress_at = [&](const double change) {
          SixNumbers moved = strain;
          moved[j] += change;
          try_strain(step, moved);
          return point.stress();
        };
        const SymmetricTensor<2, 3> up   = stress_at(quotient_size),
                                    down = stress_at(-quotient_size);
        double error = ((up - down) / (2 * quotient_size) - slopes[j]).norm();
        for (const SymmetricTensor<2, 3> &quotient :
             {(up - stress) / quotient_size, (stress - down) / quotient_size})
          error = std::min(error, (quotient - slopes[j]).norm());
        largest = std::max(largest, error);
        size    = std::max(size, slopes[j].norm());
      }
    error_of_tangent = size > 0 ? largest / size : largest;
    try_strain(step, strain);
  }



  void
  MaterialTest::fail() const
  {
    constexpr const char *names[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
    std::string           place;
    for (unsigned int I = 0; I < 6; ++I)
      if (committed_strain[I] != 0)
        place += (place.empty() ? "" : ", ") +
                 std::string(I < 3 ? "eps_" : "gamma_") + names[I] + " = " +
                 text_of(committed_strain[I]);
    throw ComputationError(
      "no step leads on from " + (place.empty() ? "the initial state" : place) +
      ", not even a 1024th of one; " +
      (has_stress ?
         "what is asked for may be out of reach, as beyond the strength" :
         point.law().why_no_stress()));
  }
} // namespace moraine
