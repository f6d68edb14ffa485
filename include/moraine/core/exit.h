// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_exit_h
#define moraine_core_exit_h

#include <string>

namespace moraine
{
  /** What the program returns. */
  enum ExitCode
  {
    done           = 0,
    not_converged  = 1,
    wrong_input    = 2,
    internal_error = 3
  };

  /**
   * To be called where a failure is caught, before any object that others share
   * is destroyed: if not every rank fails within some seconds, say what
   * happened and end the program on all of them. A rank that failed alone and
   * went on would wait for the others for ever.
   */
  void
  end_if_alone(const ExitCode code, const std::string &what);

  /** Let end_if_alone() work from here on. Collective. */
  void
  prepare_exit();
} // namespace moraine

#endif
