// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_contact_law_h
#define moraine_boundary_contact_law_h

#include <deal.II/base/tensor.h>

namespace moraine
{
  /** Whether a rim is apart from a surface, sticks to it or slides on it. */
  enum class ContactStatus : unsigned int
  {
    open,
    stick,
    slip
  };

  /** The traction on the body for a trial traction. */
  template <int dim>
  struct ContactResponse
  {
    dealii::Tensor<1, dim> traction;
    /** @f$DP = \partial\tau/\partial\tau^{tr}@f$, unsymmetric in slip. */
    dealii::Tensor<2, dim> derivative;
    ContactStatus          status;
  };

  /**
   * Unilateral contact with Coulomb friction, as a projection of the trial
   * traction @f$\tau^{tr}@f$ (positive normal part: tension),
   *
   * @f[ \tau_n = \tau_n^{tr} \text{ if } \tau_n^{tr} \leq p_t,
   *     \text{ else } \tau = 0, \qquad
   *     \tau_t = \tau_t^{tr} \min(1, b/|\tau_t^{tr}|), \quad
   *     b = \max(0, c - \mu \tau_n) . @f]
   *
   * Alart and Curnier (1991) write it with @f$p_t = c = 0@f$.
   */
  struct ContactLaw
  {
    double friction         = 0;    ///< @f$\mu@f$
    double adhesion         = 0;    ///< c [stress]
    double tensile_strength = 0;    ///< @f$p_t@f$ [stress], if it separates
    bool   separates        = true; ///< else @f$p_t = \infty@f$

    /** Whether there is a shear traction. */
    bool
    rubs() const
    {
      return friction > 0 || adhesion > 0;
    }

    /**
     * @param trial the trial traction
     * @param normal out of the body, of unit length
     * @param was_open at the start of the step: what is torn apart has neither
     * tensile strength nor adhesion until it has closed again
     * @param round_off a tension [stress] that is none
     */
    template <int dim>
    ContactResponse<dim>
    response(const dealii::Tensor<1, dim> &trial,
             const dealii::Tensor<1, dim> &normal,
             const bool                    was_open,
             const double                  round_off) const;
  };
} // namespace moraine

#endif
