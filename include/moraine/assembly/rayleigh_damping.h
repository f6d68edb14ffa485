// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_rayleigh_damping_h
#define moraine_assembly_rayleigh_damping_h

#include <moraine/assembly/term.h>
#include <moraine/state/block_mass.h>

namespace moraine
{
  /** Of a body: damping @f$\alpha M + \beta K@f$. */
  struct RayleighFactors
  {
    double mass      = 0; ///< @f$\alpha@f$ [1/time]
    double stiffness = 0; ///< @f$\beta@f$ [time]

    bool
    damps() const
    {
      return mass > 0 || stiffness > 0;
    }

    /** Those of the damping ratio @p ratio at two angular frequencies, by
     * @f$\xi = \alpha/(2\omega) + \beta\omega/2@f$. */
    static RayleighFactors
    of_ratio(const double ratio, const double omega_1, const double omega_2)
    {
      const double factor = 2 * ratio / (omega_1 + omega_2);
      return {factor * omega_1 * omega_2, factor};
    }
  };



  /**
   * Rayleigh damping of bodies: the forces @f$-\alpha M v@f$, with the mass
   * that Inertia has, and those of a
   * viscous stress
   *
   * @f[ \tau^v = \beta\, C : \mathrm{sym}\, L , \qquad
   *     f_a = -\sum_p w\, \tau^v\, g_a , \qquad L = \sum_a v_a \otimes g_a @f]
   *
   * with the elastic stiffness C, per initial volume, and the gradients
   * @f$g_a = F^{-T} \nabla N_a@f$ where the integrator asks for forces: at the
   * end of the step, @f$F = 1 + \sum_a \Delta u_a \otimes \nabla N_a@f$, or in
   * its middle, half of that sum. So a velocity of rotation alone has no
   * viscous stress. At small strain F = 1. The derivative is exact; at finite
   * strain it is not symmetric.
   */
  template <int dim>
  class RayleighDamping : public PointTerm<dim>
  {
  public:
    /** @p factors of each body. */
    explicit RayleighDamping(const std::vector<RayleighFactors> &factors);

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind = WorkKind::damping;
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

  private:
    struct Scratch
    {
      std::vector<dealii::Tensor<1, dim>> velocities;
      std::vector<dealii::Tensor<1, dim>> gradients;
      std::vector<double>                 masses; ///< alpha M of a batch
      BlockMass<dim>                      mass;
    };

    void
    add_of_mass(const State<dim>        &state,
                const Motion<dim>       &motion,
                const StencilBlock<dim> &block,
                const bool               tangent,
                LocalSystem<dim>        &local) const;

    void
    add_of_stiffness(const StepContext<dim>  &context,
                     const StencilBlock<dim> &block,
                     const unsigned int       p,
                     const bool               tangent,
                     LocalSystem<dim>        &local) const;

    const std::vector<RayleighFactors> factors;
    const bool                         damps_mass; ///< of any body
    mutable Scratch                    scratch;
  };
} // namespace moraine

#endif
