// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_mohr_coulomb_h
#define moraine_material_mohr_coulomb_h

#include <moraine/material/mohr_coulomb_return.h>
#include <moraine/material/soil_strength.h>

#include <memory>
#include <vector>

namespace moraine
{
  /**
   * Mohr and Coulomb's plasticity with a limit of tension, elastic as
   * LinearElastic. With principal stresses @f$\sigma_1 \ge \sigma_2 \ge
   * \sigma_3@f$, tension positive,
   * @f[
   *   f = (1+\sin\varphi)\,\sigma_1 - (1-\sin\varphi)\,\sigma_3
   *       - 2c\cos\varphi \le 0, \qquad \sigma_1 \le \sigma_t,
   * @f]
   * with flow along @f$\partial g/\partial\sigma@f$, where g is f with the
   * dilation angle @f$\psi@f$ instead of @f$\varphi@f$, and with associated
   * flow in tension. @f$\varphi = \psi = 0@f$ without a limit of tension is
   * Tresca's plasticity with the shear strength c. Where @f$\psi = 0@f$ and
   * there is no limit of tension, stresses beyond the apex return to it.
   *
   * Strengths are functions of the accumulated plastic strain,
   * @f$\dot\kappa = \sqrt{2/3\; \dot\varepsilon^p : \dot\varepsilon^p}@f$. The
   * return to given strengths is exact (MohrCoulombReturn); close_return()
   * finds @f$\kappa@f$ and the tangent. Where strengths fall too steeply for
   * that, there is no stress.
   *
   * With a largest dilation @f$v_{max}@f$, the flow has @f$\psi@f$ while the
   * accumulated volumetric plastic strain v is below, and no dilation angle
   * from there on. A step across has the angle in between with which it ends at
   * @f$v = v_{max}@f$; on a plane that is the flow along both, one after the
   * other. Tension opens beyond @f$v_{max}@f$.
   *
   * Sources: Clausen, Damkilde and Andersen 2006 (returns to planes); de Souza
   * Neto, Peric and Owen 2008 (principal values). Ours are the corners of the
   * limit of tension and the implicit strengths.
   */
  class MohrCoulomb : public SoilMaterial
  {
  public:
    explicit MohrCoulomb(const SoilParameters &parameters);

    using Material::respond;

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override;

    bool
    has_symmetric_tangent() const override
    {
      return SoilMaterial::has_symmetric_tangent() && !dilation_ends();
    }

    /** c, @f$\tan\varphi@f$ and @f$\sigma_t@f$ are divided; @f$\psi@f$ is at
     * most the new @f$\varphi@f$. */
    std::shared_ptr<const Material>
    with_strength_over(const double factor) const override;

    /** The larger of f and @f$\sigma_1 - \sigma_t@f$, > 0 beyond yield. */
    double
    yield_function(const dealii::Tensor<1, 3> &stress,
                   const double               *internal) const;

  private:
    /** The only place where strengths at a point are read, for @f$\kappa@f$ in
     * a segment of the tables. */
    SoilStrengthTables::Row
    strength_at(const double *internal, const unsigned int segment) const
    {
      return strengths.at(internal[0], segment, internal + n_history);
    }

    bool
    dilation_ends() const
    {
      return std::isfinite(largest_dilation);
    }

    /** Answer where strengths are constant and dilation does not end. */
    void
    respond_constant(PrincipalState &point) const;

    /** Return to @p strength, which changes as said, for sorted strains. */
    SoilReturn
    return_to(const SoilStrengthTables::Row &strength,
              const LameConstants           &C,
              const dealii::Tensor<1, 3>    &trial_strain) const;

    /** The same with the end of dilation. */
    SoilReturn
    return_with_dilation(SoilStrengthTables::Row     strength,
                         const LameConstants        &C,
                         const dealii::Tensor<1, 3> &trial_strain,
                         const double                dilation) const;

    /** Answer for sorted strains where strengths are not constant or dilation
     * ends. */
    SoilReturn
    respond_sorted(const dealii::Tensor<1, 3> &trial_strain,
                   double                     *internal) const;

    const double      largest_dilation;
    MohrCoulombReturn constant; ///< the return if strengths are constant
  };

  MaterialModel
  mohr_coulomb_model();

  MaterialModel
  tresca_model();
} // namespace moraine

#endif
