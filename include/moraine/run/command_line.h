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
   * The program behind `moraine`: run, check, study, parameters. Errors are
   * shown once, on rank 0, and become the exit code.
   */
  int
  main_program(const std::vector<std::string> &arguments);
} // namespace moraine

#endif
