// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_h
#define moraine_material_material_h

#include <moraine/core/step_time.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/exceptions.h>
#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /** The isotropic stiffness @f$C = \lambda\, 1\otimes 1 + 2\mu\,
   * \mathbb{I}@f$. */
  struct LameConstants
  {
    double lambda; ///< @f$\lambda = E\nu/((1+\nu)(1-2\nu))@f$ [stress]
    double mu;     ///< @f$\mu = E/(2(1+\nu))@f$ [stress]

    /** The stress increment @f$\Delta\sigma = C : \Delta\varepsilon@f$. */
    dealii::SymmetricTensor<2, 3>
    operator*(const dealii::SymmetricTensor<2, 3> &strain) const
    {
      dealii::SymmetricTensor<2, 3> stress     = 2. * mu * strain;
      const double                  volumetric = lambda * dealii::trace(strain);
      for (unsigned int i = 0; i < 3; ++i)
        stress[i][i] += volumetric;
      return stress;
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

  /** What a strain is. */
  enum class StrainMeasure
  {
    /** @f$\varepsilon = \mathrm{sym}\,\nabla u@f$ */
    small,
    /** @f$\varepsilon = \frac12 \ln b@f$, @f$b = F F^T@f$ */
    finite
  };

  /** A number that a material keeps at each point from step to step. It becomes
   * a field of the points and an array of the output with this name. */
  struct InternalVariable
  {
    std::string name;
    std::string unit;
    double      initial = 0; ///< before the first step
  };

  /**
   * What an isotropic material is asked at one point, and its answer, in the
   * principal directions of the trial elastic strain, which stress and elastic
   * strain have in common with it.
   *
   * The strain is the small strain or, at finite strain, the logarithmic one,
   * @f$\varepsilon^e = \frac12 \ln b^e@f$; the stress is then Kirchhoff's
   * @f$\tau@f$. The same return mapping serves both (Simo 1992).
   */
  struct PrincipalState
  {
    /** In: trial elastic strain; out: elastic strain. */
    dealii::Tensor<1, 3> strain;

    /** In: internal variables at @f$t_n@f$, out: at @f$t_{n+1}@f$, in the order
     * of Material::internal_variables(). */
    double *internal;

    /** Out: @f$\sigma_A@f$ or @f$\tau_A@f$. */
    dealii::Tensor<1, 3> stress;

    /** Out: @f$D_{AB} = \partial\tau_A/\partial\varepsilon^{tr}_B@f$. */
    dealii::Tensor<2, 3> tangent;
  };

  /** Input and output of an anisotropic material at one point. */
  struct TensorState
  {
    /** In, at small strain: @f$\Delta\varepsilon@f$. */
    dealii::SymmetricTensor<2, 3> strain_increment;

    /** In, at finite strain: @f$F_n@f$ and @f$F_{n+1}@f$. */
    dealii::Tensor<2, 3> F_n, F;

    /** As in PrincipalState. */
    double *internal;

    /** In: Cauchy's @f$\sigma_n@f$. Out: @f$\sigma_{n+1}@f$ or, at finite
     * strain, Kirchhoff's @f$\tau_{n+1}@f$. */
    dealii::SymmetricTensor<2, 3> stress;

    /** Out: @f$\partial\sigma/\partial\Delta\varepsilon@f$; at finite strain
     * the spatial tangent c, @f$L_v\tau = c : d@f$. */
    dealii::SymmetricTensor<4, 3> tangent;
  };

  /**
   * A material: a pure function of the committed state of a point, the strain
   * of the step and its time. It knows no mesh and no neighbours. Plane strain
   * is the 3D law with a plane strain increment, so that the out-of-plane
   * stress is kept. An isotropic one answers in principal values, any other in
   * tensors.
   */
  class Material
  {
  public:
    virtual ~Material() = default;

    /** Whether it answers in principal values. */
    virtual bool
    is_isotropic() const
    {
      return true;
    }

    /**
     * Answer for a block of points, if it is isotropic. Where there is no
     * answer (a return mapping without a solution) the stress is not a number;
     * why_no_stress() says what that means.
     */
    virtual void
    respond(const StepTime &, const dealii::ArrayView<PrincipalState> &) const
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    /** The same, if it is not isotropic. */
    virtual void
    respond(const StepTime &,
            const StrainMeasure,
            const dealii::ArrayView<TensorState> &) const
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    /** What points of this material carry beside stress and strain. */
    virtual std::vector<InternalVariable>
    internal_variables() const
    {
      return {};
    }

    /** The elastic stiffness, by which boundaries scale their enforcement; if
     * it is not isotropic, an isotropic one as stiff as its stiffest. */
    virtual LameConstants
    elastic_stiffness() const = 0;

    /** Mass per initial volume. */
    virtual double
    density() const = 0;

    /** Whether the stress is linear in the (small or logarithmic) strain by
     * elastic_stiffness(), whatever happened before. */
    virtual bool
    is_linear() const = 0;

    /** Whether the tangents that it answers with are symmetric, in any state:
     * @f$D_{AB} = D_{BA}@f$, @f$c_{ijkl} = c_{klij}@f$. */
    virtual bool
    has_symmetric_tangent() const
    {
      return true;
    }

    /** Whether it makes sense at small strain. */
    virtual bool
    has_small_strain_limit() const
    {
      return true;
    }

    /**
     * The energies per initial volume that elastic strains, given by their
     * principal values, store, if it is isotropic: @f$\psi =
     * \frac12\, \varepsilon^e : C : \varepsilon^e@f$ with
     * elastic_stiffness() unless said otherwise.
     */
    virtual void
    stored_energies(
      const dealii::ArrayView<const dealii::Tensor<1, 3>> &strains,
      const dealii::ArrayView<double>                     &energies) const
    {
      const LameConstants C = elastic_stiffness();
      for (unsigned int i = 0; i < energies.size(); ++i)
        {
          const dealii::Tensor<1, 3> &e          = strains[i];
          const double                volumetric = e[0] + e[1] + e[2];
          energies[i] =
            0.5 * C.lambda * volumetric * volumetric + C.mu * (e * e);
        }
    }

    /** Whether elastic strains at the end of a step can be others than the
     * trial ones. Stress is then linear in them by elastic_stiffness(). */
    virtual bool
    dissipates() const
    {
      return false;
    }

    /**
     * The same material with its shear strength divided by @p factor > 0: what
     * strength reduction does to it, as c / F and tan(phi) / F of a soil.
     * nullptr if it has no strength.
     */
    virtual std::shared_ptr<const Material>
    with_strength_over(const double /*factor*/) const
    {
      return nullptr;
    }

    /** For messages: why respond() can fail, as "it cannot return to ...". */
    virtual std::string
    why_no_stress() const
    {
      return "its material has no stress at this strain";
    }
  };

  /** A material with an isotropic elastic stiffness. */
  class IsotropicMaterial : public Material
  {
  public:
    /** @param E > 0 [stress], @param nu in (-1, 0.5), @param rho mass density
     */
    IsotropicMaterial(const double E, const double nu, const double rho)
      : stiffness(lame_constants(E, nu))
      , rho(rho)
    {}

    LameConstants
    elastic_stiffness() const override
    {
      return stiffness;
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

  protected:
    const LameConstants stiffness;

  private:
    const double rho;
  };
} // namespace moraine

#endif
