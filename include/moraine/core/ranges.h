// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_ranges_h
#define moraine_core_ranges_h

#include <algorithm>
#include <iterator>

namespace moraine
{
  /** std::any_of() of a whole list. */
  template <class List, class Condition>
  bool
  any_of(const List &list, const Condition &holds)
  {
    return std::any_of(std::begin(list), std::end(list), holds);
  }

  template <class List, class Condition>
  bool
  all_of(const List &list, const Condition &holds)
  {
    return std::all_of(std::begin(list), std::end(list), holds);
  }

  template <class List, class Condition>
  bool
  none_of(const List &list, const Condition &holds)
  {
    return !any_of(list, holds);
  }
} // namespace moraine

#endif
