// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_named_value_h
#define moraine_output_named_value_h

#include <string>

namespace moraine
{
  /** A number for people: what it is, its unit ("length"), its value. */
  struct NamedValue
  {
    std::string name;
    std::string unit;
    double      value;
  };
} // namespace moraine

#endif
