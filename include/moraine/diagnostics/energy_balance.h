// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_diagnostics_energy_balance_h
#define moraine_diagnostics_energy_balance_h

#include <moraine/diagnostics/ledger.h>
#include <moraine/state/motion.h>

#include <string>

namespace moraine
{
  /**
   * Finds energy that nothing has given. With the kinetic energy T, the stored
   * energy E and the dissipation D, the balance is
   *
   * @f[ T + E + D = T_0 + E_0 + W_{loads} + W_{moved} + W_{absorbing} +
   *     W_{damping} + \text{made} , @f]
   *
   * where @f$W_{moved}@f$ is the work of boundaries in the motion that is
   * prescribed to them. What is made is the sum of three errors, which may
   * cancel: the rest of the work of boundaries, minus the numerical damping of
   * the integrator, minus the energy lost in transfers. It is compared with
   * @f$G@f$, the largest so far of @f$T_0 + E_0@f$, @f$|W_{loads}|@f$,
   * @f$|W_{moved}|@f$ and @f$W_{absorbing}@f$; without errors
   * @f$T + E + D \leq 4 G@f$. Its numbers are kept in a ledger.
   */
  class EnergyBalance
  {
  public:
    /** Less energy than @p round_off is not looked at. */
    EnergyBalance(Ledger &ledger, const double round_off);

    /** Take the sums of @p works up to time @p t and, of the step that ended
     * there, the work of implicit boundaries in their prescribed motion. */
    void
    count(const Works &works, const double work_of_motions, const double t);

    /** Works are counted from here: dynamics begins. */
    void
    motion_starts();

    /** Bodies come with energy, or go. */
    void
    bodies_change();

    /** The energy made over G, once it has been more than a twentieth in five
     * steps in a row and does not fall behind; else 0. Asked after each
     * count(). */
    double
    growth();

    /** Which error made most of it: "boundaries", "integrator" or "transfers
     * between points and nodes". */
    std::string
    source() const;

    /** Why the run cannot go on; empty if it can. */
    std::string
    failure() const;

    static constexpr double allowed_growth = 0.05;

  private:
    double
    made_by_boundaries() const;

    double
    made() const;

    const double round_off;
    double      &given;       ///< G [force length]
    double      &moved;       ///< W_moved [force length]
    double      &allowed;     ///< made() of bodies that came or went
    double      &last_made;   ///< made() of the last count()
    double      &starts_anew; ///< bodies have changed
    double      &in_a_row;    ///< steps with growth
    double      &share_at_first;
    double       total = 0; ///< T + E + D [force length]
    double       time  = 0;
    Works        works;
  };
} // namespace moraine

#endif
