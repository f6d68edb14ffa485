// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_silent_errors_h
#define moraine_core_silent_errors_h

#include <iostream>

namespace moraine
{
  /**
   * While one lives, nothing reaches std::cerr. For libraries that write to the
   * terminal what we report ourselves.
   */
  class SilentErrors
  {
  public:
    SilentErrors()
      : buffer(std::cerr.rdbuf(nullptr))
    {}

    ~SilentErrors()
    {
      std::cerr.rdbuf(buffer);
    }

    SilentErrors(const SilentErrors &) = delete;

    SilentErrors &
    operator=(const SilentErrors &) = delete;

  private:
    std::streambuf *const buffer;
  };
} // namespace moraine

#endif
