// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_memory_h
#define moraine_core_memory_h

#include <moraine/core/exceptions.h>

#include <mpi.h>

#include <new>
#include <string>

namespace moraine
{
  /** Resident memory in MiB of the rank that has most; all ranks must call. */
  struct Memory
  {
    double current_mib = 0;
    double peak_mib    = 0;
  };

  Memory
  memory_in_use(const MPI_Comm communicator);

  /**
   * Give large blocks back to the system as they are freed. SuperLU_DIST, which
   * Trilinos may bring along, turns that off for the whole program as it is
   * loaded.
   */
  void
  return_large_blocks();

  /**
   * Let the peak begin anew at what is resident now, on this rank.
   * @return false where the system does not allow it.
   */
  bool
  reset_peak_memory();

  /** Bytes of the machine that are free for programs. */
  double
  free_memory();

  /**
   * Whether the machine has @p bytes is asked before they are used.
   * @return the end of a message that tells how much there is if not, or "".
   */
  std::string
  lack_of_memory(const double bytes);

  /** @throws InputError if @p bytes are not there: @p what, then how much there
   * is. */
  void
  require_memory(const double bytes, const std::string &what);

  /**
   * Do @p what. Memory that the system does not give becomes a
   * ComputationError with a message for the user.
   */
  template <class Function>
  auto
  with_memory(const Function &what)
  {
    try
      {
        return what();
      }
    catch (const std::bad_alloc &)
      {
        throw ComputationError(
          "not enough memory: the system refused more; larger cells, fewer "
          "points per direction or an iterative solver (key 'Solver' in "
          "section 'Solver') need less");
      }
  }
} // namespace moraine

#endif
