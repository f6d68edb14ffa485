// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// GoogleTest under MPI: rank 0 prints all, the others what failed on them, and
// the program fails if a test failed on any rank. --room=NAME runs the tests
// from tests/NAME alone, and fails if there is none.

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <iostream>
#include <string>

namespace
{
  /** A filter of all tests that stand in a folder. */
  std::string
  tests_of(const std::string &room)
  {
    std::string filter;
    const auto &all = *testing::UnitTest::GetInstance();
    for (int s = 0; s < all.total_test_suite_count(); ++s)
      {
        const testing::TestSuite &suite = *all.GetTestSuite(s);
        for (int t = 0; t < suite.total_test_count(); ++t)
          if (const testing::TestInfo &test = *suite.GetTestInfo(t);
              std::string(test.file()).find('/' + room + '/') !=
              std::string::npos)
            filter += std::string(suite.name()) + '.' + test.name() + ':';
      }
    return filter;
  }

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
  const std::string option = "--room=";
  if (argc > 1 && std::string(argv[1]).rfind(option, 0) == 0)
    {
      const std::string room      = argv[1] + option.size();
      testing::GTEST_FLAG(filter) = tests_of(room);
      if (testing::GTEST_FLAG(filter).empty())
        {
          std::cerr << "no test in tests/" << room << std::endl;
          return 1;
        }
    }
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    {
      auto &listeners = testing::UnitTest::GetInstance()->listeners();
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(new Failures);
    }
  const int failed = RUN_ALL_TESTS();
  return dealii::Utilities::MPI::max(failed, MPI_COMM_WORLD);
}
