// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/interrupt.h>

#include <deal.II/base/mpi.h>

#include <csignal>

#include <unistd.h>

namespace moraine
{
  namespace
  {
    volatile std::sig_atomic_t was_interrupted = 0;
    volatile std::sig_atomic_t must_announce   = 0;



    extern "C" void
    handle_interrupt(int)
    {
      // Only what a signal handler may do.
      was_interrupted = 1;
      if (must_announce != 0)
        {
          static constexpr char text[] =
            "\nEnding with the last accepted step; once more to end at once.\n";
          const auto written = write(STDERR_FILENO, text, sizeof(text) - 1);
          static_cast<void>(written);
        }
    }
  } // namespace



  InterruptHandler::InterruptHandler(const bool announce)
  {
    was_interrupted         = 0;
    must_announce           = announce ? 1 : 0;
    struct sigaction action = {};
    action.sa_handler       = handle_interrupt;
    // The second signal meets the default action; system calls go on.
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigaction(SIGINT, &action, &action_on_interrupt);
    sigaction(SIGTERM, &action, &action_on_termination);
  }



  InterruptHandler::~InterruptHandler()
  {
    sigaction(SIGINT, &action_on_interrupt, nullptr);
    sigaction(SIGTERM, &action_on_termination, nullptr);
  }



  bool
  interrupted(const MPI_Comm communicator)
  {
    return dealii::Utilities::MPI::max(static_cast<int>(was_interrupted),
                                       communicator) != 0;
  }
} // namespace moraine
