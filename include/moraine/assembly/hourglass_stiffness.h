// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_hourglass_stiffness_h
#define moraine_assembly_hourglass_stiffness_h

#include <moraine/assembly/term.h>

#include <vector>

namespace moraine
{
  /**
   * Cells of degree 2 with 2 Gauss points per direction resist the increments
   * of a step that these points do not see:
   * @f[ f_a = -\alpha \mu \int \nabla(u - \Pi u) \cdot
   *     (\nabla N_a - \Pi \nabla N_a) \, dV @f]
   * with @f$\Pi@f$ the linear interpolation between the Gauss points. It
   * vanishes for displacements of degree 2, so that the order of accuracy
   * stays, and it is forgotten after the step. It holds the zero-energy modes
   * of reduced integration (Belytschko et al. 1984 for those of degree 1).
   */
  template <int dim>
  class HourglassStiffness : public Term<dim>
  {
  public:
    /** It stores nothing from one step to the next. */
    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind  = WorkKind::damping;
      is.stabilises = true;
      return is;
    }

    /** None: it holds what would be free. */
    std::vector<Effect>
    effects(const StepContext<dim> &) const override
    {
      return {};
    }

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;
  };
} // namespace moraine

#endif
