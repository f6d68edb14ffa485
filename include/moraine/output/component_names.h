// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_component_names_h
#define moraine_output_component_names_h

#include <string>

namespace moraine
{
  /** "x", "y" or "z". */
  inline std::string
  direction_name(const unsigned int direction)
  {
    return std::string(1, "xyz"[direction]);
  }

  /** "xx", "yy", ... in the order in which a stress is stored. */
  inline std::string
  stress_component_name(const unsigned int component)
  {
    constexpr const char *names[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
    return names[component];
  }
} // namespace moraine

#endif
