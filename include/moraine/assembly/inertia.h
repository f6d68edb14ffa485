// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_inertia_h
#define moraine_assembly_inertia_h

#include <moraine/assembly/term.h>

namespace moraine
{
  /**
   * The forces of inertia @f$-M a@f$ with the consistent mass
   * @f$M_{ab} = \sum_p m_p N_a N_b@f$, or the lumped one
   * @f$M_{aa} = \sum_p m_p N_a@f$, as Motion says; so it says where in the step
   * the acceleration is taken.
   */
  template <int dim>
  class Inertia : public PointTerm<dim>
  {
  public:
    WorkKind
    work_kind() const override
    {
      return WorkKind::none;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    is_inertia() const override
    {
      return true;
    }

    using PointTerm<dim>::add;

    void
    add(const StepContext<dim>  &context,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const override;

  private:
    mutable std::vector<dealii::Tensor<1, dim>> accelerations; ///< scratch
    mutable std::vector<double>                 masses;        ///< scratch
  };
} // namespace moraine

#endif
