// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_command_line_h
#define moraine_study_command_line_h

#include <string>
#include <vector>

namespace moraine
{
  /**
   * The program behind `moraine`: run, resume, check, study, test-material,
   * parameters. Errors are shown once, on rank 0, and become the exit code.
   */
  int
  main_program(const std::vector<std::string> &arguments);
} // namespace moraine

#endif
