// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_finding_h
#define moraine_core_finding_h

#include <string>

namespace moraine
{
  /** A finding of a diagnostic. */
  struct Finding
  {
    std::string id;     ///< of the diagnostic, in kebab-case
    std::string object; ///< body, boundary, load ...; "" for the whole scene
    double      value = 0;
    double      limit = 0; ///< that the value exceeds
    std::string text;      ///< one sentence: what it is and what to do
    double      t = 0;     ///< time of the run
  };
} // namespace moraine

#endif
