// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_parameter_reference_h
#define moraine_scene_parameter_reference_h

#include <ostream>

namespace moraine
{
  /**
   * Write every parameter of a scene as Markdown: a table for each section with
   * key, default, what is allowed, and its text with unit.
   */
  void
  print_parameter_reference(std::ostream &out);
} // namespace moraine

#endif
