// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/strength_reduction.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>
#include <moraine/material/succession.h>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string section = "Strength reduction";
  } // namespace



  void
  StrengthReductionParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Factor",
      factor,
      "The shear strength of the materials is divided by it, from the start "
      "of 'Stage' on: with von Mises the yield stress at every plastic strain.",
      patterns::positive());
    prm.add_parameter("Materials",
                      materials,
                      "Names of the materials whose strength is divided, "
                      "separated by commas; all that have one if left out.");
    prm.add_parameter("Stage",
                      stage,
                      "Name of the stage at whose start strength is divided; "
                      "before the first step if left out.");
    prm.add_parameter("Excess pressure",
                      excess_pressure,
                      "Of undrained materials from 'Stage' on. undrained: it "
                      "changes with the volume, so that soil that would dilate "
                      "sucks itself together. frozen: it stays as it is when "
                      "'Stage' starts.",
                      patterns::selection({"undrained", "frozen"}));
    prm.add_parameter(
      "Lower factor",
      lower_factor,
      "Of 'moraine study' with 'Kind = factor of safety': a factor at which the "
      "scene finds equilibrium up to its end time. At small strain its points "
      "stay where they are unless 'Mesh after step' says otherwise.",
      patterns::positive());
    prm.add_parameter("Upper factor",
                      upper_factor,
                      "Of 'moraine study' with 'Kind = factor of safety': one "
                      "at which it does not.",
                      patterns::positive());
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Of 'moraine study' with 'Kind = factor of safety': the "
                      "interval between both is halved until it is no longer "
                      "than this.",
                      patterns::positive());
  }



  void
  StrengthReductionParameters::find_start(const NamedStages &stages)
  {
    std::vector<std::string> names;
    for (const auto &[name, parameters] : stages)
      {
        names.push_back(name);
        if (!name.empty() && name == stage)
          start = parameters.time.start_time;
      }
    if (!stage.empty() && !start)
      reject(section,
             "Stage",
             stage,
             "names of section 'Stages'" + suggest(stage, names));
    if (stage.empty() && excess_pressure == "frozen")
      reject(section,
             "Excess pressure",
             excess_pressure,
             "undrained, or a 'Stage'; before the first step there is no "
             "excess pressure");
  }



  void
  StrengthReductionParameters::check(
    const std::vector<std::pair<std::string, MaterialParameters>> &all,
    const bool searches) const
  {
    std::vector<std::string> names, with_strength;
    bool                     any_undrained = false;
    for (const auto &[name, parameters] : all)
      {
        names.push_back(name);
        const auto material = make_material(parameters, "Materials/" + name);
        if (material->with_strength_over(factor))
          with_strength.push_back(name);
        any_undrained = any_undrained || material->with_frozen_water(0);
      }
    if (excess_pressure == "frozen" && !any_undrained)
      reject(section,
             "Excess pressure",
             excess_pressure,
             "undrained; no material has 'Drainage = undrained'");
    for (const std::string &name : materials)
      {
        if (!contains(names, name))
          reject(section,
                 "Materials",
                 name,
                 "names of materials" + suggest(name, names));
        if (!contains(with_strength, name))
          reject(section,
                 "Materials",
                 name,
                 "materials that have a shear strength: " +
                   list_of(with_strength));
      }
    if (with_strength.empty() && (searches || factor != 1))
      throw InputError(
        searches ? place("Study", "Kind") +
                     ": found 'factor of safety', allowed: only with a "
                     "material that has a shear strength" :
                   place(section, "Factor") + ": found '" + text_of(factor) +
                     "', allowed: 1; no material has a shear strength");
    if (!(upper_factor > lower_factor))
      reject(section,
             "Upper factor",
             text_of(upper_factor),
             "a number above 'Lower factor', " + text_of(lower_factor));
  }



  std::shared_ptr<const Material>
  StrengthReductionParameters::reduced(
    const std::string                     &name,
    const std::shared_ptr<const Material> &material) const
  {
    const bool is_meant = materials.empty() || contains(materials, name);
    const auto weaker =
      factor != 1 && is_meant ? material->with_strength_over(factor) : nullptr;
    auto result = weaker ? weaker : material;
    if (start && excess_pressure == "frozen")
      if (const auto frozen = result->with_frozen_water(*start))
        result = frozen;
    if (start && weaker)
      return std::make_shared<Succession>(material, result, *start);
    return result;
  }
} // namespace moraine
