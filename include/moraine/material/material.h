// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_h
#define moraine_material_material_h

#include <moraine/core/step_time.h>
#include <moraine/material/parameter.h>

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

  /** A point of an isotropic material. */
  struct ElasticPoint
  {
    dealii::Tensor<1, 3> strain; ///< principal elastic strains
    const double        *internal;
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

    /** Their values before the first step at @p x. @throws InputError where
     * one is not allowed. */
    std::vector<double>
    internal_at(const dealii::Point<3> &x) const
    {
      std::vector<double> values;
      for (const InternalVariable &variable : internal_variables())
        values.push_back(variable.initial_at ? variable.initial_at(x) :
                                               variable.initial);
      return values;
    }

    /** Whether elements of degree 1 may lock: plastic flow keeps the volume or
     * ties it to the shear, or Poisson's ratio is above 0.4. */
    bool
    may_lock() const
    {
      const LameConstants C = elastic_stiffness();
      return dissipates() || C.lambda > (4 + 1e-9) * C.mu;
    }

    /** The elastic stiffness, of parameters that are fields with their nominal
     * values; if it is not isotropic, an isotropic one as stiff as its
     * stiffest. */
    virtual LameConstants
    elastic_stiffness() const = 0;

    /** The same at a point with these @p internal variables. */
    virtual LameConstants
    elastic_stiffness_at(const double * /*internal*/) const
    {
      return elastic_stiffness();
    }

    /** Whether it is the same at all points. */
    virtual bool
    has_uniform_stiffness() const
    {
      return true;
    }

    /** Whether elastic stress is linear in the elastic strain by
     * elastic_stiffness_at(). */
    virtual bool
    has_linear_elasticity() const
    {
      return true;
    }

    /** The elastic strain that has the @p stress, at finite strain the
     * logarithmic one of Kirchhoff's, if it is isotropic. */
    virtual dealii::SymmetricTensor<2, 3>
    elastic_strain_of(const dealii::SymmetricTensor<2, 3> &stress,
                      const double                        *internal) const
    {
      return elastic_stiffness_at(internal).strain_of(stress);
    }

    /** Set what of the @p internal variables follows from the @p stress before
     * the first step; @p vertical is the direction of gravity. */
    virtual void
    initialise(const dealii::SymmetricTensor<2, 3> & /*stress*/,
               const unsigned int /*vertical*/,
               double * /*internal*/) const
    {}

    /** Horizontal over vertical stress of level ground at the start, under the
     * vertical @p pressure: of elastic ground @f$\nu/(1-\nu)@f$. */
    virtual double
    K0(const double /*pressure*/, const double *internal) const
    {
      const LameConstants C = elastic_stiffness_at(internal);
      return C.lambda / (C.lambda + 2 * C.mu);
    }

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

    /** Whether shear strength grows with pressure, so that plastic flow ties
     * the volume to the shear. */
    virtual bool
    has_friction() const
    {
      return false;
    }

    /** The part of the elastic stiffness that Newton's matrix has in addition
     * to the tangent, which may vanish: at an apex, in tension. */
    virtual double
    least_stiffness() const
    {
      return 0;
    }

    /** Whether it makes sense at small strain. */
    virtual bool
    has_small_strain_limit() const
    {
      return true;
    }

    /**
     * The energies per initial volume that elastic strains store, if it is
     * isotropic: @f$\psi = \frac12\, \varepsilon^e : C : \varepsilon^e@f$
     * with elastic_stiffness() unless said otherwise.
     */
    virtual void
    stored_energies(const dealii::ArrayView<const ElasticPoint> &points,
                    const dealii::ArrayView<double>             &energies) const
    {
      for (unsigned int i = 0; i < energies.size(); ++i)
        {
          const LameConstants C = elastic_stiffness_at(points[i].internal);
          const dealii::Tensor<1, 3> &e          = points[i].strain;
          const double                volumetric = e[0] + e[1] + e[2];
          energies[i] =
            0.5 * C.lambda * volumetric * volumetric + C.mu * (e * e);
        }
    }

    /** Whether elastic strains at the end of a step can be others than the
     * trial ones. */
    virtual bool
    dissipates() const
    {
      return false;
    }

    /**
     * The dissipation by pore water in a step, per initial volume. The elastic
     * strains alone do not contain it. Arguments: the trace of the trial
     * elastic strain, elastic strains and internal variables after the step,
     * internal variables before it.
     */
    virtual double
    dissipated_by_water(const double /*trial_volume*/,
                        const ElasticPoint & /*at_end*/,
                        const double * /*at_start*/) const
    {
      return 0;
    }

    /** The same material, the excess pressure of whose water stays as it is
     * from a time on. nullptr if it has none. */
    virtual std::shared_ptr<const Material>
    with_frozen_water(const double /*from*/) const
    {
      return nullptr;
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

    /** The factor on the size of a step that points without a stress ask for;
     * 1 if they ask for none. */
    virtual double
    wanted_cut(const StepTime &) const
    {
      return 1;
    }

    /** For the log: how a law of the user's was compiled, if it was. */
    virtual std::string
    how_made() const
    {
      return "";
    }
  };

  /** Isotropic elasticity, and the density, as a scene gives them. */
  struct IsotropicElasticity
  {
    Parameter young_modulus; ///< E > 0 [stress]
    Parameter poisson_ratio; ///< @f$\nu \in (-1, 0.5)@f$
    double    density = 0;
    /** Parameters with a value at each point. */
    std::vector<InternalVariable> fields = {};
  };

  /** A material with an isotropic elastic stiffness. */
  class IsotropicMaterial : public Material
  {
  public:
    /**
     * @param elasticity elastic constants, density, fields
     * @param history the internal variables that change in time
     */
    IsotropicMaterial(const IsotropicElasticity    &elasticity,
                      std::vector<InternalVariable> history = {})
      : elasticity(elasticity)
      , stiffness(lame_constants(elasticity.young_modulus.nominal(),
                                 elasticity.poisson_ratio.nominal()))
      , variables(std::move(history))
      , n_history(variables.size())
    {
      variables.insert(variables.end(),
                       elasticity.fields.begin(),
                       elasticity.fields.end());
    }

    /** @param E > 0 [stress], @param nu in (-1, 0.5), @param rho mass density
     */
    IsotropicMaterial(const double E, const double nu, const double rho)
      : IsotropicMaterial(IsotropicElasticity{E, nu, rho})
    {}

    LameConstants
    elastic_stiffness() const override
    {
      return stiffness;
    }

    LameConstants
    elastic_stiffness_at(const double *internal) const override
    {
      return stiffness_at(internal);
    }

    bool
    has_uniform_stiffness() const override
    {
      return !elasticity.young_modulus.is_field() &&
             !elasticity.poisson_ratio.is_field();
    }

    /** The history, then the fields. */
    std::vector<InternalVariable>
    internal_variables() const override
    {
      return variables;
    }

    double
    density() const override
    {
      return elasticity.density;
    }

    bool
    is_linear() const override
    {
      return false;
    }

  protected:
    /** elastic_stiffness() at a point. */
    LameConstants
    stiffness_at(const double *internal) const
    {
      if (!elasticity.young_modulus.is_field() &&
          !elasticity.poisson_ratio.is_field())
        return stiffness;
      const double *fields = internal + n_history;
      return lame_constants(elasticity.young_modulus.at(fields),
                            elasticity.poisson_ratio.at(fields));
    }

    const IsotropicElasticity elasticity;
    const LameConstants       stiffness; ///< nominal

  private:
    std::vector<InternalVariable> variables;

  protected:
    const unsigned int n_history; ///< internal variables that are no fields
  };
} // namespace moraine

#endif
