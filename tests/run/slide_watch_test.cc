// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/slide_watch.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace moraine
{
  namespace
  {
    /** How often it is told in steps of length 1 with these motions, in cells
     * of size 1. */
    unsigned int
    n_told(const std::vector<double> &motions,
           const bool                 yields = true,
           const bool                 counts = true)
    {
      SlideWatch   watch(yields, 1., 0.);
      unsigned int n = 0;
      double       t = 0;
      for (const double motion : motions)
        n += !watch.look(++t, motion, counts).empty();
      return n;
    }
  } // namespace



  TEST(SlideWatch, a_slide_that_comes_to_rest_is_told_of_once)
  {
    EXPECT_EQ(n_told({0.01, 0.01, 0.01, 0.02, 0.5, 0.01, 0.5, 0.01}), 1u);
    EXPECT_EQ(n_told({0.01, 0.01, 0.01, 0.02, 0.3, 0.5, 0.01}), 1u);
    // While the load goes on, it does not become as slow as before.
    EXPECT_EQ(n_told({0.01, 0.01, 0.01, 0.02, 0.3, 0.8, 0.2, 0.5, 0.5}), 1u);
    // It takes time to come to rest.
    EXPECT_EQ(n_told({0.01, 0.01, 0.01, 0.02, 0.5}), 0u);
  }



  TEST(SlideWatch, what_goes_on_as_fast_is_no_slide)
  {
    EXPECT_EQ(n_told({0.01, 0.01, 0.01, 0.1, 0.1, 0.1, 0.1}), 0u);
    EXPECT_EQ(n_told({0.01, 0.01, 0.01, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.01}),
              0u);
    EXPECT_EQ(n_told({0.01, 0.01, 0.01, 0.03, 0.02, 0.01}), 0u);
  }



  TEST(SlideWatch, loads_that_begin_and_jerks_are_no_slides)
  {
    EXPECT_EQ(n_told({0, 0, 0, 0, 0.1, 0.01, 0.01}), 0u);
    EXPECT_EQ(n_told({1e-13, 1e-13, 1e-13, 1e-13, 0.1, 0.01, 0.01}), 0u);
    EXPECT_EQ(n_told({0.01, 0.5, 0.01, 0.01}), 0u);
    EXPECT_EQ(n_told({1e-4, 1e-4, 1e-4, 1e-2, 1e-4}), 0u);
    EXPECT_EQ(n_told({0.1, 0.1, 0.1, 0.2, 15, 1.3, 1.3}), 0u);
  }



  TEST(SlideWatch, only_what_yields_and_moves_quasi_statically_counts)
  {
    const std::vector<double> slide = {0.01, 0.01, 0.01, 0.02, 0.5, 0.01};
    EXPECT_EQ(n_told(slide), 1u);
    EXPECT_EQ(n_told(slide, false), 0u);
    EXPECT_EQ(n_told(slide, true, false), 0u);
  }



  TEST(SlideWatch, motion_is_over_time_and_stages_begin_anew)
  {
    SlideWatch watch(true, 1., 0.);
    double     t = 0;
    for (unsigned int i = 0; i < 4; ++i)
      EXPECT_EQ(watch.look(++t, 0.02, true), "");
    EXPECT_EQ(watch.look(t += 0.01, 0.03, true), "");
    EXPECT_NE(watch.look(t += 0.01, 1e-4, true).find("to t = 4.01"),
              std::string::npos);
    watch.stage_begins();
    for (unsigned int i = 0; i < 4; ++i)
      EXPECT_EQ(watch.look(++t, 0.02, true), "");
    EXPECT_EQ(watch.look(++t, 0.5, true), "");
    EXPECT_NE(watch.look(++t, 0.02, true), "");
  }
} // namespace moraine
