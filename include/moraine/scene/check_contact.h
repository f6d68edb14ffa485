// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_check_contact_h
#define moraine_scene_check_contact_h

#include <moraine/core/input_file.h>
#include <moraine/scene/scene.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Check the keys of the boundary @p name against its constraint.
   * @throws InputError for keys that contradict each other.
   */
  template <int dim>
  void
  check_contact(const Scene<dim>                    &scene,
                const std::string                   &name,
                const BoundaryParameters<dim>       &boundary,
                const std::vector<InputFile::Entry> &given);
} // namespace moraine

#endif
