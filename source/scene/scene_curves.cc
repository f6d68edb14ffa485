// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/scene_curves.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/words.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace moraine
{
  namespace
  {
    /** A curve of time, and the stages in which it acts. */
    struct ActingCurve
    {
      enum class Kind
      {
        load,
        translation,
        angle,
        wave
      };

      /** Of a stage: the names of what acts. */
      using Names = std::vector<std::string> StageParameters::*;

      std::string name;
      Kind        kind;
      bool        at_nodes; ///< of the mesh
      TimeCurve   curve;
      Names       acting;

      bool
      acts_in(const StageParameters &stage) const
      {
        return contains(stage.*acting, name);
      }
    };



    template <int dim>
    void
    add_motion(const std::string           &kind,
               const std::string           &name,
               const MotionParameters<dim> &motion,
               const bool                   at_nodes,
               const ActingCurve::Names     stages,
               std::vector<ActingCurve>    &curves)
    {
      using Kind                = ActingCurve::Kind;
      const std::string section = kind + '/' + name;
      if (!motion.translation.empty())
        for (const TimeCurve &curve : time_curves(motion.translation,
                                                  place(section, "Translation"),
                                                  dim))
          curves.push_back({name, Kind::translation, at_nodes, curve, stages});
      if (!motion.rotation_angle.empty())
        curves.push_back(
          {name,
           Kind::angle,
           at_nodes,
           TimeCurve(motion.rotation_angle, place(section, "Rotation angle")),
           stages});
    }



    template <int dim>
    std::vector<ActingCurve>
    acting_curves(const Scene<dim> &scene)
    {
      using Kind = ActingCurve::Kind;
      std::vector<ActingCurve> curves;
      for (const auto &[name, load] : scene.loads)
        if (!load.curve.empty())
          curves.push_back(
            {name,
             Kind::load,
             false,
             TimeCurve(load.curve, place("Loads/" + name, "Curve")),
             &StageParameters::loads});
      for (const auto &[name, boundary] : scene.boundaries)
        {
          if (!boundary.absorbing.incident_curve.empty())
            curves.push_back(
              {name,
               Kind::wave,
               false,
               TimeCurve(boundary.absorbing.incident_curve,
                         place("Boundaries/" + name, "Incident curve")),
               &StageParameters::boundaries});
          add_motion("Boundaries",
                     name,
                     boundary.motion,
                     false,
                     &StageParameters::boundaries,
                     curves);
        }
      for (const auto &[name, condition] : scene.grid_conditions)
        add_motion("Grid conditions",
                   name,
                   condition.motion,
                   true,
                   &StageParameters::grid_conditions,
                   curves);
      return curves;
    }



    /** Rows at which the slope of a table changes. */
    std::vector<double>
    kinks_of(const TimeCurve &curve)
    {
      constexpr double    round_off = 1e-9;
      const auto         &rows      = curve.rows();
      std::vector<double> kinks;
      double              largest = 0;
      for (const auto &row : rows)
        largest = std::max(largest, std::abs(row.second));
      for (unsigned int k = 0; k < rows.size(); ++k)
        {
          const bool inside = k > 0 && k + 1 < rows.size();
          if (inside)
            {
              const double share = (rows[k].first - rows[k - 1].first) /
                                   (rows[k + 1].first - rows[k - 1].first);
              const double linear =
                (1 - share) * rows[k - 1].second + share * rows[k + 1].second;
              if (std::abs(rows[k].second - linear) <= round_off * largest)
                continue;
            }
          kinks.push_back(rows[k].first);
        }
      return kinks;
    }



    /** Times that divide planned steps so that each turns by less than half a
     * circle. */
    void
    divide_turns(const TimeCurve      &angle,
                 const TimeParameters &time,
                 std::vector<double>  &asked)
    {
      constexpr double largest_turn = 150; // degrees
      const double     dt = (time.end_time - time.start_time) / time.n_steps;
      for (unsigned int step = 0; step < time.n_steps; ++step)
        {
          const double t    = time.start_time + step * dt;
          const double turn = std::abs(angle.value(t + dt) - angle.value(t));
          if (turn < 180)
            continue;
          const unsigned int n = std::ceil(turn / largest_turn);
          for (unsigned int k = 1; k < n; ++k)
            asked.push_back(t + k * dt / n);
        }
    }



    /** The value of a curve that has one value in all stages in which it acts,
     * at the ends of planned steps and in rows. */
    std::optional<double>
    constant_value(const ActingCurve &acting, const NamedStages &stages)
    {
      std::optional<double> first;
      const auto            differs = [&first](const double value) {
        if (!first)
          first = value;
        return value != *first;
      };
      for (const auto &[name, stage] : stages)
        {
          if (!acting.acts_in(stage))
            continue;
          const TimeParameters &time = stage.time;
          const double size = (time.end_time - time.start_time) / time.n_steps;
          for (unsigned int step = 0; step <= time.n_steps; ++step)
            if (differs(acting.curve.value(time.start_time + step * size)))
              return {};
          for (const auto &[t, value] : acting.curve.rows())
            if (t > time.start_time && t < time.end_time && differs(value))
              return {};
        }
      return first;
    }
  } // namespace



  template <int dim>
  std::vector<double>
  asked_times(const Scene<dim> &scene)
  {
    std::vector<double> asked;
    for (const ActingCurve &acting : acting_curves(scene))
      for (const auto &[name, stage] : scene.stages)
        {
          if (!acting.acts_in(stage) || stage.time.follows_path())
            continue;
          for (const double t : kinks_of(acting.curve))
            if (t > stage.time.start_time && t < stage.time.end_time)
              asked.push_back(t);
          if (acting.kind == ActingCurve::Kind::angle)
            divide_turns(acting.curve, stage.time, asked);
        }
    std::sort(asked.begin(), asked.end());
    return asked;
  }



  template <int dim>
  std::vector<std::string>
  idle_curves(const Scene<dim> &scene)
  {
    std::vector<std::string> idle, moving;
    for (const ActingCurve &acting : acting_curves(scene))
      {
        const auto value = constant_value(acting, scene.stages);
        if (acting.kind == ActingCurve::Kind::load && value == 0.)
          idle.push_back(acting.name);
        if (!acting.at_nodes)
          continue;
        if (!value)
          moving.push_back(acting.name);
        else if (*value != 0 && !contains(idle, acting.name))
          idle.push_back(acting.name);
      }
    idle.erase(std::remove_if(idle.begin(),
                              idle.end(),
                              [&](const std::string &name) {
                                return contains(moving, name);
                              }),
               idle.end());
    return idle;
  }



#define INSTANTIATE(dim)                                             \
  template std::vector<double>      asked_times(const Scene<dim> &); \
  template std::vector<std::string> idle_curves(const Scene<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
