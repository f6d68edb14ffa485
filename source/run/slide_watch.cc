// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/slide_watch.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace moraine
{
  namespace
  {
    /** Over the fastest step before. A load that grows evenly up to the limit
     * makes the last step before it up to three times as fast. */
    constexpr double told_ratio = 5;

    /** Over the fastest step before: what begins to move, as a load begins. */
    constexpr double next_to_none = 1e-4;

    /** Over the fastest step of a slide: it has come to rest. What hardens goes
     * on as fast. */
    constexpr double rests_below = 0.3;

    /** Of a cell: a slide, not a jerk. */
    constexpr double least_slide = 0.02;

    /** Steps of a stage before one can be told to be faster. */
    constexpr unsigned int least_steps = 3;

    /** Steps of a slide that rests but moves faster than all before it: one may
     * be a jerk of a node that hardly any material has. */
    constexpr unsigned int least_fast = 2;

    /** Steps that a slide takes at most. */
    constexpr unsigned int most_fast = 5;
  } // namespace



  SlideWatch::SlideWatch(const bool   yields,
                         const double cell_size,
                         const double start)
    : yields(yields)
    , cell_size(cell_size)
    , last(start)
  {}



  void
  SlideWatch::stage_begins()
  {
    fastest = 0;
    n_steps = 0;
    told    = false;
    forget_slide();
  }



  std::string
  SlideWatch::look(const double t, const double motion, const bool counts)
  {
    const double rate = motion / std::abs(t - last);
    last              = t;
    if (!yields || !counts)
      return "";
    const bool came_to_rest = n_fast > 0 && rate < rests_below * fast_rate;
    // Beyond the limit what rests does not become as slow as before.
    const bool rests_faster = came_to_rest && n_as_fast >= least_fast;
    if (n_steps++ >= least_steps && rate > told_ratio * fastest &&
        fastest > next_to_none * rate && n_fast < most_fast && !rests_faster)
      {
        ++n_fast;
        n_as_fast += came_to_rest ? 0 : 1;
        slid_by += motion;
        if (rate > fast_rate)
          {
            fast_rate = rate;
            fast_time = t;
          }
        return "";
      }
    std::ostringstream text;
    if (came_to_rest && !told && slid_by > least_slide * cell_size)
      {
        told = true;
        text << std::setprecision(6) << "in the step to t = " << fast_time
             << " material has moved " << std::setprecision(2)
             << fast_rate / fastest
             << " times as fast as in any step before, and no longer does: "
                "unless a load or a motion jumps there, it did not stand but "
                "slid, a limit load is passed, and what follows is another "
                "shape. At small strain 'Mesh after step = keep' in section "
                "'Method' and 'moraine study' with 'Kind = factor of safety' "
                "find the limit";
      }
    fastest =
      std::max(fastest, came_to_rest ? rate : std::max(rate, fast_rate));
    forget_slide();
    return text.str();
  }



  void
  SlideWatch::forget_slide()
  {
    n_fast    = 0;
    n_as_fast = 0;
    slid_by   = 0;
    fast_rate = 0;
    fast_time = 0;
  }



  void
  SlideWatch::write(Archive &archive) const
  {
    archive.write("checks/slides/last", last, "time");
    archive.write("checks/slides/fastest", fastest, "length/time");
    archive.write("checks/slides/steps", n_steps);
    archive.write("checks/slides/told", told ? 1u : 0u);
    archive.write("checks/slides/fast_steps", n_fast);
    archive.write("checks/slides/as_fast", n_as_fast);
    archive.write("checks/slides/slid_by", slid_by, "length");
    archive.write("checks/slides/fast_rate", fast_rate, "length/time");
    archive.write("checks/slides/fast_time", fast_time, "time");
  }



  void
  SlideWatch::read(const Archive &archive)
  {
    last      = archive.number("checks/slides/last");
    fastest   = archive.number("checks/slides/fastest");
    n_steps   = archive.integer("checks/slides/steps");
    told      = archive.integer("checks/slides/told") != 0;
    n_fast    = archive.integer("checks/slides/fast_steps");
    n_as_fast = archive.integer("checks/slides/as_fast");
    slid_by   = archive.number("checks/slides/slid_by");
    fast_rate = archive.number("checks/slides/fast_rate");
    fast_time = archive.number("checks/slides/fast_time");
  }
} // namespace moraine
