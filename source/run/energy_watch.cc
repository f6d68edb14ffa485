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

    /** What boundaries that hold or transfers make is told of, when it has been
     * more in so many steps in a row without falling behind what is given: a
     * motion that begins from rest has next to none at first. */
    constexpr double       told_share   = 0.2;
    constexpr unsigned int told_in_row  = 5;
    constexpr double       falls_behind = 0.7;
  } // namespace



  EnergyWatch::EnergyWatch(const double round_off, const std::string &remedies)
    : round_off(round_off)
    , of_method(remedies.empty() ? "" : ", or in section 'Method' " + remedies)
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
    given       = std::max({given,
                            works.kinetic_at_start + works.stored_at_start,
                            std::abs(work(WorkKind::external)),
                            std::abs(of_motions),
                            work(WorkKind::absorbed),
                      starts_anew ? total : 0.});
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



  std::string
  EnergyWatch::cause() const
  {
    const double held        = made_by_boundaries();
    const double made        = -works.out_of_balance();
    const double transferred = -works.lost_in_transfer;
    if (held >= std::max(made, transferred))
      return "It comes from boundaries that hold: shorter steps, what they do "
             "not have yet of 'Integrator = generalised-alpha' and "
             "'Enforcement' ('symmetric Nitsche', 'augmented Lagrangian', "
             "'penalty') or, with Nitsche's methods, a larger 'Nitsche "
             "factor'" +
             of_method;
    if (made >= transferred)
      return "It comes from the integrator: shorter steps, or 'Integrator = "
             "energy-momentum' or 'generalised-alpha' in section 'Time'";
    return "It comes from carrying velocities between nodes and points: "
           "another 'Velocity transfer' or 'Integrator = "
           "generalised-alpha' in section 'Time'" +
           of_method;
  }



  std::string
  EnergyWatch::warning()
  {
    const double made = std::max(made_by_boundaries(), -works.lost_in_transfer);
    if (told)
      return "";
    const double share = total > round_off ? made / given : 0.;
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
    text << "energy grows without work: by t = " << std::setprecision(6) << time
         << " it is " << per_cent(made / given)
         << " of what the start, loads and boundaries that move have given. "
         << cause();
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
    grows_since    = archive.number("checks/energy/grows_since");
    told           = archive.integer("checks/energy/told") != 0;
    in_a_row       = archive.integer("checks/energy/steps_in_a_row");
    share_at_first = archive.number("checks/energy/share_at_first");
    starts_anew    = archive.integer("checks/energy/starts_anew") != 0;
    total          = 0;
  }
} // namespace moraine
