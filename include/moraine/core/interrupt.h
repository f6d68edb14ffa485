// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_interrupt_h
#define moraine_core_interrupt_h

#include <mpi.h>

namespace moraine
{
  /**
   * From now on the first Ctrl-C (SIGINT) or SIGTERM only asks to end after the
   * current step, and a second one of its kind ends the program at once.
   * @param announce say so on the terminal; for one rank.
   */
  void
  install_interrupt_handler(const bool announce);

  /**
   * Whether any rank was asked to end. All ranks must call it and get the same
   * answer.
   */
  bool
  interrupted(const MPI_Comm communicator);
} // namespace moraine

#endif
