// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_inertia_h
#define moraine_assembly_inertia_h

#include <moraine/assembly/term.h>
#include <moraine/state/block_mass.h>

namespace moraine
{
  /**
   * The forces of inertia @f$-M a@f$ with the consistent mass, that of nodes of
   * tiny mass lumped, or the lumped one, as Motion says (see BlockMass); so it
   * says where in the step the acceleration is taken.
   */
  template <int dim>
  class Inertia : public PointTerm<dim>
  {
  public:
    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind  = WorkKind::none;
      is.is_inertia = true;
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    using PointTerm<dim>::add;

    void
    add(const StepContext<dim>  &context,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const override;

  private:
    /** Let nodes that have stiffness without mass keep their acceleration,
     * where nothing else says how they move: with next to no mass. */
    void
    hold_massless_nodes(const StepContext<dim>  &context,
                        const StencilBlock<dim> &block,
                        const bool               tangent,
                        LocalSystem<dim>        &local) const;

    // Scratch.
    mutable BlockMass<dim>                      mass;
    mutable std::vector<dealii::Tensor<1, dim>> accelerations;
    mutable std::vector<double>                 masses;
  };
} // namespace moraine

#endif
