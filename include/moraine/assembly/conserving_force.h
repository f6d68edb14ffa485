// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_conserving_force_h
#define moraine_assembly_conserving_force_h

#include <moraine/assembly/term.h>

namespace moraine
{
  /**
   * Internal forces in the middle of a step, whose work is exactly what the
   * material stores and dissipates in the step, and which have no moment about
   * any axis (the discrete derivative of Gonzalez 2000, from the start of the
   * step). With @f$H = \sum_a \Delta u_a \otimes \nabla N_a@f$,
   * @f$\Delta F = 1 + H@f$, @f$\Delta E = \frac12 (\Delta F^T \Delta F - 1)@f$
   * and weights w, nabla and @f$\tau_n@f$ of the start,
   *
   * @f{gather*}{
   *   f_a = -\sum_p w\, (1 + \tfrac12 H)\, \Sigma\, \nabla N_a , \qquad
   *   \bar\Sigma = \tfrac12 (\tau_n + \Delta F^{-1} \tau_{n+1} \Delta F^{-T}) ,
   *   \\
   *   \Sigma = \bar\Sigma + c\, \Delta E , \qquad
   *   c = \frac{\Delta\psi + d - \bar\Sigma : \Delta E}{\Delta E : \Delta E} ,
   * @f}
   *
   * with the stored energy @f$\psi@f$ and the dissipation d of the step, see
   * TrialPoints::find_energies(). In a small step c is of the order of
   * @f$\Delta E@f$; where it is less than what round-off leaves of it, it is
   * left out.
   *
   * The derivative is exact. With @f$\delta\Delta E = \mathrm{sym}(\Delta F^T
   * \delta H)@f$, the spatial tangent pulled back by @f$\Delta F@f$, D, and
   * @f$\Gamma = \Delta F^{-1} G\, \Delta F^{-T}@f$ (TrialPoints::
   * energy_gradient()),
   *
   * @f[
   *   \delta\Sigma = \Bigl( \tfrac12 D + c\,\mathbb{I} + \frac{\Delta E \otimes
   *     (\Gamma - \bar\Sigma - \frac12 D : \Delta E - 2 c\, \Delta E)}
   *     {\Delta E : \Delta E} \Bigr) : \delta\Delta E
   * @f]
   *
   * is not symmetric. At small strain c is zero and @f$\Sigma@f$ the mean
   * stress of both ends: the average acceleration.
   */
  template <int dim>
  class ConservingForce : public PointTerm<dim>
  {
  public:
    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind = WorkKind::internal;
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    symmetric(const StepContext<dim> &context) const override
    {
      return context.state.strain_measure() == StrainMeasure::small;
    }

    using PointTerm<dim>::add;

    void
    add(const StepContext<dim>  &context,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const override;
  };
} // namespace moraine

#endif
