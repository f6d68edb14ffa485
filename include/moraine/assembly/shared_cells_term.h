// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_shared_cells_term_h
#define moraine_assembly_shared_cells_term_h

#include <moraine/assembly/boundary_term.h>
#include <moraine/assembly/grid_condition_term.h>

#include <vector>

namespace moraine
{
  /**
   * What each of the implicit boundaries in one cell reports of the force on
   * it. Multipliers and penalties of two boundaries that hold the same nodes in
   * one direction find the sum of their forces alone, and a motion that the
   * functions of the cell meet on both sides only nearly is a large pair of
   * opposite ones. In the cells around it alternates. In patches of such cells
   * the sum is shared out by the stress of each cell,
   *
   * @f[ f_q = w_q M_q (\bar\sigma n_q + a), \qquad
   *     \sum_q w_q M_q\, a = \sum_q (t_q - M_q \bar\sigma n_q)\, w_q, @f]
   *
   * with its mean @f$\bar\sigma@f$ by volume, the projections @f$M_q@f$ and the
   * areas @f$w_q@f$ of the places; of all that have this sum these forces are
   * nearest to the tractions of the stress.
   *
   * A node that a grid condition prescribes is held without the boundary in its
   * cell, whose force on it may be any. There the traction of the stress takes
   * its place, @f$f_q + \sum_a N_a (w_q M_q \bar\sigma n_q - f_q)@f$ over the
   * components that are prescribed, and the grid condition has that much less.
   *
   * Nothing else follows from these forces: the bodies feel, and energies
   * count, those that hold. Nitsche's flux is such a traction already. Stands
   * after the terms of the boundaries and of grid conditions.
   */
  template <int dim>
  class SharedCellsTerm : public Term<dim>
  {
  public:
    /** @p grid_conditions null if there are none. */
    SharedCellsTerm(std::vector<const BoundaryTerm<dim> *> boundaries,
                    const GridConditionTerm<dim>          *grid_conditions);

    /** None: nothing but reports. */
    std::vector<Effect>
    effects(const StepContext<dim> &) const override
    {
      return {};
    }

    /** Corrects those of the boundaries in @p reports. Collective. */
    void
    report(const StepContext<dim>           &context,
           std::vector<BoundaryReport<dim>> &reports) const override;

  private:
    using Held = std::vector<typename BoundaryTerm<dim>::HoldingPoint>;

    /** Leave to the nodes that grid conditions prescribe what they hold in the
     * cells of the places @p held, by boundary.
     * @return what changes of the forces of grid conditions */
    std::vector<BoundaryReport<dim>>
    leave_to_grid_conditions(const StepContext<dim> &context,
                             std::vector<Held>      &held) const;

    /** Share out the sums of the forces of @p held in patches. */
    void
    share_out(const StepContext<dim> &context, std::vector<Held> &held) const;

    const std::vector<const BoundaryTerm<dim> *> boundaries;
    const GridConditionTerm<dim> *const          grid_conditions;
  };
} // namespace moraine

#endif
