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

    /** Of a cell: a slide, not a jerk. */
    constexpr double least_slide = 0.02;

    /** Steps of a stage before one can be told to be faster. */
    constexpr unsigned int least_steps = 3;
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
  }



  std::string
  SlideWatch::look(const double t, const double motion, const bool counts)
  {
    const double rate = motion / std::abs(t - last);
    last              = t;
    if (!yields || told || !counts)
      return "";
    const double before = fastest;
    fastest             = std::max(fastest, rate);
    if (n_steps++ < least_steps || !(rate > told_ratio * before) ||
        !(motion > least_slide * cell_size))
      return "";
    told = true;
    std::ostringstream text;
    text << std::setprecision(6) << "in the step to t = " << t
         << " material moves by " << std::setprecision(3) << motion << ", "
         << std::setprecision(2) << rate / before
         << " times as fast as in any step before: unless a load or a motion "
            "jumps there, it does not stand but slides, a limit load is "
            "passed, and what follows is another shape; 'Mesh after step = "
            "keep' in section 'Method' and 'moraine study' with 'Kind = "
            "factor of safety' find the limit";
    return text.str();
  }



  void
  SlideWatch::write(Archive &archive) const
  {
    archive.write("checks/slides/last", last, "time");
    archive.write("checks/slides/fastest", fastest, "length/time");
    archive.write("checks/slides/steps", n_steps);
    archive.write("checks/slides/told", told ? 1u : 0u);
  }



  void
  SlideWatch::read(const Archive &archive)
  {
    last    = archive.number("checks/slides/last");
    fastest = archive.number("checks/slides/fastest");
    n_steps = archive.integer("checks/slides/steps");
    told    = archive.integer("checks/slides/told") != 0;
  }
} // namespace moraine
