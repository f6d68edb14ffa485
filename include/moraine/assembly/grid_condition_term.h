// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_grid_condition_term_h
#define moraine_assembly_grid_condition_term_h

#include <moraine/assembly/shared_nodes.h>
#include <moraine/assembly/term.h>
#include <moraine/boundary/grid_condition.h>

#include <vector>

namespace moraine
{
  /** Displacements prescribed at nodes: lines of the constraint table. */
  template <int dim>
  class GridConditionTerm : public Term<dim>
  {
  public:
    explicit GridConditionTerm(
      const std::vector<GridCondition<dim>> &conditions);

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind               = WorkKind::none;
      is.wants_unbalanced_forces = true;
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    begin_step(const StepContext<dim> &context) override;

    void
    constrain(const StepContext<dim>            &context,
              dealii::AffineConstraints<double> &constraints) const override;

    void
    check_values(const StepContext<dim> &context) override;

    void
    add_constraint_forces(const StepContext<dim> &context,
                          const std::string      &name,
                          const LA::Vector       &unbalanced,
                          GlobalSystem<dim>      &system) const override;

    void
    prepare(const StepContext<dim> &context,
            const LA::Vector       &unbalanced) override;

    void
    report(const StepContext<dim>           &context,
           std::vector<BoundaryReport<dim>> &reports) const override;

    const std::vector<GridCondition<dim>> &
    all() const
    {
      return conditions;
    }

    /** By all(). */
    const PrescribedNodes<dim> &
    nodes() const
    {
      return prescribed;
    }

  private:
    const std::vector<GridCondition<dim>> conditions;
    PrescribedNodes<dim>                  prescribed;
    SharedNodes<dim>                      shared;
    std::vector<BoundaryReport<dim>>      prepared;
  };
} // namespace moraine

#endif
