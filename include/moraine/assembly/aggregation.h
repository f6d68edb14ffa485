// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_aggregation_h
#define moraine_assembly_aggregation_h

#include <moraine/assembly/term.h>

namespace moraine
{
  /**
   * The ties of Aggregates as lines @f$\Delta u_i = \sum_a N_a(x_i)\, \Delta
   * u_a@f$, the functions those of the root's nodes @f$a@f$. Components that
   * something else prescribes are left to it.
   */
  template <int dim>
  class Aggregation : public Term<dim>
  {
  public:
    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    void
    constrain(const StepContext<dim>            &context,
              dealii::AffineConstraints<double> &lines) const override;
  };
} // namespace moraine

#endif
