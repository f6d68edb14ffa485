// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/command_line.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>

/**
 * A process that no launcher of MPI started has nobody to talk to. Open MPI
 * then need not look for networks nor start a daemon, which is half of the
 * program's start. What the user has set stays.
 */
static void
start_quickly_if_alone()
{
  const std::array<const char *, 3> launched{
    {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}};
  if (std::any_of(launched.begin(), launched.end(), [](const char *name) {
        return std::getenv(name) != nullptr;
      }))
    return;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_btl", "self,vader", 0);
}



int
main(int argc, char **argv)
{
  start_quickly_if_alone();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return moraine::main_program({argv + 1, argv + argc});
}
