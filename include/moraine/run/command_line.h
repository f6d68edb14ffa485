// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_command_line_h
#define moraine_run_command_line_h

#include <string>
#include <vector>

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

  /**
   * The program behind `moraine`: run, resume, check, study, parameters. Errors
   * are shown once, on rank 0, and become the exit code.
   */
  int
  main_program(const std::vector<std::string> &arguments);
} // namespace moraine

#endif
