// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exit.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** For failures alone, so that nothing else can meet its barrier. */
    MPI_Comm failure_communicator = MPI_COMM_NULL;



    /**
     * Whether every rank comes here within some seconds. A rank that failed
     * alone must not wait for the others, which wait for it elsewhere.
     */
    bool
    all_ranks_fail()
    {
      MPI_Request request;
      MPI_Ibarrier(failure_communicator, &request);
      int arrived = 0;
      for (unsigned int i = 0; i < 300 && arrived == 0; ++i)
        {
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
          if (arrived == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
      return arrived != 0;
    }
  } // namespace



  void
  end_if_alone(const ExitCode code, const std::string &what)
  {
    if (failure_communicator == MPI_COMM_NULL || all_ranks_fail())
      return;
    std::cerr << "moraine: " << what << std::endl;
    MPI_Abort(MPI_COMM_WORLD, code);
  }



  void
  prepare_exit()
  {
    if (failure_communicator == MPI_COMM_NULL)
      failure_communicator =
        Utilities::MPI::duplicate_communicator(MPI_COMM_WORLD);
  }
} // namespace moraine
