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
} // namespace moraine

#endif
