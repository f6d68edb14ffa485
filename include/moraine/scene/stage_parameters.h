// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_stage_parameters_h
#define moraine_scene_stage_parameters_h

#include <moraine/core/input_file.h>
#include <moraine/material/undrained.h>
#include <moraine/scene/water_parameters.h>
#include <moraine/time/time_control.h>

#include <string>
#include <utility>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** Section `Stages/<name>`: what is active from its start on. */
  struct StageParameters
  {
    TimeParameters time;
    /** Names; as read, also the words "as before" and "none". */
    std::vector<std::string> boundaries{"as before"},
      grid_conditions{"as before"}, loads{"as before"}, bodies{"as before"};
    /** Boundaries and grid conditions that absorb from this stage on. */
    std::vector<std::string> absorbing;
    /** Undrained materials whose water flows; as the lists above. */
    std::vector<std::string> drained{"as before"};
    bool                     reset_displacements = false;
    /** As read, also the words "as before" and "none". */
    WaterLevels water{"as before", "as before", "as before"};

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /** In their order. */
  using NamedStages = std::vector<std::pair<std::string, StageParameters>>;

  /** All names of a scene that stages may list. */
  struct StageNames
  {
    std::vector<std::string> boundaries, grid_conditions, loads;
    /** Without those that others are combined from. */
    std::vector<std::string> bodies;
    /** Materials. */
    std::vector<std::string> undrained;
  };

  /**
   * Give every stage what it left to the one before: its start and its names. A
   * scene without stages gets one without a name, with @p time. @p given: what
   * the scene says that is no default.
   * @throws InputError for names that are not there, stages without bodies,
   * times that go back, and a section 'Time' beside stages.
   */
  void
  complete_stages(const std::vector<InputFile::Entry> &given,
                  const TimeParameters                &time,
                  const StageNames                    &names,
                  NamedStages                         &stages);

  /** Give every stage the water that it left to the one before, the first one
   * that @p of_scene. @throws InputError for what contradicts itself. */
  void
  complete_water(const WaterLevels &of_scene, NamedStages &stages);

  /** When the water of @p material flows. */
  std::vector<DrainedSpan>
  drained_spans(const NamedStages &stages, const std::string &material);

  /** Which bodies come and go, in words: ", with a, without b". */
  std::string
  change_of_bodies(const StageParameters &stage, const StageParameters &before);

  /** The section with the keys of a stage's time. */
  std::string
  time_section(const std::string &stage);
} // namespace moraine

#endif
