// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_conflict_term_h
#define moraine_assembly_conflict_term_h

#include <moraine/assembly/term.h>
#include <moraine/boundary/grid_condition.h>
#include <moraine/boundary/implicit_boundary.h>

#include <set>
#include <vector>

namespace moraine
{
  /**
   * Lets pieces of implicit boundaries go where these meet each other, or grid
   * conditions, that move differently in the cells around; see
   * resolve_conflicts(). Stands after the terms of what meets.
   */
  template <int dim>
  class ConflictTerm : public Term<dim>
  {
  public:
    /** Of those that act together from the first of @p times to the last; in
     * between they tell how motions go. */
    ConflictTerm(const std::vector<ImplicitBoundary<dim> *> &boundaries,
                 const std::vector<GridCondition<dim>>      &conditions,
                 const std::vector<double>                  &times);

    /** A note for each two that meet. */
    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    /** @throws InputError, on all ranks, for a boundary that would hold
     * nowhere. */
    bool
    begin_step(const StepContext<dim> &context) override;

  private:
    using Piece = ConflictingPiece<dim>;

    /** Two that meet. */
    struct Conflict
    {
      unsigned int           first;
      unsigned int           second;
      dealii::Point<dim>     x;     ///< where a piece lets go
      std::set<unsigned int> cells; ///< of such pieces
    };

    /** Those of this rank that share nodes with another owner. Collective. */
    std::vector<Piece>
    find_pieces(const StepContext<dim> &context) const;

    /** What each owner prescribes to what is at a place @p now, by its number.
     */
    std::vector<PrescribedIncrements<dim>>
    increments(const double now) const;

    void
    take_conflicts(const std::vector<Piece> &pieces,
                   const ConflictDecisions  &decisions);

    void
    check_that_all_hold(const StepContext<dim> &context) const;

    const std::string &
    name(const unsigned int owner) const
    {
      return owner < boundaries.size() ?
               boundaries[owner]->name() :
               conditions[owner - boundaries.size()].name;
    }

    const std::vector<ImplicitBoundary<dim> *> boundaries;
    const std::vector<GridCondition<dim>>      conditions;
    const std::vector<double>                  times;
    /** ImplicitBoundary::n_searches() by which conflicts were found last. */
    std::vector<unsigned int> searches;
    std::vector<Conflict>     conflicts;
  };
} // namespace moraine

#endif
