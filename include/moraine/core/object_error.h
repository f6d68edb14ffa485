// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_object_error_h
#define moraine_core_object_error_h

#include <moraine/core/exceptions.h>

#include <string>

namespace moraine
{
  /**
   * A mistake in the input that shows in an object which does not know what the
   * input calls it. The message names the object, "load 'weight': found ...";
   * the room run puts the section before it.
   */
  class ObjectError : public InputError
  {
  public:
    ObjectError(const std::string &kind,
                const std::string &name,
                const std::string &text)
      : InputError(kind + (name.empty() ? "" : " '" + name + "'") + ": " + text)
      , kind(kind)
      , name(name)
      , text(text)
    {}

    /** What kind of object; in the plural, without name, of several. */
    const std::string kind;
    const std::string name;
    /** What was found and what is allowed. */
    const std::string text;
  };
} // namespace moraine

#endif
