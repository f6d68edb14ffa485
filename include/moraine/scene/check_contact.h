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
   * Whether the boundary @p name can be a contact, or has keys of one though
   * it is none.
   * @throws InputError for what contradicts.
   */
  template <int dim>
  void
  check_contact(const Scene<dim>                    &scene,
                const std::string                   &name,
                const BoundaryParameters<dim>       &boundary,
                const std::vector<InputFile::Entry> &given);
} // namespace moraine

#endif
