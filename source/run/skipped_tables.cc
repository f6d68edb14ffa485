// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/skipped_tables.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/words.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace moraine
{
  namespace
  {
    /** A row of @p curve that steps of size @p dt from @p start pass over by
     * more than a tenth of its largest change since then, in words; or "". */
    std::string
    row_between_steps(const TimeCurve &curve,
                      const double     start,
                      const double     end,
                      const double     dt)
    {
      double largest = 0;
      for (const auto &row : curve.rows())
        largest = std::max(largest, std::abs(row.second - curve.value(start)));
      for (const auto &[t, value] : curve.rows())
        {
          if (!(t > start && t < end))
            continue;
          const double before = start + dt * std::floor((t - start) / dt);
          const double a      = curve.value(before);
          const double b      = curve.value(std::min(before + dt, end));
          if (std::max(value - std::max(a, b), std::min(a, b) - value) >
              0.1 * largest)
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



    /** Of steps as they are planned: the first that turns by half a circle or
     * more, which only its two ends cannot tell from less, in words; or "". */
    std::string
    turn_of_a_step(const TimeCurve   &angle,
                   const double       start,
                   const double       end,
                   const unsigned int n_steps)
    {
      const double dt = (end - start) / n_steps;
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          const double t    = start + step * dt;
          const double turn = angle.value(t + dt) - angle.value(t);
          if (std::abs(turn) < 180)
            continue;
          std::ostringstream text;
          text << "the step from t = " << t << " to " << t + dt
               << " turns it by " << turn
               << " degrees, of which it sees half a circle at most";
          return text.str();
        }
      return "";
    }



    /** Whether a curve has one value in all stages of which @p acts is true, at
     * the ends of steps as they are planned and in rows; and this value. */
    template <int dim, typename Acts>
    std::optional<double>
    constant_value(const TimeCurve  &curve,
                   const Scene<dim> &scene,
                   const Acts       &acts)
    {
      std::optional<double> first;
      const auto            differs = [&first](const double value) {
        if (!first)
          first = value;
        return value != *first;
      };
      for (const auto &[name, stage] : scene.stages)
        {
          if (!acts(stage))
            continue;
          const TimeParameters &time = stage.time;
          const double size = (time.end_time - time.start_time) / time.n_steps;
          for (unsigned int step = 0; step <= time.n_steps; ++step)
            if (differs(curve.value(time.start_time + step * size)))
              return {};
          for (const auto &[t, value] : curve.rows())
            if (t > time.start_time && t < time.end_time && differs(value))
              return {};
        }
      return first;
    }



    /** The curves of the translation, if there is one. */
    template <int dim>
    std::vector<TimeCurve>
    translations(const MotionParameters<dim> &motion,
                 const std::string           &section)
    {
      if (motion.translation.empty())
        return {};
      return time_curves(motion.translation,
                         place(section, "Translation"),
                         dim);
    }



    /** What does nothing though it has a value. */
    template <int dim>
    void
    tell_of_constants(const Scene<dim> &scene, std::vector<std::string> &notes)
    {
      for (const auto &named : scene.loads)
        if (const auto &[name, load] = named; !load.curve.empty())
          if (constant_value(TimeCurve(load.curve,
                                       place("Loads/" + name, "Curve")),
                             scene,
                             [&](const StageParameters &stage) {
                               return contains(stage.loads, named.first);
                             }) == 0.)
            notes.push_back("load " + name +
                            ": its 'Curve' is 0 as long as it acts");
      const auto check = [&](const std::string           &kind,
                             const std::string           &name,
                             const MotionParameters<dim> &motion,
                             const auto                  &acts,
                             const std::string           &what) {
        const std::string      section = kind + '/' + name;
        std::vector<TimeCurve> curves  = translations(motion, section);
        if (!motion.rotation_angle.empty())
          curves.emplace_back(motion.rotation_angle,
                              place(section, "Rotation angle"));
        bool is_zero = true;
        for (const TimeCurve &curve : curves)
          {
            const auto value = constant_value(curve, scene, acts);
            if (!value)
              return;
            is_zero = is_zero && *value == 0;
          }
        if (!is_zero)
          notes.push_back(name +
                          ": its motion stays the same as long as it acts, and "
                          "only what changes over time moves " +
                          what + "; -0.1*t reaches -0.1 at t = 1");
      };
      // An angle alone places a surface, and so does a motion before it begins.
      for (const auto &named : scene.boundaries)
        if (!named.second.motion.translation.empty() &&
            contains(scene.stages.front().second.boundaries, named.first))
          check(
            "Boundaries",
            named.first,
            named.second.motion,
            [&](const StageParameters &stage) {
              return contains(stage.boundaries, named.first);
            },
            "material; it places the surface");
      for (const auto &named : scene.grid_conditions)
        check(
          "Grid conditions",
          named.first,
          named.second.motion,
          [&](const StageParameters &stage) {
            return contains(stage.grid_conditions, named.first);
          },
          "nodes");
    }
  } // namespace



  template <int dim>
  void
  tell_of_skipped_tables(const Scene<dim>         &scene,
                         const StageParameters    &stage,
                         std::vector<std::string> &notes)
  {
    if (&stage == &scene.stages.front().second)
      tell_of_constants(scene, notes);
    const TimeParameters &time = stage.time;
    const auto check = [&](const std::string &name, const TimeCurve &curve) {
      const std::string row =
        row_between_steps(curve,
                          time.start_time,
                          time.end_time,
                          time.largest_step *
                            (time.end_time - time.start_time) / time.n_steps);
      if (!row.empty())
        notes.push_back(name + ": " + row + " would see it");
    };
    const auto check_text = [&](const std::string &name,
                                const std::string &text,
                                const std::string &origin) {
      if (!text.empty())
        check(name, TimeCurve(text, origin));
    };
    const auto check_motion = [&](const std::string           &section,
                                  const std::string           &name,
                                  const MotionParameters<dim> &motion) {
      for (const TimeCurve &curve : translations(motion, section))
        check("'Translation' of " + name, curve);
      if (motion.rotation_angle.empty())
        return;
      const std::string rotation = "'Rotation angle' of " + name;
      const TimeCurve   angle(motion.rotation_angle,
                            place(section, "Rotation angle"));
      check(rotation, angle);
      const std::string turn =
        turn_of_a_step(angle, time.start_time, time.end_time, time.n_steps);
      if (!turn.empty())
        notes.push_back(rotation + ": " + turn +
                        "; more 'Steps' in section 'Time' would see it");
    };
    for (const auto &[name, load] : scene.loads)
      if (contains(stage.loads, name))
        check_text("load " + name, load.curve, place("Loads/" + name, "Curve"));
    for (const auto &[name, boundary] : scene.boundaries)
      if (contains(stage.boundaries, name))
        {
          const std::string section = "Boundaries/" + name;
          check_text("wave at " + name,
                     boundary.absorbing.incident_curve,
                     place(section, "Incident curve"));
          check_motion(section, name, boundary.motion);
        }
    for (const auto &[name, condition] : scene.grid_conditions)
      if (contains(stage.grid_conditions, name))
        check_motion("Grid conditions/" + name, name, condition.motion);
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
