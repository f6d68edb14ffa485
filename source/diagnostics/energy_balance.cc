// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/diagnostics/energy_balance.h>

#include <moraine/core/words.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  namespace
  {
    /** Of G: without errors T + E + D is less. */
    constexpr double most_without_errors = 4;

    /** Of G: the run ends. */
    constexpr double most_allowed = 100;

    /** Steps in a row; a motion that begins from rest has next to none at
     * first. */
    constexpr unsigned int least_in_row = 5;
    constexpr double       falls_behind = 0.7;
  } // namespace



  EnergyBalance::EnergyBalance(Ledger &ledger, const double round_off)
    : round_off(round_off)
    , given(ledger.number("energy/given"))
    , moved(ledger.number("energy/moved"))
    , allowed(ledger.number("energy/allowed"))
    , last_made(ledger.number("energy/last made"))
    , starts_anew(ledger.number("energy/starts anew"))
    , in_a_row(ledger.number("energy/in a row"))
    , share_at_first(ledger.number("energy/share at first"))
  {}



  void
  EnergyBalance::count(const Works &of_run,
                       const double work_of_motions,
                       const double t)
  {
    works = of_run;
    time  = t;
    moved += work_of_motions;
    total           = works.kinetic + works.stored + works.dissipated;
    const auto work = [this](const WorkKind kind) {
      return works.of_forces[unsigned(kind)];
    };
    given = std::max({given,
                      works.kinetic_at_start + works.stored_at_start,
                      std::abs(work(WorkKind::external)),
                      std::abs(moved + works.of_prescribed),
                      work(WorkKind::absorbed),
                      starts_anew != 0 ? total : 0.});
    if (starts_anew != 0)
      allowed += made() - last_made;
    last_made   = made();
    starts_anew = 0;
  }



  void
  EnergyBalance::motion_starts()
  {
    given = moved = allowed = last_made = 0;
  }



  void
  EnergyBalance::bodies_change()
  {
    starts_anew = 1;
  }



  double
  EnergyBalance::made_by_boundaries() const
  {
    return works.of_forces[unsigned(WorkKind::boundaries)] -
           works.of_prescribed - moved;
  }



  double
  EnergyBalance::made() const
  {
    return made_by_boundaries() - works.lost_in_transfer -
           works.numerical_damping() - works.out_of_balance();
  }



  std::string
  EnergyBalance::source() const
  {
    const double transferred = -works.lost_in_transfer;
    const double integrated =
      -works.numerical_damping() - works.out_of_balance();
    if (made_by_boundaries() >= std::max(integrated, transferred))
      return "boundaries";
    return integrated >= transferred ? "integrator" :
                                       "transfers between points and nodes";
  }



  double
  EnergyBalance::growth()
  {
    const double share = total > round_off ? (made() - allowed) / given : 0.;
    if (!(share > allowed_growth))
      {
        in_a_row = 0;
        return 0;
      }
    if (in_a_row == 0 || share < falls_behind * share_at_first)
      {
        in_a_row       = 0;
        share_at_first = share;
      }
    return ++in_a_row < least_in_row ? 0. : share;
  }



  std::string
  EnergyBalance::failure() const
  {
    if (total <= std::max(most_allowed * given, round_off))
      return "";
    return "at t = " + text_of(time, 3) + " the bodies have the energy " +
           text_of(total, 3) + ", but the start, loads and motions gave " +
           text_of(given, 3) + " (without errors at most " +
           text_of(most_without_errors, 3) +
           " times that); source: " + source();
  }
} // namespace moraine
