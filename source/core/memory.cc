// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/memory.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fstream>

#include <malloc.h>

namespace moraine
{
  using namespace dealii;

  Memory
  memory_in_use(const MPI_Comm communicator)
  {
    Utilities::System::MemoryStats kib;
    Utilities::System::get_memory_stats(kib);
    return {Utilities::MPI::max(kib.VmRSS / 1024., communicator),
            Utilities::MPI::max(kib.VmHWM / 1024., communicator)};
  }



  bool
  reset_peak_memory()
  {
    // What was freed but kept would count as resident.
    malloc_trim(0);
    std::ofstream file("/proc/self/clear_refs");
    file << "5" << std::flush;

    // Some systems take the request and do nothing.
    Utilities::System::MemoryStats kib;
    Utilities::System::get_memory_stats(kib);
    return file.good() && kib.VmHWM <= kib.VmRSS + 1024;
  }
} // namespace moraine
