// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_crossing_watch_h
#define moraine_run_crossing_watch_h

#include <moraine/run/model.h>

#include <string>

namespace moraine
{
  /**
   * Looks what points without domains do to equilibrium as they move through
   * the mesh: forces that balanced at the end of a step do not at the start of
   * the next one, where points have other places in other cells. In statics
   * each step takes this as a motion, which takes stress away.
   */
  template <int dim>
  class CrossingWatch : public StatePart
  {
  public:
    CrossingWatch(const Scene<dim> &scene, const Model<dim> &model);

    /** The next step may be out of balance because what acts is another. */
    void
    stage_begins()
    {
      begins = true;
    }

    /**
     * Count a step of @p stage that has begun at @p t. Collective.
     * @return once, that forces have been out of balance on the whole; or "".
     */
    std::string
    look(const StageParameters &stage, const double t);

    /** Data sets "checks/crossing/...": what was counted. */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    /** Whether points are stressed by more than what round-off leaves. */
    bool
    has_stress() const;

    const Scene<dim> &scene;
    const Model<dim> &model;
    double            smallest_stress;
    bool              begins  = true;
    unsigned int      n_steps = 0;
    double            shares  = 0; ///< of the steps counted, summed up
    bool              told    = false;
  };
} // namespace moraine

#endif
