// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_initial_stress_parameters_h
#define moraine_scene_initial_stress_parameters_h

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** Keys of the initial stress in section `Bodies/<name>`. */
  struct InitialStressParameters
  {
    /** Expressions, "geostatic", or nothing. */
    std::string stress;
    std::string K0;
    std::string surcharge;

    void
    add_parameters(dealii::ParameterHandler &prm, const unsigned int dim);

    bool
    geostatic() const
    {
      return stress == "geostatic";
    }

    /** @throw InputError for keys of geostatic stress in section @p section
     * where it is not. */
    void
    check(const std::string &section) const;
  };
} // namespace moraine

#endif
