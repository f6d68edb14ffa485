// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_study_parameters_h
#define moraine_scene_study_parameters_h

#include <moraine/core/input_file.h>
#include <moraine/scene/material_test_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** Section `Study`; a run does not look at it. */
  struct StudyParameters
  {
    std::string kind = "errors";
    std::string error;
    std::string reference_value;
    std::string group_by;
    std::string panels;
    std::string title;
    /** Settings of section `Study/Series/<name>`. */
    std::vector<std::pair<std::string, std::string>> series;
    /** Section `Material test`, declared apart. */
    MaterialTestParameters material_test;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** Whether it is one by find_factor_of_safety(). */
    bool
    finds_factor_of_safety() const
    {
      return kind == "factor of safety";
    }

    /** @throws InputError for keys in @p given that its kind has no use for. */
    void
    check(const std::vector<InputFile::Entry> &given) const;
  };
} // namespace moraine

#endif
