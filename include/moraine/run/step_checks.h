// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_step_checks_h
#define moraine_run_step_checks_h

#include <moraine/run/crossing_watch.h>
#include <moraine/run/end_watch.h>
#include <moraine/run/energy_watch.h>
#include <moraine/run/hold_watch.h>
#include <moraine/run/model.h>
#include <moraine/run/pass_watch.h>
#include <moraine/run/slide_watch.h>
#include <moraine/run/turn_watch.h>
#include <moraine/time/time_control.h>

#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Looks for what makes the numbers of a run doubtful although its steps are
   * accepted, and says it once, where it begins. All functions are collective.
   */
  template <int dim>
  class StepChecks : public StatePart
  {
  public:
    StepChecks(const Scene<dim> &scene, const Model<dim> &model);

    /** @p bodies_change: they come or go, so that what hangs together is
     * counted anew. @p motion_starts: so that works are. */
    void
    stage_begins(const bool bodies_change, const bool motion_starts);

    /**
     * What is to be told of the step of @p stage that has begun at @p t: that a
     * body came apart before, and what HoldWatch, CrossingWatch and PassWatch
     * find.
     * @throws ComputationError if the run cannot go on or should not.
     */
    std::vector<std::string>
    of_begun_step(const StageParameters &stage, const double t);

    /**
     * What is to be told of the step that @p time has accepted, with the
     * boundaries' @p reports: that the material misses one of them, with
     * @p largest_motion of a node in the step and that @p of_points, or has
     * passed it; what EndWatch finds; that points of a body drift apart; that a
     * body moves far or is turned at small strain; that material that yields
     * slides; that energy grows without work.
     */
    std::vector<std::string>
    of_step(const TimeControl                      &time,
            const IntegratorParameters             &rule,
            const std::vector<BoundaryReport<dim>> &reports,
            const double                            largest_motion,
            const double                            of_points);

    /** Why the run cannot be believed any more; see EnergyWatch::failure(). */
    std::string
    failure() const
    {
      return energy.failure();
    }

    /** Data sets "checks/...": what was told, and what it is told by. */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    /** That a body came apart; empty if none did. @throws ComputationError
     * unless the scene wants to go on. */
    std::string
    separation();

    std::string
    missed_boundary(const double               t,
                    const BoundaryReport<dim> &report,
                    const double               largest_motion);

    /** That material has come behind a boundary, unless missed_boundary() has
     * told of it: where cells let go, nothing else shows it. */
    std::string
    passed_boundary(const double t, const BoundaryReport<dim> &report);

    /** That points without domains that follow them are stretched apart. */
    std::string
    points_apart(const double t);

    /** That the material of a body moved by more than its size, or parts of it
     * by much of it against each other where they do move, for all that small
     * strain knows of it. In dynamics what flies as a whole is right. */
    std::string
    moved_far(const double t);

    /** What the scene does not have yet against energy that is made. */
    std::string
    remedy_of_energy(const EnergySource source) const;

    const Scene<dim>         &scene;
    const Model<dim>         &model;
    std::vector<unsigned int> n_parts; ///< of each body
    std::set<std::string>     missed;  ///< boundaries told of
    /** How far points were behind boundaries when the stage began, by name;
     * infinite where it was told of. */
    std::map<std::string, double> depths;
    std::set<unsigned int>        stretched; ///< bodies told of
    std::set<unsigned int>        far;       ///< the same, as they moved far
    EnergyWatch                   energy;
    HoldWatch<dim>                holds;
    CrossingWatch<dim>            crossings;
    TurnWatch<dim>                turns;
    SlideWatch                    slides;
    PassWatch<dim>                passes;
    EndWatch<dim>                 ends;
    std::string                   integrator; ///< of the last step
    std::string                   transfer;   ///< of velocities in it
  };
} // namespace moraine

#endif
