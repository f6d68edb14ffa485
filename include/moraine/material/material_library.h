// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_library_h
#define moraine_material_material_library_h

#include <moraine/material/material.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace moraine
{
  /** Section `Materials/<name>`. */
  struct MaterialParameters
  {
    std::string model         = "linear elastic";
    double      young_modulus = 0;
    double      poisson_ratio = 0;
    double      density       = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /**
   * The material of a section.
   *
   * @throws InputError naming the section for values a material cannot have.
   */
  std::shared_ptr<const Material>
  make_material(const MaterialParameters &parameters,
                const std::string        &section);
} // namespace moraine

#endif
