// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_cam_clay_h
#define moraine_material_cam_clay_h

#include <moraine/material/material_input.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /** Parameters of CamClay. */
  struct CamClayParameters
  {
    /** The critical state ratio between triaxial compression and extension. */
    enum class CriticalState
    {
      lode_angle,             ///< @f$M(\theta)@f$, Sheng et al. (2000)
      circle_in_compression,  ///< M of triaxial compression everywhere
      circle_in_plane_strain, ///< @f$M = \sqrt 3 \sin\varphi@f$ everywhere
    };

    double        friction_angle; ///< @f$\varphi_{cs}@f$ [radian]
    double        compression;    ///< @f$\hat\lambda@f$, of ln v over ln p
    double        swelling;       ///< @f$\hat\kappa < \hat\lambda@f$
    double        least_pressure; ///< @f$p_{min}@f$ [stress]
    double        normal_K0;      ///< of soil that was never unloaded
    double        density        = 0;
    CriticalState critical_state = CriticalState::lode_angle;
    Parameter     shear_modulus; ///< @f$\mu@f$ [stress]
    Parameter     OCR = 1.;      ///< @f$\ge 1@f$
    Parameter     POP = 0.;      ///< [stress]
    /** Parameters with a value at each point. */
    std::vector<InternalVariable> fields = {};
  };

  /**
   * Modified Cam-clay at small and finite strain (Roscoe and Burland 1968;
   * Borja and Tamagnini 1998) with an elastic energy, so that elastic cycles
   * dissipate nothing. Compression positive, e the deviatoric elastic strain:
   *
   * @f{gather*}{
   *   \psi = \Psi(\varepsilon_v) + \mu\,e:e,
   *   \qquad P = \Psi' = \begin{cases}
   *     p_{min}\,\varepsilon_v/\hat\kappa & \varepsilon_v \le \hat\kappa \\
   *     p_{min}\exp(\varepsilon_v/\hat\kappa - 1) & \text{else,}\end{cases} \\
   *   f = \frac{q^2}{M^2} + p(p - p_c) \le 0, \qquad
   *   p_c = p_{c,n}\exp\frac{\Delta\varepsilon^p_v}{\hat\lambda-\hat\kappa} .
   * @f}
   *
   * After Houlsby (1985), without the part of his shear modulus that grows with
   * pressure: it has no stress beyond @f$q/p = \sqrt{1.5\alpha\hat\kappa}@f$,
   * which is below M for usual clay. P is linear below @f$p_{min}@f$, where
   * there would be no stiffness; zero stress is at zero strain. Flow is
   * associated.
   * @f$M(\theta)@f$ is that of Sheng, Sloan and Yu (2000), with the friction
   * angle @f$\varphi_{cs}@f$ in triaxial compression and extension. All
   * stresses are @f$\tau = J\sigma@f$ at finite strain.
   *
   * The tangent is not symmetric, as the hardening depends on the volume.
   * Internal variables: @f$p_c@f$, the accumulated deviatoric plastic strain,
   * and p.
   */
  class CamClay : public Material
  {
  public:
    /** The @p reduction divides @f$\tan\varphi_{cs}@f$, but not in the start:
     * the soil was loaded with all its strength. */
    explicit CamClay(const CamClayParameters &parameters,
                     const double             reduction = 1);

    using Material::respond;

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override;

    std::vector<InternalVariable>
    internal_variables() const override;

    /** At @f$p_{min}@f$. */
    LameConstants
    elastic_stiffness() const override
    {
      return stiffness_at_pressure(0, parameters.shear_modulus.nominal());
    }

    /** At the pressure of the point. */
    LameConstants
    elastic_stiffness_at(const double *internal) const override
    {
      return stiffness_at_pressure(internal[2], shear_modulus(internal));
    }

    bool
    has_uniform_stiffness() const override
    {
      return false;
    }

    bool
    has_linear_elasticity() const override
    {
      return false;
    }

    dealii::SymmetricTensor<2, 3>
    elastic_strain_of(const dealii::SymmetricTensor<2, 3> &stress,
                      const double *internal) const override;

    void
    stored_energies(const dealii::ArrayView<const ElasticPoint> &points,
                    const dealii::ArrayView<double> &energies) const override;

    /** The yield surface goes through @f$\sigma'_p = OCR\,\sigma'_v + POP@f$
     * and @f$K_0^{nc}\sigma'_p@f$ across it. */
    void
    initialise(const dealii::SymmetricTensor<2, 3> &stress,
               const unsigned int                   vertical,
               double                              *internal) const override;

    /** @f$K_0^{nc} OCR^{\sin\varphi}@f$ (Mayne and Kulhawy 1982), with
     * @f$OCR = \sigma'_p/\sigma'_v@f$. */
    double
    K0(const double pressure, const double *internal) const override;

    double
    density() const override
    {
      return parameters.density;
    }

    bool
    is_linear() const override
    {
      return false;
    }

    bool
    has_symmetric_tangent() const override
    {
      return false;
    }

    bool
    has_friction() const override
    {
      return true;
    }

    bool
    dissipates() const override
    {
      return true;
    }

    double
    least_stiffness() const override
    {
      return 1e-8;
    }

    std::shared_ptr<const Material>
    with_strength_over(const double factor) const override;

    std::string
    why_no_stress() const override
    {
      return "it cannot return to its yield surface";
    }

    /** f of principal stresses, tension positive [stress^2]. */
    double
    yield_function(const dealii::Tensor<1, 3> &stress,
                   const double               *internal) const;

  private:
    static constexpr unsigned int n_history = 3;

    /** Principal stresses of principal elastic strains, and the derivative. */
    struct Elastic
    {
      dealii::Tensor<1, 3> stress;
      dealii::Tensor<2, 3> tangent;
    };

    /** f and its derivatives by the stresses. */
    struct Yield
    {
      double               value, p;
      dealii::Tensor<1, 3> normal;
      dealii::Tensor<2, 3> hessian;
    };

    /** Data of a point at the start of a step. */
    struct Start
    {
      double p_c, mu;
    };

    /** A return: elastic strains, multiplier times the first p_c, p_c. */
    struct Return
    {
      dealii::Tensor<1, 3> elastic;
      double               multiplier = 0;
      double               p_c        = 0;
    };

    /** The equations of a return and their derivatives by its unknowns. */
    struct Equations
    {
      Elastic              at;
      Yield                yield;
      dealii::Tensor<1, 3> flow_error;
      dealii::Tensor<2, 3> flow_matrix; ///< of flow_error by elastic strains
      dealii::Tensor<1, 3> normal;      ///< of flow_error by the multiplier
      dealii::Tensor<1, 3> yield_row;   ///< of f by elastic strains
      double               p_c = 0, yield_error = 0;

      double
      norm() const;
    };

    /** @f$\varepsilon_v@f$ with @f$P = p@f$. */
    double
    volume_at(const double p) const
    {
      const double ratio = p / parameters.least_pressure;
      return parameters.swelling * (ratio <= 1 ? ratio : 1 + std::log(ratio));
    }

    LameConstants
    stiffness_at_pressure(const double p, const double mu) const;

    double
    shear_modulus(const double *internal) const
    {
      return parameters.shear_modulus.at(internal + n_history);
    }

    Elastic
    elastic(const dealii::Tensor<1, 3> &strain, const double mu) const;

    Yield
    yield(const dealii::Tensor<1, 3> &stress, const double p_c) const;

    Equations
    equations(const dealii::Tensor<1, 3> &trial,
              const Start                &start,
              const Return               &at) const;

    /** Newton's method from @p at. @return whether it got there. */
    bool
    iterate(const dealii::Tensor<1, 3> &trial,
            const Start                &start,
            Return                     &at) const;

    /** By trial strains that grow from the middle of the yield surface. */
    bool
    approach(const dealii::Tensor<1, 3> &trial,
             const Start                &start,
             Return                     &at) const;

    dealii::Tensor<2, 3>
    consistent_tangent(const dealii::Tensor<1, 3> &trial,
                       const Start                &start,
                       const Return               &at) const;

    /** @f$\sigma'_p@f$ of a vertical pressure. */
    double
    preconsolidation(const double pressure, const double *internal) const;

    CamClayParameters parameters;
    double            reduction;
    double            M_at_start; ///< @f$M_c@f$ without reduction
    double M_compression;         ///< M in triaxial compression, or everywhere
    double mean, swing;           ///< @f$M_c^2/M^2 = \sqrt{mean - swing\,C}@f$
  };

  MaterialModel
  cam_clay_model();
} // namespace moraine

#endif
