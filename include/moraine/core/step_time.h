// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_step_time_h
#define moraine_core_step_time_h

namespace moraine
{
  /** From when to when a step goes [time]. */
  struct StepTime
  {
    double start = 0; ///< @f$t_n@f$
    double end   = 0; ///< @f$t_{n+1}@f$

    /** @f$\Delta t@f$ */
    double
    size() const
    {
      return end - start;
    }
  };
} // namespace moraine

#endif
