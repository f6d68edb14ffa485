// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_on_root_h
#define moraine_output_on_root_h

#include <mpi.h>

#include <functional>

namespace moraine
{
  /**
   * Run @p work on rank 0 only, and let every rank know how it ended.
   * Collective.
   *
   * @throws On every rank what @p work threw: InputError and ComputationError
   * keep their type, any other std::exception becomes a ComputationError.
   */
  void
  on_root(const MPI_Comm &communicator, const std::function<void()> &work);

  /**
   * Run @p work on every rank and agree on how it ended. Collective. @p work
   * may communicate only if it cannot fail on some ranks alone.
   *
   * @throws On every rank what the lowest rank that failed threw, as in
   * on_root().
   */
  void
  on_all(const MPI_Comm &communicator, const std::function<void()> &work);
} // namespace moraine

#endif
