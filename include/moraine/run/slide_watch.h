// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_slide_watch_h
#define moraine_run_slide_watch_h

#include <moraine/core/simulation_state.h>

#include <string>

namespace moraine
{
  /**
   * Looks whether bodies that yield slide from one equilibrium to another in a
   * quasi-static step. Beyond its limit load soil may come to rest in another
   * shape, where points or nodes move with it, and the run goes on as if it had
   * stood.
   */
  class SlideWatch : public StatePart
  {
  public:
    /** @p yields: whether a material of the scene does; else nothing is told.
     * @p cell_size [length] */
    SlideWatch(const bool yields, const double cell_size, const double start);

    /** Loads may begin at once: motions of the stages before say nothing. */
    void
    stage_begins();

    /**
     * What is to be told after a step, once in a stage, when motion has become
     * slow again after steps that were much faster than all before; or "".
     * @param t its end
     * @param motion of the node that moved furthest in it [length]
     * @param counts whether it was quasi-static, along no path of an arc
     * length, and points or nodes move
     */
    std::string
    look(const double t, const double motion, const bool counts);

    /** Data sets "checks/slides/...". */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    void
    forget_slide();

    bool         yields;
    double       cell_size;
    double       last;        ///< end of the step before
    double       fastest = 0; ///< motion over time of the steps before
    unsigned int n_steps = 0; ///< of the stage that counted
    bool         told    = false;
    /** Of the steps in a row that are much faster by now. */
    unsigned int n_fast    = 0;
    unsigned int n_as_fast = 0; ///< about, as the fastest of these
    double       slid_by   = 0;
    double       fast_rate = 0; ///< the largest
    double       fast_time = 0; ///< end of that step
  };
} // namespace moraine

#endif
