// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/stage_parameters.h>

#include <moraine/core/words.h>

#include <deal.II/base/parameter_handler.h>

#include <moraine/core/exceptions.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace moraine
{
  using namespace dealii;

  void
  StageParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Time");
    time.add_parameters(prm);
    prm.leave_subsection();
    const std::string text =
      " that act from this stage on, separated by commas; none or nothing: no "
      "one. as before: those of the stage before, in the first all.";
    prm.add_parameter("Boundaries",
                      boundaries,
                      "Names of the boundaries" + text);
    prm.add_parameter("Grid conditions",
                      grid_conditions,
                      "Names of the grid conditions" + text);
    prm.add_parameter("Loads", loads, "Names of the loads" + text);
    prm.add_parameter(
      "Bodies",
      bodies,
      "Names of the bodies that are there from this stage on. What comes is as "
      "drawn, with its initial stress if it has one; where nodes move with the "
      "material it fills the cells as they are by then. What goes takes its "
      "stress and weight with it. as before: those of the stage before, in the "
      "first all.");
    prm.add_parameter(
      "Absorbing",
      absorbing,
      "Names of boundaries and of grid conditions on sides, active so far, that "
      "absorb waves from this stage on in place of what they did, and hold the "
      "tractions that they had by then.");
    prm.add_parameter(
      "Drained",
      drained,
      "Names of undrained materials whose water flows from this stage on. Their "
      "excess pressure falls to zero over this stage, linearly in time, and "
      "stays there. as before: those of the stage before, in the first none. "
      "What a later stage leaves out is undrained again.");
    prm.add_parameter("Reset displacements",
                      reset_displacements,
                      "Let displacements count from the start of this stage.");
  }



  std::string
  time_section(const std::string &stage)
  {
    return stage.empty() ? "Time" : "Stages/" + stage + "/Time";
  }



  namespace
  {
    /** Counted twice they would be more than there are. */
    void
    refuse_repeated(const std::string              &section,
                    const std::string              &key,
                    const std::vector<std::string> &names)
    {
      for (auto name = names.begin(); name != names.end(); ++name)
        if (std::find(names.begin(), name, *name) != name)
          reject(section, key, list_of(names), "each name once");
    }



    /** Sort @p names as @p all are: another order is no change. */
    void
    put_in_order(const std::vector<std::string> &all,
                 std::vector<std::string>       &names)
    {
      std::vector<std::string> ordered;
      std::copy_if(all.begin(),
                   all.end(),
                   std::back_inserter(ordered),
                   [&names](const std::string &name) {
                     return contains(names, name);
                   });
      names = std::move(ordered);
    }



    /** Whether a key of a stage leaves its names to the stage before. */
    bool
    are_as_before(const std::vector<std::string> &names)
    {
      return names == std::vector<std::string>{"as before"};
    }



    /** The names that are active, by what key @p key of a stage says.
     * @param allowed what they may be, in words */
    void
    complete_names(const std::string              &section,
                   const std::string              &key,
                   const std::string              &allowed,
                   const std::vector<std::string> &all,
                   const std::vector<std::string> &before,
                   std::vector<std::string>       &names)
    {
      if (are_as_before(names))
        names = before;
      else if (names == std::vector<std::string>{"none"})
        names.clear();
      refuse_repeated(section, key, names);
      for (const std::string &name : names)
        if (!contains(all, name))
          reject(section,
                 key,
                 name,
                 allowed + ", or none" + suggest(name, all));
      put_in_order(all, names);
    }



    void
    complete_bodies(const std::string              &section,
                    const std::vector<std::string> &all,
                    const std::vector<std::string> &before,
                    std::vector<std::string>       &names)
    {
      if (are_as_before(names))
        names = before;
      if (names.empty())
        reject(section, "Bodies", "", "at least one body");
      refuse_repeated(section, "Bodies", names);
      for (const std::string &name : names)
        if (!contains(all, name))
          reject(section,
                 "Bodies",
                 name,
                 name == "none" ? "at least one body" :
                                  "names of bodies that no other is combined "
                                  "from" +
                                    suggest(name, all));
      put_in_order(all, names);
    }



    /** @p given: entries that are no defaults. */
    void
    complete_start(const std::vector<InputFile::Entry> &given,
                   const std::string                   &section,
                   const TimeParameters                &before,
                   TimeParameters                      &time)
    {
      for (const auto &entry : given)
        if (entry.section == section && entry.key == "Start time" &&
            time.start_time != before.end_time)
          reject(entry,
                 "nothing, or " + text_of(before.end_time) +
                   ", the end of the stage before; stages follow each other");
      time.start_time = before.end_time;
    }



    /** What the stage names absorbs, and all that absorbs in the stage before;
     * @p before is null in the first. */
    void
    complete_absorbing(const std::string     &name,
                       const StageParameters *before,
                       StageParameters       &stage)
    {
      const std::string        section = "Stages/" + name;
      std::vector<std::string> active  = stage.boundaries;
      active.insert(active.end(),
                    stage.grid_conditions.begin(),
                    stage.grid_conditions.end());
      refuse_repeated(section, "Absorbing", stage.absorbing);
      for (const std::string &boundary : stage.absorbing)
        if (!contains(active, boundary))
          reject(section,
                 "Absorbing",
                 boundary,
                 "names of boundaries and grid conditions that are active" +
                   suggest(boundary, active));
        else if (!stage.time.integrator.dynamic())
          reject(section,
                 "Absorbing",
                 boundary,
                 "nothing; key 'Integrator' of section '" + time_section(name) +
                   "' is 'quasi-static', and only waves are absorbed; it may "
                   "stand in a stage with another 'Integrator', such as "
                   "'Newmark'");
        else if (before && stage.bodies != before->bodies)
          reject(section,
                 "Absorbing",
                 boundary,
                 "nothing where 'Bodies' change; what absorbs holds the forces "
                 "that it had, so let it begin in a stage of its own before "
                 "this one");
      if (before)
        stage.absorbing.insert(stage.absorbing.begin(),
                               before->absorbing.begin(),
                               before->absorbing.end());
    }



    void
    complete_drained(const std::string              &section,
                     const std::vector<std::string> &undrained,
                     const std::vector<std::string> &before,
                     StageParameters                &stage)
    {
      complete_names(section,
                     "Drained",
                     "materials with 'Drainage = undrained'",
                     undrained,
                     before,
                     stage.drained);
      if (stage.time.follows_path() && stage.drained != before)
        reject(section,
               "Drained",
               list_of(stage.drained),
               "as before; a path ('Arc length') need not reach the end of the "
               "stage, when pressure is gone");
    }
  } // namespace



  std::vector<DrainedSpan>
  drained_spans(const NamedStages &stages, const std::string &material)
  {
    std::vector<DrainedSpan> spans;
    bool                     before = false;
    for (const auto &[name, stage] : stages)
      {
        const double start = stage.time.start_time, end = stage.time.end_time;
        const bool   flows = contains(stage.drained, material);
        if (flows && before)
          spans.back().end = end;
        else if (flows)
          spans.push_back({start, end, end});
        before = flows;
      }
    return spans;
  }



  std::string
  change_of_bodies(const StageParameters &stage, const StageParameters &before)
  {
    std::string text;
    for (const std::string &body : stage.bodies)
      if (!contains(before.bodies, body))
        text += ", with " + body;
    for (const std::string &body : before.bodies)
      if (!contains(stage.bodies, body))
        text += ", without " + body;
    return text;
  }



  void
  complete_stages(const std::vector<InputFile::Entry> &given,
                  const TimeParameters                &time,
                  const StageNames                    &all,
                  NamedStages                         &stages)
  {
    if (stages.empty())
      {
        stages.emplace_back("", StageParameters());
        stages.front().second = {time,
                                 all.boundaries,
                                 all.grid_conditions,
                                 all.loads,
                                 all.bodies,
                                 {},
                                 {},
                                 false,
                                 {"as before", "as before", "as before"}};
      }
    else
      for (const auto &entry : given)
        if (entry.section == "Time")
          reject(entry,
                 "nothing beside section 'Stages'; each stage has a section "
                 "'Time' of its own");
    for (unsigned int k = 0; k < stages.size(); ++k)
      {
        auto &[name, stage]       = stages[k];
        const std::string section = "Stages/" + name;
        const auto       *before  = k > 0 ? &stages[k - 1].second : nullptr;
        if (before)
          complete_start(given, time_section(name), before->time, stage.time);
        stage.time.check(time_section(name));
        complete_names(section,
                       "Boundaries",
                       "names of section 'Boundaries'",
                       all.boundaries,
                       before ? before->boundaries : all.boundaries,
                       stage.boundaries);
        complete_names(section,
                       "Grid conditions",
                       "names of section 'Grid conditions'",
                       all.grid_conditions,
                       before ? before->grid_conditions : all.grid_conditions,
                       stage.grid_conditions);
        complete_names(section,
                       "Loads",
                       "names of section 'Loads'",
                       all.loads,
                       before ? before->loads : all.loads,
                       stage.loads);
        complete_bodies(section,
                        all.bodies,
                        before ? before->bodies : all.bodies,
                        stage.bodies);
        complete_absorbing(name, before, stage);
        complete_drained(section,
                         all.undrained,
                         before ? before->drained : std::vector<std::string>(),
                         stage);
      }
  }



  void
  complete_water(const WaterLevels &of_scene, NamedStages &stages)
  {
    const WaterLevels *before = &of_scene;
    for (auto &[name, stage] : stages)
      {
        stage.water.complete(*before, water_section(name));
        before = &stage.water;
      }
  }
} // namespace moraine
