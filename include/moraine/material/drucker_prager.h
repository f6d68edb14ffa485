// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_drucker_prager_h
#define moraine_material_drucker_prager_h

#include <moraine/material/soil_strength.h>

#include <memory>

namespace moraine
{
  /**
   * Drucker and Prager's plasticity, elastic as LinearElastic. With
   * @f$p = \frac13 \mathrm{tr}\,\sigma@f$, tension positive, and
   * @f$s = \mathrm{dev}\,\sigma@f$,
   * @f[
   *   f = \sqrt{J_2} + \eta p - k \le 0, \qquad J_2 = \tfrac12 s : s, \qquad
   *   \dot\varepsilon^p = \dot\gamma \left(\frac{s}{2\sqrt{J_2}} +
   *                       \frac{\bar\eta}{3} 1\right) .
   * @f]
   * With friction angle @f$\varphi@f$, dilation angle @f$\psi@f$ and cohesion
   * c it collapses in plane strain as Mohr and Coulomb's does if
   * @f[
   *   \bar\eta = \frac{3\sin\psi}{\sqrt{9+3\sin^2\psi}}, \quad
   *   d = \sqrt{1-\bar\eta^2/3}, \quad
   *   \eta = \frac{\sin\varphi}{d + \bar\eta \sin\varphi/3}, \quad
   *   k = \eta\, c \cot\varphi ,
   * @f]
   * and, as the outer cone, it has their strength in triaxial compression if
   * @f[
   *   \eta = \frac{6\sin\varphi}{\sqrt3\,(3-\sin\varphi)}, \quad
   *   \bar\eta = \frac{6\sin\psi}{\sqrt3\,(3-\sin\psi)}, \quad
   *   k = \eta\, c \cot\varphi .
   * @f]
   * The return is to the cone, exact for any step: with
   * @f$\Delta\gamma = f^{tr} / (G + K\eta\bar\eta)@f$ and @f$m =
   * s^{tr}/\sqrt{J_2^{tr}}@f$
   * @f[
   *   \sigma = \sigma^{tr} - \Delta\gamma\, (G m + K\bar\eta 1), \quad
   *   D = C - \frac{(G m + K\bar\eta 1) \otimes (G m + K\eta 1)}
   *                {G + K\eta\bar\eta}
   *       - \frac{2G^2\Delta\gamma}{\sqrt{J_2^{tr}}}
   *         \left(\mathbb{I}_{dev} - \tfrac12 m \otimes m\right) .
   * @f]
   * Where that is beyond the apex @f$p = k/\eta@f$, it is to the apex, for
   * @f$\psi = 0@f$ too. Strengths are functions of the accumulated plastic
   * strain as in MohrCoulomb.
   *
   * Sources: Drucker and Prager 1952; de Souza Neto, Peric and Owen 2008
   * (return to cone and apex). Ours is the match for @f$\psi \ne \varphi@f$.
   */
  class DruckerPrager : public SoilMaterial
  {
  public:
    /** Where cone and Mohr-Coulomb pyramid have the same strength. */
    enum class Match
    {
      plane_strain, ///< at collapse in plane strain
      outer_cone    ///< in triaxial compression
    };

    /** Tensile strength and largest dilation are ignored. */
    explicit DruckerPrager(const SoilParameters &parameters,
                           const Match           match = Match::plane_strain);

    using Material::respond;

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override;

    /** c and @f$\tan\varphi@f$ are divided; @f$\psi@f$ is at most the new
     * @f$\varphi@f$. */
    std::shared_ptr<const Material>
    with_strength_over(const double factor) const override;

    /** f, > 0 beyond yield. */
    double
    yield_function(const dealii::Tensor<1, 3> &stress,
                   const double               *internal) const;

  private:
    /** A cone, or its derivative by @f$\kappa@f$. */
    struct Cone
    {
      double eta, eta_bar, k;
    };

    /** A cone and its derivative. */
    struct ChangingCone
    {
      Cone value, slope;
    };

    /** The only place where strengths at a point are read, for @f$\kappa@f$ in
     * a segment of the tables. */
    ChangingCone
    cone_at(const double       kappa,
            const unsigned int segment,
            const double      *fields) const;

    SoilReturn
    return_to(const ChangingCone         &cone,
              const LameConstants        &C,
              const dealii::Tensor<1, 3> &trial_strain) const;

    const Match  match;
    ChangingCone constant; ///< the cone if strengths are constant
  };

  MaterialModel
  drucker_prager_model();
} // namespace moraine

#endif
