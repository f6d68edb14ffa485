// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/memory.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fstream>
#include <limits>
#include <sstream>

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



  void
  return_large_blocks()
  {
    // Vectors are made and freed too often for new pages each time.
    constexpr int MiB = 1024 * 1024;
    mallopt(M_MMAP_MAX, 65536);
    mallopt(M_MMAP_THRESHOLD, 16 * MiB);
    mallopt(M_TRIM_THRESHOLD, 64 * MiB);
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



  double
  free_memory()
  {
    double        kib = std::numeric_limits<double>::infinity();
    std::ifstream file("/proc/meminfo");
    std::string   line;
    while (std::getline(file, line))
      if (line.rfind("MemAvailable:", 0) == 0)
        std::istringstream(line.substr(13)) >> kib;
    return 1024 * kib;
  }



  std::string
  lack_of_memory(const double bytes)
  {
    const double available = free_memory();
    if (bytes <= available)
      return "";
    constexpr double gib = 1024. * 1024. * 1024.;
    return ", which take at least " + text_of(bytes / gib, 2) +
           " GiB, allowed: what fits into the memory that is free, " +
           text_of(available / gib, 2) + " GiB";
  }



  void
  require_memory(const double bytes, const std::string &what)
  {
    const std::string lack = lack_of_memory(bytes);
    if (!lack.empty())
      throw InputError(what + lack);
  }
} // namespace moraine
