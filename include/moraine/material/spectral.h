// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_spectral_h
#define moraine_material_spectral_h

#include <moraine/material/material.h>

#include <array>
#include <cmath>

namespace moraine
{
  /** Principal values @f$\lambda_A@f$ and orthonormal directions @f$n_A@f$. */
  struct Spectrum
  {
    dealii::Tensor<1, 3> values;
    dealii::Tensor<2, 3> directions; ///< row A is @f$n_A@f$

    /** @f$\sum_A f_A\, n_A \otimes n_A@f$ */
    dealii::SymmetricTensor<2, 3>
    tensor(const dealii::Tensor<1, 3> &f) const
    {
      dealii::SymmetricTensor<2, 3> sum;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          for (unsigned int A = 0; A < 3; ++A)
            sum[i][j] += f[A] * directions[A][i] * directions[A][j];
      return sum;
    }
  };

  /** The spectrum of @p a. With dim = 2, z is a principal direction, the third,
   * and the others have a closed form. */
  template <int dim>
  inline Spectrum
  spectrum(const dealii::SymmetricTensor<2, 3> &a)
  {
    Spectrum result;
    if constexpr (dim == 3)
      {
        const auto pairs = dealii::eigenvectors(
          a, dealii::SymmetricTensorEigenvectorMethod::jacobi);
        for (unsigned int A = 0; A < 3; ++A)
          {
            result.values[A]     = pairs[A].first;
            result.directions[A] = pairs[A].second;
          }
      }
    else
      {
        const double mean = 0.5 * (a[0][0] + a[1][1]);
        const double d    = 0.5 * (a[0][0] - a[1][1]);
        const double c    = a[0][1];
        const double r    = std::sqrt(d * d + c * c);
        // n_1 from whichever row of a - lambda_2 1 does not cancel
        double       x          = d >= 0 ? r + d : c;
        double       y          = d >= 0 ? c : r - d;
        const double norm       = std::sqrt(x * x + y * y);
        x                       = norm > 0 ? x / norm : 1.;
        y                       = norm > 0 ? y / norm : 0.;
        result.values[0]        = mean + r;
        result.values[1]        = mean - r;
        result.values[2]        = a[2][2];
        result.directions[0][0] = x;
        result.directions[0][1] = y;
        result.directions[1][0] = -y;
        result.directions[1][1] = x;
        result.directions[2][2] = 1;
      }
    return result;
  }

  /** Components of a symmetric tensor in dim dimensions. */
  template <int dim>
  inline constexpr unsigned int n_voigt = dim *(dim + 1) / 2;

  /** Rows and columns of the components: 11, 22, 12; in 3D 11, 22, 33, 12, 13,
   * 23 (the order of dealii::SymmetricTensor). */
  template <int dim>
  inline constexpr std::array<std::array<unsigned int, 2>, n_voigt<dim>>
  voigt_pairs()
  {
    if constexpr (dim == 2)
      return {{{{0, 0}}, {{1, 1}}, {{0, 1}}}};
    else
      return {{{{0, 0}}, {{1, 1}}, {{2, 2}}, {{0, 1}}, {{0, 2}}, {{1, 2}}}};
  }

  /** A fourth-order tensor with minor symmetries, @f$c_{IJ} = c_{ijkl}@f$. */
  template <int dim>
  using VoigtMatrix =
    std::array<std::array<double, n_voigt<dim>>, n_voigt<dim>>;

  template <int dim>
  inline VoigtMatrix<dim>
  voigt_matrix(const dealii::SymmetricTensor<4, 3> &c)
  {
    constexpr auto   pairs = voigt_pairs<dim>();
    VoigtMatrix<dim> result;
    for (unsigned int I = 0; I < n_voigt<dim>; ++I)
      for (unsigned int J = 0; J < n_voigt<dim>; ++J)
        result[I][J] = c[pairs[I][0]][pairs[I][1]][pairs[J][0]][pairs[J][1]];
    return result;
  }

  /**
   * Principal strains that differ by no more than this are equal in a tangent:
   * of a difference quotient of stresses, round-off would leave less than the
   * limit is off by. It goes with the strains, as yield strains may be small.
   */
  inline double
  equal_strains(const dealii::Tensor<1, 3> &strain)
  {
    return 1e-7 *
           std::max(
             {std::abs(strain[0]), std::abs(strain[1]), std::abs(strain[2])});
  }



  /**
   * The spatial tangent @f$c@f$ of the Kirchhoff stress, with which a material
   * frame's rate obeys @f$L_v \tau = c : d@f$ (at small strain
   * @f$c = \partial\sigma/\partial\varepsilon@f$). In principal directions
   * (Simo 1998, isotropic return mapping in principal axes)
   *
   * @f{gather*}{
   *   c_{AABB} = D_{AB} - 2\tau_A\delta_{AB}, \qquad
   *   c_{ABAB} = \frac{\tau_A\lambda_B - \tau_B\lambda_A}{\lambda_A-\lambda_B}
   *            = -\frac{\tau_A+\tau_B}{2}
   *              + \frac{\tau_A-\tau_B}{2\tanh(\varepsilon_A-\varepsilon_B)},
   * @f}
   *
   * where @f$\lambda = e^{2\varepsilon}@f$ are the principal values of the
   * trial @f$b^e@f$. The form with tanh loses no digits where they are nearly
   * equal; where they are equal the quotient is @f$(D_{AA} - D_{AB})/2@f$. At
   * small strain the terms with @f$\tau@f$ alone are missing and tanh is the
   * identity.
   *
   * @param directions of the trial strain
   * @param trial_strain @f$\varepsilon_A@f$, the principal trial strains
   * @param answer what the material answered to them
   * @param measure small or finite strain
   */
  template <int dim>
  inline VoigtMatrix<dim>
  spatial_tangent(const Spectrum             &directions,
                  const dealii::Tensor<1, 3> &trial_strain,
                  const PrincipalState       &answer,
                  const StrainMeasure         measure)
  {
    constexpr unsigned int n      = n_voigt<dim>;
    constexpr auto         pairs  = voigt_pairs<dim>();
    const bool             finite = measure == StrainMeasure::finite;
    const auto            &tau    = answer.stress;
    const auto            &D      = answer.tangent;
    const auto            &e      = directions.directions;

    // In 2D the third direction has no in-plane components.
    double m[dim][n];
    for (unsigned int A = 0; A < dim; ++A)
      for (unsigned int I = 0; I < n; ++I)
        m[A][I] = e[A][pairs[I][0]] * e[A][pairs[I][1]];

    const double     equal = equal_strains(trial_strain);
    VoigtMatrix<dim> c{};
    for (unsigned int A = 0; A < dim; ++A)
      for (unsigned int B = 0; B < dim; ++B)
        {
          const double D_AB = D[A][B] - (finite && A == B ? 2 * tau[A] : 0.);
          for (unsigned int I = 0; I < n; ++I)
            for (unsigned int J = 0; J < n; ++J)
              c[I][J] += D_AB * m[A][I] * m[B][J];
        }
    for (unsigned int A = 0; A < dim; ++A)
      for (unsigned int B = A + 1; B < dim; ++B)
        {
          const double difference = trial_strain[A] - trial_strain[B];
          double       shear      = std::abs(difference) <= equal ?
                                      0.25 * (D[A][A] - D[A][B] + D[B][B] - D[B][A]) :
                                      0.5 * (tau[A] - tau[B]) /
                             (finite ? std::tanh(difference) : difference);
          if (finite)
            shear -= 0.5 * (tau[A] + tau[B]);
          double s[n];
          for (unsigned int I = 0; I < n; ++I)
            s[I] = e[A][pairs[I][0]] * e[B][pairs[I][1]] +
                   e[A][pairs[I][1]] * e[B][pairs[I][0]];
          for (unsigned int I = 0; I < n; ++I)
            for (unsigned int J = 0; J < n; ++J)
              c[I][J] += shear * s[I] * s[J];
        }
    return c;
  }
} // namespace moraine

#endif
