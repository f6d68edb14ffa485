// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/water_parameters.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <deal.II/base/parameter_handler.h>

#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string as_before = "as before";
  }



  std::string
  water_section(const std::string &stage)
  {
    return stage.empty() ? "Water" : "Stages/" + stage + "/Water";
  }



  void
  WaterLevels::add_parameters(ParameterHandler  &prm,
                              const unsigned int dim,
                              const bool         of_stage)
  {
    if (of_stage)
      level = pressure = free_level = as_before;
    const std::string place = dim == 2 ? "x, t" : "x, y, t";
    const std::string stage =
      of_stage ? " as before: that of the stage before, in the first that of "
                 "section 'Water'. none: there is none." :
                 "";
    prm.add_parameter(
      "Level",
      level,
      "Height of the phreatic line, along the last axis: an expression in " +
        place + " [length]. Below it pore pressure is hydrostatic." + stage);
    prm.add_parameter(
      "Pressure",
      pressure,
      std::string("Pore pressure in place of 'Level': an expression in ") +
        (dim == 2 ? "x, y, t" : "x, y, z, t") +
        " [stress, compression positive]. It is zero on the phreatic line, and "
        "negative above." +
        stage);
    prm.add_parameter(
      "Free level",
      free_level,
      "Height to which free water stands outside of the bodies: an expression "
      "in " +
        place +
        " [length]. If left out, the pressure outside is the pore pressure at "
        "the surface, where that is positive." +
        stage);
  }



  void
  WaterLevels::complete(const WaterLevels &before, const std::string &section)
  {
    const bool has_level    = level != as_before && level != "none";
    const bool has_pressure = pressure != as_before && pressure != "none";
    if (has_level && has_pressure)
      reject(section, "Pressure", pressure, "nothing beside key 'Level'");
    const auto take = [](const bool         other_is_given,
                         const std::string &from_before,
                         std::string       &text) {
      if (text == "none" || (text == as_before && other_is_given))
        text.clear();
      else if (text == as_before)
        text = from_before;
    };
    take(has_pressure, before.level, level);
    take(has_level, before.pressure, pressure);
    // Where the bodies have no water any more, there is none around them.
    take(!any(), before.free_level, free_level);
  }



  void
  WaterLevels::check(const std::string &section, const unsigned int dim) const
  {
    if (!level.empty() && !pressure.empty())
      reject(section, "Pressure", pressure, "nothing beside key 'Level'");
    if (!free_level.empty() && !any())
      reject(section,
             "Free level",
             free_level,
             "nothing without key 'Level' or 'Pressure'; 'Pressure = 0' where "
             "bodies are dry inside");
    const std::string height = dim == 2 ? "y" : "z";
    for (const auto &[key, text] : {std::make_pair("Level", level),
                                    std::make_pair("Free level", free_level)})
      if (has_name(text, {height}))
        reject(section,
               key,
               text,
               "an expression without " + height + ", a height");
  }



  void
  WaterParameters::add_parameters(ParameterHandler &prm, const unsigned int dim)
  {
    levels.add_parameters(prm, dim, /* of_stage = */ false);
    prm.add_parameter(
      "Suction",
      suction,
      "What becomes of negative pore pressures: 'cut off' at zero, or 'kept'. "
      "Kept suction adds strength above the phreatic line.",
      patterns::selection({"cut off", "kept"}));
    prm.add_parameter("Unit weight",
                      unit_weight,
                      "Of water, a force per volume in the units of the scene; "
                      "needed with 'Level' and with 'Free level'.",
                      patterns::non_negative());
    prm.add_parameter("Curve",
                      curve,
                      "Factor of all pressures: an expression in t, or a table "
                      "'t: value, t: value, ...'. That of the weight, where "
                      "this grows from zero. 1 if left out.");
  }
} // namespace moraine
