// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// GoogleTest under MPI: rank 0 prints all, the others what failed on them, and
// the program fails if a test failed on any rank.

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <iostream>

namespace
{
  class Failures : public testing::EmptyTestEventListener
  {
    void
    OnTestPartResult(const testing::TestPartResult &result) override
    {
      if (result.failed())
        std::cout << "Rank "
                  << dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)
                  << ": " << result << std::flush;
    }
  };
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    {
      auto &listeners = testing::UnitTest::GetInstance()->listeners();
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(new Failures);
    }
  const int failed = RUN_ALL_TESTS();
  return dealii::Utilities::MPI::max(failed, MPI_COMM_WORLD);
}
