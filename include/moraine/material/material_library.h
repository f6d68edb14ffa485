// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_library_h
#define moraine_material_material_library_h

#include <moraine/material/material_input.h>

#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /** The models that scenes can name. */
  const std::vector<MaterialModel> &
  material_models();

  /**
   * The material of a section.
   *
   * @param parameters its keys
   * @param section of messages, as "Materials/clay"
   * @param place where it is; softening is that of the table while the cell
   * size is not known
   * @throws InputError naming the section for values a material cannot have,
   * and for keys of other models.
   */
  std::shared_ptr<const Material>
  make_material(const MaterialParameters &parameters,
                const std::string        &section,
                const MaterialPlace      &place = {});

  /** `Saturated density` less `Density` [mass/length^dim]; 0 if the first key
   * is left out.
   * @throws InputError naming the section if it weighs less. */
  double
  extra_density_of(const MaterialParameters &parameters,
                   const std::string        &section);
} // namespace moraine

#endif
