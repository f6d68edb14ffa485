// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/energy_watch.h>

#include <moraine/core/words.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace moraine
{
  namespace
  {
    /** Of what was given: more than that without errors is not possible. */
    constexpr double most_without_errors = 4;

    /** And this is no error that can be lived with. */
    constexpr double most_allowed = 100;

    /** What is made is told of when it has been more in so many steps in a row
     * without falling behind what is given: a motion that begins from rest has
     * next to none at first. */
    constexpr double       told_share   = 0.05;
    constexpr unsigned int told_in_row  = 5;
    constexpr double       falls_behind = 0.7;
  } // namespace



  EnergyWatch::EnergyWatch(const double round_off, const Remedy &remedy)
    : round_off(round_off)
    , remedy(remedy)
  {}



  void
  EnergyWatch::count(const Works &of_run,
                     const double work_of_motions,
                     const double t)
  {
    works = of_run;
    time  = t;
    moved += work_of_motions;
    const double of_motions = moved + works.of_prescribed;
    total                   = works.kinetic + works.stored + works.dissipated;
    const auto work         = [this](const WorkKind kind) {
      return works.of_forces[unsigned(kind)];
    };
    given = std::max({given,
                      works.kinetic_at_start + works.stored_at_start,
                      std::abs(work(WorkKind::external)),
                      std::abs(of_motions),
                      work(WorkKind::absorbed),
                      starts_anew ? total : 0.});
    if (starts_anew)
      allowed += made() - last_made;
    last_made   = made();
    starts_anew = false;
    if (total <= std::max(most_without_errors * given, round_off))
      grows_since = t;
  }



  double
  EnergyWatch::made_by_boundaries() const
  {
    return works.of_forces[unsigned(WorkKind::boundaries)] -
           works.of_prescribed - moved;
  }



  double
  EnergyWatch::made() const
  {
    return made_by_boundaries() - works.lost_in_transfer -
           works.numerical_damping() - works.out_of_balance();
  }



  std::string
  EnergyWatch::cause() const
  {
    const double held        = made_by_boundaries();
    const double transferred = -works.lost_in_transfer;
    const double integrated =
      -works.numerical_damping() - works.out_of_balance();
    if (held >= std::max(integrated, transferred))
      return "It comes from boundaries that hold: " +
             remedy(EnergySource::boundaries);
    if (integrated >= transferred)
      return "It comes from the integrator: " +
             remedy(EnergySource::integrator);
    return "It comes from carrying velocities between nodes and points: " +
           remedy(EnergySource::transfers);
  }



  std::string
  EnergyWatch::warning()
  {
    if (told)
      return "";
    const double share = total > round_off ? (made() - allowed) / given : 0.;
    if (!(share > told_share))
      {
        in_a_row = 0;
        return "";
      }
    if (in_a_row == 0 || share < falls_behind * share_at_first)
      {
        in_a_row       = 0;
        share_at_first = share;
      }
    if (++in_a_row < told_in_row)
      return "";
    told = true;
    std::ostringstream text;
    text << "energy grows without work, by " << per_cent(share)
         << " of what was given until t = " << std::setprecision(6) << time
         << ". " << cause();
    return text.str();
  }



  std::string
  EnergyWatch::failure() const
  {
    if (total <= std::max(most_allowed * given, round_off))
      return "";
    std::ostringstream text;
    text << std::setprecision(6) << "energy comes from nowhere: at t = " << time
         << " kinetic energy, strain energy and plastic dissipation are "
         << std::setprecision(2) << total
         << " together, while the start, loads and boundaries that move have "
            "given no more than "
         << given << "; they have been more than that can explain since t = "
         << std::setprecision(6) << grows_since << ". ";
    text << cause();
    return text.str();
  }



  void
  EnergyWatch::write(Archive &archive) const
  {
    archive.write("checks/energy/given", given, "force length");
    archive.write("checks/energy/moved", moved, "force length");
    archive.write("checks/energy/allowed", allowed, "force length");
    archive.write("checks/energy/last_made", last_made, "force length");
    archive.write("checks/energy/grows_since", grows_since, "time");
    archive.write("checks/energy/told", told ? 1u : 0u);
    archive.write("checks/energy/steps_in_a_row", in_a_row);
    archive.write("checks/energy/share_at_first", share_at_first);
    archive.write("checks/energy/starts_anew", starts_anew ? 1u : 0u);
  }



  void
  EnergyWatch::read(const Archive &archive)
  {
    given          = archive.number("checks/energy/given");
    moved          = archive.number("checks/energy/moved");
    allowed        = archive.number("checks/energy/allowed");
    last_made      = archive.number("checks/energy/last_made");
    grows_since    = archive.number("checks/energy/grows_since");
    told           = archive.integer("checks/energy/told") != 0;
    in_a_row       = archive.integer("checks/energy/steps_in_a_row");
    share_at_first = archive.number("checks/energy/share_at_first");
    starts_anew    = archive.integer("checks/energy/starts_anew") != 0;
    total          = 0;
  }
} // namespace moraine
