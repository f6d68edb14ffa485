// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_interrupt_h
#define moraine_core_interrupt_h

#include <mpi.h>

#include <signal.h>

namespace moraine
{
  /**
   * As long as it lives, the first Ctrl-C (SIGINT) or SIGTERM only asks to end
   * with the last accepted step, and a second one of its kind ends the program
   * at once. Afterwards signals do what they did before: a launcher that ends
   * the other ranks of a program that has failed asks for no step.
   */
  class InterruptHandler
  {
  public:
    /** @param announce say so on the terminal; for one rank. */
    explicit InterruptHandler(const bool announce);

    InterruptHandler(const InterruptHandler &) = delete;
    InterruptHandler &
    operator=(const InterruptHandler &) = delete;

    ~InterruptHandler();

  private:
    struct sigaction action_on_interrupt, action_on_termination;
  };

  /**
   * Whether any rank was asked to end. All ranks must call it and get the same
   * answer.
   */
  bool
  interrupted(const MPI_Comm communicator);
} // namespace moraine

#endif
