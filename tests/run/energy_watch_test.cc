// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/energy_watch.h>

#include <gtest/gtest.h>

namespace moraine
{
  namespace
  {
    /** A motion that began with 3 of kinetic and 1 of stored energy. */
    Works
    works_of(const double kinetic, const double of_boundaries = 0)
    {
      Works works;
      works.kinetic_at_start                          = 3;
      works.stored_at_start                           = 1;
      works.kinetic                                   = kinetic;
      works.of_forces[unsigned(WorkKind::boundaries)] = of_boundaries;
      return works;
    }



    bool
    says(const EnergyWatch &watch, const std::string &text)
    {
      return watch.failure().find(text) != std::string::npos;
    }
  } // namespace



  TEST(EnergyWatch, more_than_100_times_what_was_given_is_a_failure)
  {
    EnergyWatch watch(0);
    watch.count(works_of(16), 0, 1);
    watch.count(works_of(200), 0, 2);
    watch.count(works_of(400), 0, 3);
    EXPECT_EQ(watch.failure(), "");
    watch.count(works_of(401), 0, 4);
    EXPECT_TRUE(says(watch, "at t = 4 "));
    EXPECT_TRUE(says(watch, "no more than 4;"));
    EXPECT_TRUE(says(watch, "since t = 1."));
  }



  TEST(EnergyWatch, what_boundaries_or_transfers_make_is_told_of_once)
  {
    const auto after = [](EnergyWatch &watch, const Works &works) {
      watch.count(works, 0, 1);
      return watch.warning();
    };
    EnergyWatch held(0), carried(0);
    EXPECT_EQ(after(held, works_of(3.5, 0.7)), "");
    for (unsigned int step = 1; step < 5; ++step)
      EXPECT_EQ(after(held, works_of(4, 0.9)), "");
    EXPECT_NE(after(held, works_of(4, 0.9)).find("boundaries that hold"),
              std::string::npos);
    EXPECT_EQ(after(held, works_of(5, 2)), "");
    Works works            = works_of(4);
    works.lost_in_transfer = -0.9;
    for (unsigned int step = 1; step < 5; ++step)
      EXPECT_EQ(after(carried, works), "");
    EXPECT_NE(after(carried, works).find("carrying velocities"),
              std::string::npos);
  }



  /** Of a motion from rest, which is small at first. */
  TEST(EnergyWatch, what_falls_behind_what_is_given_is_not_told_of)
  {
    EnergyWatch watch(0);
    Works       works;
    for (unsigned int step = 1; step < 10; ++step)
      {
        works.kinetic                                   = step * step;
        works.of_forces[unsigned(WorkKind::boundaries)] = step * step + 0.5;
        watch.count(works, 2 * step - 1, step);
        EXPECT_EQ(watch.warning(), "");
      }
  }



  TEST(EnergyWatch, stored_and_dissipated_energy_count)
  {
    for (double Works::*part : {&Works::stored, &Works::dissipated})
      {
        EnergyWatch watch(0);
        Works       works = works_of(0);
        works.*part       = 401;
        watch.count(works, 0, 1);
        EXPECT_NE(watch.failure(), "");
      }
  }



  TEST(EnergyWatch, what_is_given_may_be_taken_back)
  {
    for (const auto kind : {WorkKind::external, WorkKind::absorbed})
      {
        EnergyWatch watch(0);
        Works       works               = works_of(0);
        works.of_forces[unsigned(kind)] = 5;
        watch.count(works, 0, 1);
        works.of_forces[unsigned(kind)] = 0;
        works.kinetic                   = 499;
        watch.count(works, 0, 2);
        EXPECT_EQ(watch.failure(), "");
      }
  }



  /** A boundary gives energy by its motion; by holding it does not. */
  TEST(EnergyWatch, work_of_motions_adds_up)
  {
    EnergyWatch holds(0), moves(0);
    for (unsigned int step = 1; step <= 5; ++step)
      {
        holds.count(works_of(100. * step, 100. * step), 0, step);
        moves.count(works_of(100. * step, 100. * step), 100, step);
      }
    EXPECT_EQ(moves.failure(), "");
    EXPECT_TRUE(says(holds, "boundaries that hold"));
  }



  /** Boundaries that moved in a stage before this motion did so in works that
   * are counted no more. */
  TEST(EnergyWatch, motion_starts_with_what_is_stored)
  {
    EnergyWatch watch(0);
    watch.count(works_of(1, -100), -100, 1);
    EXPECT_EQ(watch.warning(), "");
    watch.motion_starts();
    watch.count(works_of(0), 0, 2);
    EXPECT_EQ(watch.warning(), "");
    EXPECT_EQ(watch.failure(), "");
    watch.count(works_of(401), 0, 3);
    EXPECT_TRUE(says(watch, "no more than 4;"));
  }



  TEST(EnergyWatch, says_who_made_the_energy)
  {
    EnergyWatch integrator(0), transfer(0);
    integrator.count(works_of(500), 0, 1);
    EXPECT_TRUE(says(integrator, "from the integrator"));
    Works works            = works_of(500);
    works.lost_in_transfer = -496;
    transfer.count(works, 0, 1);
    EXPECT_TRUE(says(transfer, "between nodes and points"));
  }



  TEST(EnergyWatch, names_what_the_scene_can_still_change)
  {
    EnergyWatch holds(0, "'Method = GIMP'"), transfer(0, "'Method = GIMP'"),
      nothing(0);
    Works works            = works_of(500);
    works.lost_in_transfer = -496;
    transfer.count(works, 0, 1);
    for (EnergyWatch *watch : {&holds, &nothing})
      watch->count(works_of(500, 500), 0, 1);
    for (const EnergyWatch *watch : {&holds, &transfer})
      EXPECT_TRUE(says(*watch, ", or in section 'Method' 'Method = GIMP'"));
    EXPECT_FALSE(says(nothing, "'Method'"));
  }



  TEST(EnergyWatch, round_off_is_not_looked_at)
  {
    EnergyWatch watch(1000);
    watch.count(works_of(1000), 0, 1);
    EXPECT_EQ(watch.failure(), "");
    watch.count(works_of(1001), 0, 2);
    EXPECT_NE(watch.failure(), "");
  }



  TEST(EnergyWatch, bodies_bring_energy_with_them)
  {
    EnergyWatch watch(0);
    watch.bodies_change();
    watch.count(works_of(500), 0, 1);
    EXPECT_EQ(watch.failure(), "");
    watch.count(works_of(50001), 0, 2);
    EXPECT_NE(watch.failure(), "");
  }



  TEST(EnergyWatch, goes_through_an_archive)
  {
    EnergyWatch watch(0), copy(0);
    Works       works                             = works_of(16);
    works.of_forces[unsigned(WorkKind::absorbed)] = 5;
    watch.count(works, 3, 1);
    works.kinetic                                 = 499;
    works.of_forces[unsigned(WorkKind::absorbed)] = 0;
    watch.count(works, 2, 2);
    Archive archive;
    watch.write(archive);
    copy.read(archive);
    for (EnergyWatch *each : {&watch, &copy})
      {
        each->count(works, 1, 3);
        EXPECT_EQ(each->failure(), "");
        works.kinetic = 601;
        each->count(works, 0, 4);
        works.kinetic = 499;
      }
    EXPECT_NE(watch.failure(), "");
    EXPECT_EQ(copy.failure(), watch.failure());
  }
} // namespace moraine
