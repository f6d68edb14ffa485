// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/words.h>

#include <gtest/gtest.h>

namespace moraine
{
  TEST(Words, shares_in_per_cent_have_two_digits_or_are_whole)
  {
    EXPECT_EQ(per_cent(0.), "0 %");
    EXPECT_EQ(per_cent(0.00123), "0.12 %");
    EXPECT_EQ(per_cent(0.0754), "7.5 %");
    EXPECT_EQ(per_cent(0.1249), "12 %");
    EXPECT_EQ(per_cent(1.3), "130 %");
    EXPECT_EQ(per_cent(12.3456), "1235 %");
    EXPECT_EQ(per_cent(-0.5), "-50 %");
  }
} // namespace moraine
