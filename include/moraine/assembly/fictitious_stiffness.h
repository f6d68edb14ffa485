// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_fictitious_stiffness_h
#define moraine_assembly_fictitious_stiffness_h

#include <moraine/assembly/term.h>

#include <utility>
#include <vector>

namespace moraine
{
  /**
   * The empty part of active cells has a fraction of the stiffness of the
   * material in them. It resists the increment of each step and then is
   * forgotten (a finite cell method, Parvizian et al. 2007), so that nodes
   * touched by too few points are held.
   */
  template <int dim>
  class FictitiousStiffness : public Term<dim>
  {
  public:
    /** @p fraction >= 0. */
    explicit FictitiousStiffness(const double fraction);

    /** From the next trial on. */
    void
    set_fraction(const double new_fraction)
    {
      fraction = new_fraction;
    }

    double
    stiffness_fraction() const
    {
      return fraction;
    }

    /** It stores nothing from one step to the next. */
    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind  = WorkKind::damping;
      is.stabilises = true;
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    begin_step(const StepContext<dim> &context) override;

    /** Whether any cell has an empty part. Collective. */
    bool
    any_empty_part(const StepContext<dim> &context) const;

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

  private:
    template <int degree>
    void
    add_cells(const StepContext<dim> &context,
              const bool              tangent,
              GlobalSystem<dim>      &system) const;

    double fraction;
    /** Cells of this rank that points do not fill, and which part of them is
     * empty. */
    std::vector<std::pair<typename GridSpace<dim>::CellIterator, double>>
      empty_cells;
  };
} // namespace moraine

#endif
