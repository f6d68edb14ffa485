// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/skipped_tables.h>

#include <moraine/core/expression.h>
#include <moraine/core/words.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  namespace
  {
    /** A row of @p curve that steps of size @p dt from @p start pass over by
     * more than half of its range, in words; or "". */
    std::string
    row_between_steps(const TimeCurve &curve,
                      const double     start,
                      const double     end,
                      const double     dt)
    {
      double low = curve.value(start), high = low;
      for (const auto &row : curve.rows())
        {
          low  = std::min(low, row.second);
          high = std::max(high, row.second);
        }
      for (const auto &[t, value] : curve.rows())
        {
          if (!(t > start && t < end))
            continue;
          const double before = start + dt * std::floor((t - start) / dt);
          const double a      = curve.value(before);
          const double b      = curve.value(std::min(before + dt, end));
          if (std::max(value - std::max(a, b), std::min(a, b) - value) >
              0.5 * (high - low))
            {
              std::ostringstream text;
              text << "its table has " << value << " at t = " << t
                   << ", but the steps about it end where it has " << a
                   << " and " << b << "; more 'Steps' in section 'Time'";
              return text.str();
            }
        }
      return "";
    }
  } // namespace



  template <int dim>
  void
  tell_of_skipped_tables(const Scene<dim>         &scene,
                         const StageParameters    &stage,
                         std::vector<std::string> &notes)
  {
    const auto check = [&](const std::string &name, const std::string &text) {
      if (text.empty())
        return;
      const TimeParameters &time = stage.time;
      const std::string     row =
        row_between_steps(TimeCurve(text, name),
                          time.start_time,
                          time.end_time,
                          time.largest_step *
                            (time.end_time - time.start_time) / time.n_steps);
      if (!row.empty())
        notes.push_back(name + ": " + row + " would see it");
    };
    for (const auto &[name, load] : scene.loads)
      if (contains(stage.loads, name))
        check("load " + name, load.curve);
    for (const auto &[name, boundary] : scene.boundaries)
      if (contains(stage.boundaries, name))
        check("wave at " + name, boundary.absorbing.incident_curve);
  }



  template void
  tell_of_skipped_tables(const Scene<2> &,
                         const StageParameters &,
                         std::vector<std::string> &);
  template void
  tell_of_skipped_tables(const Scene<3> &,
                         const StageParameters &,
                         std::vector<std::string> &);
} // namespace moraine
