// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/renamed_keys.h>

#include <moraine/core/exceptions.h>

#include <string>

namespace moraine
{
  namespace
  {
    /** What a key was called, or one of its values. */
    struct OldName
    {
      const char *section; ///< the first word of its path
      const char *key;
      const char *value; ///< empty: the key itself has another name
      const char *now;
    };

    constexpr OldName old_names[] = {
      {"Boundaries",
       "Carry reaction",
       "",
       "'Enforcement = augmented Lagrangian' carries it, 'weighted' and "
       "'penalty' do not"},
      {"Solver", "Limit points", "jump", "'pseudo-transient'"},
      {"Method", "Put back", "", "'Return tolerance'"},
      {"Method", "Empty stiffness", "", "'Fictitious stiffness'"}};
  } // namespace



  void
  refuse_old_names(const InputFile &input)
  {
    for (const auto &entry : input.entries())
      for (const OldName &old : old_names)
        {
          const std::string value = old.value;
          if (entry.key == old.key &&
              entry.section.substr(0, entry.section.find('/')) == old.section &&
              (value.empty() || entry.value == value))
            throw InputError(entry.origin + ": section '" + entry.section +
                             "', key '" + entry.key + "': " +
                             (value.empty() ? "the key" : "'" + value + "'") +
                             " has another name now: " + old.now);
        }
  }
} // namespace moraine
