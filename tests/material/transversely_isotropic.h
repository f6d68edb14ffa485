// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_tests_material_transversely_isotropic_h
#define moraine_tests_material_transversely_isotropic_h

#include <moraine/material/material.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  /**
   * The five constants of a linear elastic material that is the same in all
   * directions across an axis (layered rock, wood, fibres).
   */
  struct TransverseConstants
  {
    double axial_modulus;      ///< @f$E_a@f$, pulled along the axis [stress]
    double transverse_modulus; ///< @f$E_t@f$, pulled across it [stress]
    double axial_ratio;      ///< @f$\nu_a@f$: contraction across, pulled along
    double transverse_ratio; ///< @f$\nu_t@f$: both across
    double axial_shear_modulus; ///< @f$G_a@f$, in planes with the axis [stress]
  };

  /** Along the axis (0) and across it (1, 2): the normal part of C. */
  inline dealii::Tensor<2, 3>
  normal_stiffness(const TransverseConstants &c)
  {
    dealii::Tensor<2, 3> compliance;
    compliance[0][0] = 1 / c.axial_modulus;
    for (unsigned int i = 1; i < 3; ++i)
      {
        compliance[0][i] = compliance[i][0] = -c.axial_ratio / c.axial_modulus;
        compliance[i][i]                    = 1 / c.transverse_modulus;
      }
    compliance[1][2] = compliance[2][1] =
      -c.transverse_ratio / c.transverse_modulus;
    return dealii::invert(compliance);
  }



  /** Rows: the axis and two directions normal to it and to each other. */
  inline dealii::Tensor<2, 3>
  frame_of(const dealii::Tensor<1, 3> &axis)
  {
    dealii::Tensor<2, 3> frame;
    frame[0] = axis / axis.norm();
    dealii::Tensor<1, 3> other;
    const bool           is_x = std::abs(frame[0][0]) > 0.7;
    other[is_x ? 1 : 0]       = 1;
    frame[1]                  = dealii::cross_product_3d(frame[0], other);
    frame[1] /= frame[1].norm();
    frame[2] = dealii::cross_product_3d(frame[0], frame[1]);
    return frame;
  }



  /** @f$A_{iI} A_{jJ} A_{kK} A_{lL} C_{IJKL}@f$ */
  inline dealii::SymmetricTensor<4, 3>
  transform(const dealii::Tensor<2, 3>          &A,
            const dealii::SymmetricTensor<4, 3> &C)
  {
    // Of pairs of indices first, to have two sums instead of four.
    dealii::SymmetricTensor<4, 3> half, result;
    const auto                    pair =
      [&A](const auto &entry, const unsigned int i, const unsigned int j) {
        double sum = 0;
        for (unsigned int I = 0; I < 3; ++I)
          for (unsigned int J = 0; J < 3; ++J)
            sum += A[i][I] * A[j][J] * entry(I, J);
        return sum;
      };
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int l = k; l < 3; ++l)
            half[i][j][k][l] =
              pair([&](const unsigned int I,
                       const unsigned int J) { return C[I][J][k][l]; },
                   i,
                   j);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int l = k; l < 3; ++l)
            result[i][j][k][l] =
              pair([&](const unsigned int K,
                       const unsigned int L) { return half[i][j][K][L]; },
                   k,
                   l);
    return result;
  }

  /**
   * Transversely isotropic linear elasticity. With the axis as direction 1, the
   * strain is
   * @f[
   *   \varepsilon_{11} = \frac{\sigma_{11}}{E_a}
   *     - \frac{\nu_a}{E_a} (\sigma_{22} + \sigma_{33}), \quad
   *   \varepsilon_{22} = \frac{\sigma_{22} - \nu_t \sigma_{33}}{E_t}
   *     - \frac{\nu_a}{E_a} \sigma_{11}, \quad
   *   2\varepsilon_{12} = \frac{\sigma_{12}}{G_a}, \quad
   *   2\varepsilon_{23} = \frac{2 (1 + \nu_t)}{E_t} \sigma_{23}
   * @f]
   * and its inverse is @f$\sigma = C : \varepsilon@f$. At finite strain
   * Saint-Venant and Kirchhoff's law, whose axis turns with the material:
   * @f$\tau = F S F^T@f$, @f$S = C : \frac12 (F^T F - 1)@f$ (Holzapfel 2000,
   * ch. 6); for large rotations, not for large compression.
   */
  class TransverselyIsotropic : public Material
  {
  public:
    /**
     * @param constants with a positive definite stiffness
     * @param axis its direction at the start, of any length but 0
     * @param rho mass density
     */
    TransverselyIsotropic(const TransverseConstants  &constants,
                          const dealii::Tensor<1, 3> &axis,
                          const double                rho);

    using Material::respond;

    void
    respond(const StepTime                       &time,
            const StrainMeasure                   measure,
            const dealii::ArrayView<TensorState> &points) const override;

    bool
    is_isotropic() const override
    {
      return false;
    }

    LameConstants
    elastic_stiffness() const override
    {
      return bound;
    }

    double
    density() const override
    {
      return rho;
    }

    bool
    is_linear() const override
    {
      return false;
    }

    /** C */
    const dealii::SymmetricTensor<4, 3> &
    stiffness() const
    {
      return C;
    }

  private:
    const double                  rho;
    dealii::SymmetricTensor<4, 3> C;
    LameConstants                 bound;
  };

  inline TransverselyIsotropic::TransverselyIsotropic(
    const TransverseConstants  &constants,
    const dealii::Tensor<1, 3> &axis,
    const double                rho)
    : rho(rho)
  {
    const dealii::Tensor<2, 3> normal = normal_stiffness(constants);
    const double               G_a    = constants.axial_shear_modulus;
    const double               G_t =
      constants.transverse_modulus / (2 * (1 + constants.transverse_ratio));
    dealii::SymmetricTensor<4, 3> local;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        local[i][i][j][j] = normal[i][j];
    local[0][1][0][1] = local[0][2][0][2] = G_a;
    local[1][2][1][2]                     = G_t;
    C = transform(dealii::transpose(frame_of(axis)), local);

    bound.mu = std::max(G_a, G_t);
    bound.lambda =
      std::max(0., std::max(normal[0][0], normal[1][1]) - 2 * bound.mu);
  }



  inline void
  TransverselyIsotropic::respond(
    const StepTime &,
    const StrainMeasure                   measure,
    const dealii::ArrayView<TensorState> &points) const
  {
    for (TensorState &point : points)
      if (measure == StrainMeasure::small)
        {
          point.stress += C * point.strain_increment;
          point.tangent = C;
        }
      else
        {
          const dealii::Tensor<2, 3>         &F = point.F;
          const dealii::SymmetricTensor<2, 3> S =
            C * (0.5 * (dealii::symmetrize(dealii::transpose(F) * F) -
                        dealii::unit_symmetric_tensor<3>()));
          point.stress = dealii::symmetrize(
            F * static_cast<dealii::Tensor<2, 3>>(S) * dealii::transpose(F));
          point.tangent = transform(F, C);
        }
  }
} // namespace moraine

#endif
