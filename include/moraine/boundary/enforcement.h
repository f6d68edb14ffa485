// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_enforcement_h
#define moraine_boundary_enforcement_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * The family of ways to enforce @f$M u = M g@f$ on a surface that cuts cells.
   * With outward normal n, @f$Q = n \cdot C \cdot n@f$ and the flux
   * @f$f(u) = M\,(C : \mathrm{sym}(W \nabla u))\, n@f$,
   * @f$W = w_c M + w_f (1 - M)@f$, the surface adds to the left-hand side
   *
   * @f[ -\int \eta \cdot f(u) - s \int f(\eta) \cdot (u - g)
   *     + c_3 \int \eta \cdot M Q M (u - g) - \int \eta \cdot t . @f]
   *
   * | enforcement          | w_c | w_f | s  | c_3     | multiplier |
   * |----------------------|-----|-----|----|---------|------------|
   * | weighted             | 1/2 | 1   | 1  | 4/(3 δ) | no         |
   * | augmented Lagrangian | 0   | 0   | 0  | 4/(3 δ) | yes        |
   * | symmetric Nitsche    | 1   | 1   | 1  | max     | per step   |
   * | skew Nitsche         | 1   | 1   | -1 | γ/h     | per step   |
   * | incomplete Nitsche   | 1   | 1   | 0  | γ/h     | per step   |
   * | penalty              | 0   | 0   | 0  | β/h     | no         |
   *
   * max is the larger one of γ/h and 4/d, d the depth of the material behind
   * the surface in a cell. In dynamics, and of the symmetric form at finite
   * strain, d is in the place of h. Where cells have one change of volume Q has
   * no @f$\lambda@f$; the symmetric form holds the mean of u - g along the
   * normal in a cell instead (mean_factor).
   *
   * The first row is the closed form of the Dirichlet-weighted basis
   * (Cortis et al. 2017, eqs. 13-28) for a band δ thin against the cell h:
   * integrals of d', d d' and d'^2 across the band. t is the multiplier the
   * surface carries from the last step or pass; in the second row it takes the
   * place of the flux. Without one (no) the equations of a step know nothing of
   * the last one, and t is the traction at the start of a step alone.
   *
   * Where c_3 is a large number, bilinear functions that vanish at several
   * places of a line through a cell have no gradient left: cells lock. So these
   * rows hold the mean over the piece @f$\Gamma_c@f$ of the surface in a cell,
   * of M u as of M g, by a traction that is constant on it: functions are
   * replaced by @f$\bar N_a = |\Gamma_c|^{-1} \int_{\Gamma_c} N_a@f$. Cortis et
   * al. hold every place. See holds_means().
   */
  struct Enforcement
  {
    /** What of the piece of the surface in a cell is held. */
    enum class Held
    {
      automatic, ///< see holds_means()
      mean,
      places ///< those of Gauss, as many as integrate functions exactly
    };

    /**
     * Means by default, but not with Nitsche's method and cells of degree 2,
     * which do not lock, nor of a roller on a curve in dynamics by forces of a
     * step alone (@p in_motion): places lose less of what slides along it. With
     * forces of the start of a step, as in generalised-alpha, what multipliers
     * of places do to each other lasts, and feeds vibrations as normals turn.
     */
    bool
    holds_means(const unsigned int degree,
                const bool         curved_roller,
                const bool         in_motion) const;

    /** Whether a flux holds, with the multiplier of a step. */
    bool
    is_nitsche() const
    {
      return carries_multiplier && !augments;
    }

    /** Whether the stress of the trial state is part of the traction. */
    bool
    has_flux() const
    {
      return w_constrained != 0 || w_free != 0;
    }

    /** The spring that holds slopes. It has the shear modulus alone: with
     * lambda, material that keeps its volume would be held at every place. @p
     * share of the spring acts. */
    Enforcement
    of_slopes(const double share) const
    {
      Enforcement result      = *this;
      result.stiffness_factor = share * slope_factor;
      result.lambda_share     = 0;
      return result;
    }

    double      w_constrained;      ///< @f$w_c@f$
    double      w_free;             ///< @f$w_f@f$
    double      adjoint_sign;       ///< @f$s@f$
    double      stiffness_factor;   ///< @f$c_3 h@f$
    bool        carries_multiplier; ///< between steps
    bool        augments;         ///< within a step, until the constraint holds
    std::string name;             ///< as scenes call it
    double      lambda_share = 1; ///< how much of @f$\lambda@f$ is in Q
    /** By @f$\lambda@f$ times this the mean of what is missed along the normal
     * on the piece of the surface in a cell is held [1/length]. */
    double mean_factor = 0;
    /** The shear modulus times this, over h, holds how displacements vary along
     * a piece that is held by its mean, where points move through cells
     * (BoundarySlope): @f$\gamma@f$. */
    double slope_factor = 0;
    Held   held         = Held::automatic;
  };

  /**
   * The keys that choose an Enforcement. At finite strain prefer "augmented
   * Lagrangian" with a band of 0.01, as scenes do: it has no flux, which would
   * be elastic.
   */
  struct EnforcementParameters
  {
    std::string enforcement    = "skew Nitsche";
    double      band_width     = 1e-6;
    double      nitsche_factor = 10;
    double      penalty_factor = 1e6;
    std::string held_in_a_cell = "auto";

    void
    add_parameters(dealii::ParameterHandler &prm);

    Enforcement
    enforcement_of() const;
  };
} // namespace moraine

#endif
