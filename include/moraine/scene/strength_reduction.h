// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_strength_reduction_h
#define moraine_scene_strength_reduction_h

#include <moraine/material/material_library.h>
#include <moraine/scene/stage_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** Section `Strength reduction`. */
  struct StrengthReductionParameters
  {
    /** By which a run divides the strength. */
    double factor = 1;
    /** Names of the materials; none: all that have a strength. */
    std::vector<std::string> materials;
    /** From the start of which on; from the first step on if empty. */
    std::string stage;
    /** Of undrained materials from then on: "undrained" or "frozen". */
    std::string excess_pressure = "undrained";

    /** Between which a study looks for the factor of safety. */
    double lower_factor = 1;
    double upper_factor = 2;
    /** Of the factor that it finds. */
    double tolerance = 0.01;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** Find when `Stage` starts. @throws InputError if it is not there. */
    void
    find_start(const NamedStages &stages);

    /**
     * @param all the materials of the scene
     * @param searches whether a study looks for the factor of safety
     * @throws InputError for names that are not there or have no strength, for
     * bounds in the wrong order, and if there is no strength to divide.
     */
    void
    check(const std::vector<std::pair<std::string, MaterialParameters>> &all,
          const bool searches) const;

    /** What becomes of the material @p name. */
    std::shared_ptr<const Material>
    reduced(const std::string                     &name,
            const std::shared_ptr<const Material> &material) const;

  private:
    std::optional<double> start; ///< of `Stage`
  };
} // namespace moraine

#endif
