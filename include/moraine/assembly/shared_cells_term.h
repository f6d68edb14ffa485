// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_shared_cells_term_h
#define moraine_assembly_shared_cells_term_h

#include <moraine/assembly/boundary_term.h>

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
   * nearest to the tractions of the stress. Nothing else follows from them: the
   * bodies feel, and energies count, those that hold. Nitsche's flux is such a
   * traction already. Stands after the terms of the boundaries.
   */
  template <int dim>
  class SharedCellsTerm : public Term<dim>
  {
  public:
    explicit SharedCellsTerm(std::vector<const BoundaryTerm<dim> *> boundaries);

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
    const std::vector<const BoundaryTerm<dim> *> boundaries;
  };
} // namespace moraine

#endif
