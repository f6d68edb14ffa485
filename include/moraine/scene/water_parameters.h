// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_water_parameters_h
#define moraine_scene_water_parameters_h

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** Where the water stands: expressions, or nothing. */
  struct WaterLevels
  {
    std::string level, pressure, free_level;

    /** In the section of a stage they are as before, unless it says so. */
    void
    add_parameters(dealii::ParameterHandler &prm,
                   const unsigned int        dim,
                   const bool                of_stage);

    /** Whether there is any. */
    bool
    any() const
    {
      return !level.empty() || !pressure.empty();
    }

    /** Whether pressures on both sides of a surface can differ. */
    bool
    differs_outside(const std::string &suction) const
    {
      return any() && (!free_level.empty() || suction == "kept");
    }

    /** Take from the stage before what this one says nothing of. @p section is
     * that of a message. @throw InputError for both a level and a pressure. */
    void
    complete(const WaterLevels &before, const std::string &section);

    /** @throw InputError for both a level and a pressure, or a free level
     * alone. */
    void
    check(const std::string &section, const unsigned int dim) const;
  };

  /** The section with the keys of a stage's water. */
  std::string
  water_section(const std::string &stage);

  /** Section `Water`. */
  struct WaterParameters
  {
    WaterLevels levels;
    std::string suction     = "cut off";
    double      unit_weight = 0;
    std::string curve;

    void
    add_parameters(dealii::ParameterHandler &prm, const unsigned int dim);
  };
} // namespace moraine

#endif
