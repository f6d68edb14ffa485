// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/solver_choice.h>

#include <gtest/gtest.h>

#include <vector>

using namespace moraine;

TEST(SolverChoice, SmallMatricesAreFactorised)
{
  SolverChoice choice(1000, 2);
  EXPECT_TRUE(choice.directly(1000));
  EXPECT_FALSE(choice.directly(1001));
}

TEST(SolverChoice, GoesOnDirectlyWhereIterationsTookMore)
{
  const unsigned int n    = 26000;
  const double       cost = SolverChoice::factorisation_cost(n, 2);
  SolverChoice       choice(1000, 2);
  EXPECT_FALSE(choice.directly(n));
  choice.spend(0.9 * cost);
  EXPECT_FALSE(choice.too_expensive());
  EXPECT_FALSE(choice.directly(n));
  choice.spend(1.1 * cost);
  EXPECT_TRUE(choice.too_expensive());
  EXPECT_NEAR(choice.allowed_iterations(), 0.9 * cost, 1.);
  EXPECT_TRUE(choice.directly(n));
  EXPECT_TRUE(choice.directly(n));
  // A matrix so large that iterations are the cheaper way again.
  EXPECT_FALSE(choice.directly(4 * n));
}

TEST(SolverChoice, TriesAgainAfterAFailureButLessAndLess)
{
  const unsigned int        n = 30000; // a factorisation is dear in 3D
  SolverChoice              choice(1000, 3);
  std::vector<unsigned int> attempts;
  for (unsigned int k = 0; k < 30; ++k)
    if (!choice.directly(n))
      {
        attempts.push_back(k);
        choice.spend(500);
        choice.give_up();
      }
  ASSERT_GE(attempts.size(), 3u);
  EXPECT_LE(attempts.size(), 6u);
  for (unsigned int i = 2; i < attempts.size(); ++i)
    EXPECT_GT(attempts[i] - attempts[i - 1], attempts[i - 1] - attempts[i - 2]);

  // In 2D a factorisation of this size is no dearer than multigrid.
  SolverChoice in_2d(1000, 2);
  EXPECT_FALSE(in_2d.directly(5000));
  in_2d.give_up();
  for (unsigned int k = 0; k < 100; ++k)
    EXPECT_TRUE(in_2d.directly(5000));
}
