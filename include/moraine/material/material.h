// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_h
#define moraine_material_material_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/symmetric_tensor.h>

#include <string>

namespace moraine
{
  /**
   * The isotropic stiffness
   * @f$C = \lambda\, 1\otimes 1 + 2\mu\, \mathbb{I}@f$.
   */
  struct LameConstants
  {
    double lambda; ///< @f$\lambda = E\nu/((1+\nu)(1-2\nu))@f$ [stress]
    double mu;     ///< @f$\mu = E/(2(1+\nu))@f$ [stress]

    /** The stress increment @f$\Delta\sigma = C : \Delta\varepsilon@f$. */
    dealii::SymmetricTensor<2, 3>
    operator*(const dealii::SymmetricTensor<2, 3> &strain) const
    {
      return lambda * dealii::trace(strain) *
               dealii::unit_symmetric_tensor<3>() +
             2. * mu * strain;
    }

    /** The strain @f$C^{-1} : \sigma@f$. */
    dealii::SymmetricTensor<2, 3>
    strain_of(const dealii::SymmetricTensor<2, 3> &stress) const
    {
      return (stress - lambda / (3 * lambda + 2 * mu) * dealii::trace(stress) *
                         dealii::unit_symmetric_tensor<3>()) /
             (2. * mu);
    }
  };

  /** Of Young's modulus @p E [stress] and Poisson's ratio @p nu. */
  inline LameConstants
  lame_constants(const double E, const double nu)
  {
    return {E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))};
  }

  /**
   * What a material is asked at one point, and its answer, in the principal
   * directions of the trial elastic strain. All our materials are isotropic, so
   * stress, elastic strain and trial strain have these directions in common.
   *
   * The strain is the small strain or, at finite strain, the logarithmic one,
   * @f$\varepsilon^e = \frac12 \ln b^e@f$; the stress is then Kirchhoff's
   * @f$\tau@f$. The same return mapping serves both (Simo 1992).
   */
  struct PrincipalState
  {
    /** In: trial elastic strain; out: elastic strain. */
    dealii::Tensor<1, 3> strain;

    /** In and out: accumulated plastic strain of a plastic material. */
    double plastic_strain;

    /** Out: @f$\sigma_A@f$ or @f$\tau_A@f$. */
    dealii::Tensor<1, 3> stress;

    /** Out: @f$D_{AB} = \partial\tau_A/\partial\varepsilon^{tr}_B@f$. */
    dealii::Tensor<2, 3> tangent;
  };

  /**
   * An isotropic material: a pure function of the committed state of a point
   * and the strain of the step. It knows no mesh and no neighbours. Plane
   * strain is the 3D law with a plane strain increment, so that the
   * out-of-plane stress is kept.
   */
  class Material
  {
  public:
    virtual ~Material() = default;

    /**
     * Answer for a block of points. Where there is no answer (a return mapping
     * without a solution) the stress is not a number; why_no_stress() says what
     * that means.
     */
    virtual void
    respond(const dealii::ArrayView<PrincipalState> &points) const = 0;

    /** The elastic stiffness, by which boundaries scale their enforcement. */
    virtual LameConstants
    elastic_stiffness() const = 0;

    /** Mass per initial volume. */
    virtual double
    density() const = 0;

    /**
     * Whether the stress is linear in the (small or logarithmic) strain by
     * elastic_stiffness(), whatever happened before.
     */
    virtual bool
    is_linear() const = 0;

    /** Whether points carry an accumulated plastic strain. */
    virtual bool
    is_plastic() const
    {
      return false;
    }

    /** Whether it makes sense at small strain. */
    virtual bool
    has_small_strain_limit() const
    {
      return true;
    }

    /** For messages: why respond() can fail, as "it cannot return to ...". */
    virtual std::string
    why_no_stress() const
    {
      return "its material has no stress at this strain";
    }
  };
} // namespace moraine

#endif
