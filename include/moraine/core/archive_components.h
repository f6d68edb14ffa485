// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_archive_components_h
#define moraine_core_archive_components_h

#include <algorithm>
#include <functional>
#include <type_traits>
#include <vector>

namespace moraine
{
  /** Selects the whole object for a row of an Archive. */
  struct WholeObject
  {
    template <class Object>
    Object &
    operator()(Object &object) const
    {
      return object;
    }
  };

  /** The components of numbers or tensors one after the other, as an Archive
   * holds them: of each object, or of a member of it. */
  template <class Object, class Member = WholeObject>
  std::vector<double>
  components_of(const std::vector<Object> &objects, const Member &member = {})
  {
    std::vector<double> components;
    for (const Object &object : objects)
      {
        const auto &value = std::invoke(member, object);
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
          components.push_back(value);
        else
          components.insert(components.end(),
                            value.begin_raw(),
                            value.end_raw());
      }
    return components;
  }

  /** Give as many objects the components that components_of() wrote. */
  template <class Object, class Member = WholeObject>
  void
  set_components(const std::vector<double> &components,
                 std::vector<Object>       &objects,
                 const Member              &member = {})
  {
    auto next = components.begin();
    for (Object &object : objects)
      {
        auto &value = std::invoke(member, object);
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
          value = *next++;
        else
          for (double *to = value.begin_raw(); to != value.end_raw(); ++to)
            *to = *next++;
      }
  }
} // namespace moraine

#endif
