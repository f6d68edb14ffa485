// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_energy_watch_h
#define moraine_run_energy_watch_h

#include <moraine/core/simulation_state.h>
#include <moraine/state/motion.h>

#include <string>

namespace moraine
{
  /**
   * Looks for energy that nothing has given. With the kinetic energy T, the
   * stored energy E and the dissipation D, a step has
   *
   * @f[ T + E + D = T_0 + E_0 + W_{loads} + W_{moved} + W_{absorbing}
   *     + \text{errors} , @f]
   *
   * where @f$W_{moved}@f$ is the work of boundaries in the motion that is
   * prescribed to them, and the rest of their work is an error: what only holds
   * gives nothing. @f$G@f$, the largest that any of @f$T_0 + E_0@f$,
   * @f$|W_{loads}|@f$, @f$|W_{moved}|@f$ and @f$W_{absorbing}@f$ has been, is
   * all that one of them can have given; without errors
   * @f$T + E + D \leq 4 G@f$.
   */
  class EnergyWatch : public StatePart
  {
  public:
    /** Less energy than @p round_off is not looked at. @p remedies: keys of
     * section 'Method' that the scene can still change against energy from
     * boundaries or transfers, empty if none. */
    explicit EnergyWatch(const double       round_off,
                         const std::string &remedies = "");

    /** Take the sums of @p works in dynamics up to time @p t and, of the step
     * that ended there, @p work_of_motions, by implicit boundaries in their
     * prescribed motion. */
    void
    count(const Works &works, const double work_of_motions, const double t);

    /** Works are counted anew from here: what was done before is stored. */
    void
    motion_starts()
    {
      given = moved = 0;
    }

    /** Bodies come with energy, or go. */
    void
    bodies_change()
    {
      starts_anew = true;
    }

    /** That boundaries that hold, or transfers between nodes and points, have
     * made more than a fifth of what was given in five steps in a row, and no
     * less and less of it; once; or "". To be asked after each count(). */
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
    /** What they gave beyond the work of their motions [force length]. */
    double
    made_by_boundaries() const;

    /** Where most of the energy without work comes from, and what helps. */
    std::string
    cause() const;

    const double      round_off;
    const std::string of_method;          ///< the end of a sentence of remedies
    double            given          = 0; ///< G [force length]
    double            moved          = 0; ///< W_moved [force length]
    double            total          = 0; ///< T + E + D [force length]
    double            grows_since    = 0; ///< total > 4 G
    bool              starts_anew    = false;
    bool              told           = false; ///< by warning()
    unsigned int      in_a_row       = 0;     ///< steps with much without work
    double            share_at_first = 0; ///< of what was given, in the first
    Works             works;
    double            time = 0;
  };
} // namespace moraine

#endif
