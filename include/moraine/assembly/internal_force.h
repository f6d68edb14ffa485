// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_internal_force_h
#define moraine_assembly_internal_force_h

#include <moraine/assembly/term.h>

namespace moraine
{
  /** Why @p trial has no stress for its first failure, local point @p point. */
  template <int dim>
  std::string
  why_no_stress(const State<dim>       &state,
                const TrialPoints<dim> &trial,
                const Material         &material,
                const unsigned int      point);



  /** @f$v\, \sigma \nabla N@f$ of a stress in a volume. */
  template <int dim>
  inline dealii::Tensor<1, dim>
  force_of_stress(const double                         v,
                  const dealii::SymmetricTensor<2, 3> &stress,
                  const dealii::Tensor<1, dim>        &gradient)
  {
    dealii::Tensor<1, dim> force;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        force[i] += v * stress[i][j] * gradient[j];
    return force;
  }



  /**
   * @f$-\sum_p B_p^T \sigma_p v_p@f$ with trial stresses, and
   * @f$K = \sum_p B_p^T C B_p v_p@f$ (Cortis et al. 2017, eqs. 7-9).
   *
   * With a constant isotropic C the sum over points needs only the moments
   * @f$G_{ai,bj} = \sum_p v_p\, \partial_i N_a\, \partial_j N_b@f$; then
   * @f$K_{ai,bj} = \lambda G_{ai,bj} + \mu G_{aj,bi}
   *  + \mu\, \delta_{ij} \sum_k G_{ak,bk}@f$, so that many points in a cell
   * cost little more than few.
   *
   * Otherwise, with TrialPoints' weights w and gradients g and the spatial
   * tangent c,
   * @f$f_{ai} = -\sum_p w\, \tau_{ij} g_{aj}@f$ and
   * @f$K_{ai,bj} = \sum_p w\, (g_{ak} c_{ikjl}\, g_{bl}
   *  + \delta_{ij}\, g_a \cdot \tau g_b)@f$, the second term at finite strain
   * only. It is the exact derivative, and symmetric if c is.
   */
  template <int dim>
  class InternalForce : public PointTerm<dim>
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
      return context.state.has_symmetric_tangents();
    }

    using PointTerm<dim>::add;

    void
    add(const StepContext<dim>  &context,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const override;

    /** By the stresses that points have, without asking the material. */
    void
    add_at_start(const StepContext<dim>  &context,
                 const StencilBlock<dim> &block,
                 LocalSystem<dim>        &local) const override;
  };
} // namespace moraine

#endif
