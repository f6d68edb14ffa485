// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_energy_watch_h
#define moraine_run_energy_watch_h

#include <moraine/core/simulation_state.h>
#include <moraine/state/motion.h>

#include <functional>
#include <string>

namespace moraine
{
  /** Where energy without work comes from. */
  enum class EnergySource
  {
    boundaries, ///< that hold
    integrator,
    transfers ///< of velocities and stresses between nodes and points
  };

  /**
   * Looks for energy that nothing has given. With the kinetic energy T, the
   * stored energy E and the dissipation D, the balance is
   *
   * @f[ T + E + D = T_0 + E_0 + W_{loads} + W_{moved} + W_{absorbing} +
   *     W_{damping} + \text{made} , @f]
   *
   * where @f$W_{moved}@f$ is the work of boundaries in the motion that is
   * prescribed to them. What is made is the sum of three errors, which may
   * cancel: the rest of the work of boundaries (what only holds gives nothing),
   * less what the integrator takes, less what transfers lose. It is compared
   * with @f$G@f$, the largest that any of @f$T_0 + E_0@f$,
   * @f$|W_{loads}|@f$, @f$|W_{moved}|@f$ and @f$W_{absorbing}@f$ has been;
   * without errors @f$T + E + D \leq 4 G@f$.
   */
  class EnergyWatch : public StatePart
  {
  public:
    /** A remedy, in words. */
    using Remedy = std::function<std::string(const EnergySource)>;

    /** Less energy than @p round_off is not looked at. */
    EnergyWatch(const double round_off, const Remedy &remedy);

    /** Take the sums of @p works in dynamics up to time @p t and, of the step
     * that ended there, @p work_of_motions, by implicit boundaries in their
     * prescribed motion. */
    void
    count(const Works &works, const double work_of_motions, const double t);

    /** Works are counted anew from here: what was done before is stored. */
    void
    motion_starts()
    {
      given = moved = allowed = last_made = 0;
    }

    /** Bodies come with energy, or go. */
    void
    bodies_change()
    {
      starts_anew = true;
    }

    /** That more than a twentieth of what was given was made in five steps in a
     * row, and no less and less of it; once; or "". To be asked after each
     * count(). */
    std::string
    warning();

    /** Why the run cannot be believed; empty if it can. */
    std::string
    failure() const;

    /** Data sets "checks/energy/...". */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    /** Work of boundaries beyond that of their motions [force length]. */
    double
    made_by_boundaries() const;

    /** By all three sources [force length]. */
    double
    made() const;

    /** Where most of the energy without work comes from, and what helps. */
    std::string
    cause() const;

    const double round_off;
    const Remedy remedy;
    double       given          = 0; ///< G [force length]
    double       moved          = 0; ///< W_moved [force length]
    double       allowed        = 0; ///< made() of bodies that came or went
    double       last_made      = 0; ///< made() of the last count()
    double       total          = 0; ///< T + E + D [force length]
    double       grows_since    = 0; ///< total > 4 G
    bool         starts_anew    = false;
    bool         told           = false; ///< by warning()
    unsigned int in_a_row       = 0;     ///< steps with much without work
    double       share_at_first = 0;     ///< of what was given, in the first
    Works        works;
    double       time = 0;
  };
} // namespace moraine

#endif
