// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_tests_core_message_h
#define moraine_tests_core_message_h

#include <exception>
#include <string>

/** What the exception of type @p E thrown by @p f says; "" if none is. */
template <typename E, typename F>
std::string
message_of(const F &f)
{
  try
    {
      f();
    }
  catch (const E &e)
    {
      return e.what();
    }
  return "";
}

#endif
