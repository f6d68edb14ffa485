// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_von_mises_h
#define moraine_material_von_mises_h

#include <moraine/material/material_input.h>

#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * Von Mises plasticity: elastic as LinearElastic, with associated flow and a
   * yield radius that is a piecewise linear function of the accumulated plastic
   * strain,
   * @f[
   *   \|s\| \le R(\kappa), \qquad s = \mathrm{dev}\, \tau, \qquad
   *   \dot\varepsilon^p = \dot\gamma \frac{s}{\|s\|}, \qquad
   *   \dot\kappa = \sqrt{\tfrac23}\, \dot\gamma .
   * @f]
   * The radius is @f$R = \|s\| = \sqrt{2 J_2} = \sqrt{2/3}\,\sigma_y =
   * \sqrt{2}\, k@f$, with the yield stress @f$\sigma_y@f$ in uniaxial tension
   * and k in shear; @f$\kappa@f$ is the plastic strain in uniaxial tension.
   *
   * Radial return, exact for any step: the one equation
   * @f$\|s^{tr}\| - \sqrt6 G\, \Delta\kappa = R(\kappa_n + \Delta\kappa)@f$ is
   * solved segment by segment. With @f$n = s/\|s\|@f$, @f$\theta = R /
   * \|s^{tr}\|@f$ and @f$H = \sqrt{3/2}\, R'@f$, the slope of
   * @f$\sigma_y(\kappa)@f$, the tangent is
   * @f[
   *   D = K\, 1 \otimes 1 + 2G \theta (\mathbb{I}_{dev} - n \otimes n)
   *       + 2G \frac{H}{3G + H}\, n \otimes n .
   * @f]
   * Where the return ends at a kink of R, H is the slope that follows.
   *
   * Sources: Wilkins 1964 (radial return); Simo and Taylor 1985 (tangent); Simo
   * 1992 (logarithmic strain). Ours allows for softening: where it is as steep
   * as @f$H \le -3G@f$ and the return gets there, there is no stress.
   */
  class VonMises : public IsotropicMaterial
  {
  public:
    /**
     * @param E > 0 [stress], @param nu in (-1, 0.5), @param rho mass density
     * @param yield_radius pairs of @f$\kappa@f$ and R > 0 [stress]; the first
     * @f$\kappa@f$ is 0, and they increase. Linear in between, constant after
     * the last.
     */
    VonMises(const double                                  E,
             const double                                  nu,
             const double                                  rho,
             const std::vector<std::pair<double, double>> &yield_radius);

    /**
     * @param elasticity elastic constants, density, fields
     * @param yield_radius as above
     * @param scale multiplies the yield radius
     */
    VonMises(const IsotropicElasticity                    &elasticity,
             const std::vector<std::pair<double, double>> &yield_radius,
             const Parameter                              &scale = 1);

    using Material::respond;

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override;

    bool
    dissipates() const override
    {
      return true;
    }

    /** The yield radius is divided at every plastic strain. */
    std::shared_ptr<const Material>
    with_strength_over(const double factor) const override;

    std::string
    why_no_stress() const override
    {
      return "it cannot return to its yield surface: the yield stress falls "
             "too steeply with plastic strain";
    }

    /** The yield radius @f$R(\kappa)@f$ [stress], over its scale. */
    double
    yield_radius(const double kappa) const
    {
      const Segment &segment = *segment_at(kappa);
      return segment.radius + segment.slope * (kappa - segment.kappa);
    }

  private:
    /** From kappa to that of the next segment; the last has no end. */
    struct Segment
    {
      double kappa;
      double radius; ///< at the start
      double slope;  ///< @f$R'(\kappa)@f$
    };

    /** The segment that @p kappa >= 0 lies in; at a kink, the later one. */
    std::vector<Segment>::const_iterator
    segment_at(const double kappa) const;

    /**
     * Find the segment in which a return ends.
     *
     * @param trial_radius @f$\|s^{tr}\|@f$ over the scale of the radius
     * @param G shear modulus over that scale
     * @param kappa in: at the start of the step, out: at its end; nan if there
     * is no return
     */
    std::vector<Segment>::const_iterator
    find_return(const double trial_radius, const double G, double &kappa) const;

    std::vector<Segment> segments;
    Parameter            scale;
  };

  MaterialModel
  von_mises_model();
} // namespace moraine

#endif
