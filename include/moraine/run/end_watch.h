// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_end_watch_h
#define moraine_run_end_watch_h

#include <moraine/run/model.h>

#include <set>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Looks whether material that a boundary holds up to where it ends, as one
   * that is a part of a body, has grown past the end and come behind what would
   * be the boundary there: nothing holds it. What has material beside an end as
   * the boundary begins to act, as a footing, is not looked at.
   */
  template <int dim>
  class EndWatch : public StatePart
  {
  public:
    explicit EndWatch(const Model<dim> &model);

    /** As a step of @p stage begins: notes which of its boundaries it will
     * look at. Collective. */
    void
    step_begins(const StageParameters &stage);

    /** After a step to @p t with @p reports of the boundaries that act: what is
     * to be told, of each boundary once. Collective. */
    std::vector<std::string>
    look(const std::vector<BoundaryReport<dim>> &reports, const double t);

    /** Data sets "checks/ends/...". */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    enum class When
    {
      start, ///< of the step
      end
    };

    /** Of the points past the ends of a boundary, but by no more than a cell.
     */
    struct PastEnds
    {
      bool   beside = false; ///< one is within a cell of its continuation
      double depth  = 0;     ///< of the one furthest behind that, within a cell
    };

    /** Collective. */
    PastEnds
    past_ends(const ImplicitBoundary<dim> &boundary, const When when) const;

    const Model<dim>     &model;
    std::set<std::string> known; ///< boundaries that have acted
    std::set<std::string> watched;
  };
} // namespace moraine

#endif
