// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/energy_watch.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

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



    std::string
    remedy(const EnergySource)
    {
      return "shorter steps";
    }



    bool
    says(const EnergyWatch &watch, const std::string &text)
    {
      return watch.failure().find(text) != std::string::npos;
    }
  } // namespace



  TEST(EnergyWatch, more_than_100_times_what_was_given_is_a_failure)
  {
    EnergyWatch watch(0, remedy);
    watch.count(works_of(16), 0, 1);
    watch.count(works_of(200), 0, 2);
    watch.count(works_of(400), 0, 3);
    EXPECT_EQ(watch.failure(), "");
    watch.count(works_of(401), 0, 4);
    EXPECT_TRUE(says(watch, "at t = 4 "));
    EXPECT_TRUE(says(watch, "no more than 4;"));
    EXPECT_TRUE(says(watch, "since t = 1."));
  }



  TEST(EnergyWatch, what_is_made_on_the_whole_is_told_of_once)
  {
    const auto after = [](EnergyWatch &watch, const Works &works) {
      watch.count(works, 0, 1);
      return watch.warning();
    };
    EnergyWatch held(0, remedy), carried(0, remedy), made(0, remedy);
    EXPECT_EQ(after(held, works_of(4.1, 0.1)), "");
    for (unsigned int step = 1; step < 5; ++step)
      EXPECT_EQ(after(held, works_of(4.3, 0.3)), "");
    EXPECT_NE(after(held, works_of(4.3, 0.3))
                .find("by 7.5 % of what was given until t = 1. It comes from "
                      "boundaries that hold: shorter steps"),
              std::string::npos);
    EXPECT_EQ(after(held, works_of(5, 2)), "");
    Works works            = works_of(4.3);
    works.lost_in_transfer = -0.3;
    for (unsigned int step = 1; step < 5; ++step)
      {
        EXPECT_EQ(after(carried, works), "");
        EXPECT_EQ(after(made, works_of(4.3)), "");
      }
    EXPECT_NE(after(carried, works).find("carrying velocities"),
              std::string::npos);
    EXPECT_NE(after(made, works_of(4.3)).find("the integrator"),
              std::string::npos);
  }



  /** The total is right, whatever its parts. */
  TEST(EnergyWatch, parts_that_cancel_are_not_told_of)
  {
    EnergyWatch watch(0, remedy);
    for (unsigned int step = 1; step < 20; ++step)
      {
        watch.count(works_of(3, 0.2 * step), 0, step);
        EXPECT_EQ(watch.warning(), "");
      }
  }



  /** Of a motion from rest, which is small at first. */
  TEST(EnergyWatch, what_falls_behind_what_is_given_is_not_told_of)
  {
    EnergyWatch watch(0, remedy);
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
        EnergyWatch watch(0, remedy);
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
        EnergyWatch watch(0, remedy);
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
    EnergyWatch holds(0, remedy), moves(0, remedy);
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
    EnergyWatch watch(0, remedy);
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
    EnergyWatch integrator(0, remedy), transfer(0, remedy);
    integrator.count(works_of(500), 0, 1);
    EXPECT_TRUE(says(integrator, "from the integrator"));
    Works works            = works_of(500);
    works.lost_in_transfer = -496;
    transfer.count(works, 0, 1);
    EXPECT_TRUE(says(transfer, "between nodes and points"));
  }



  TEST(EnergyWatch, names_what_helps_against_the_source)
  {
    std::vector<EnergySource> asked;
    EnergyWatch               watch(0, [&asked](const EnergySource source) {
      asked.push_back(source);
      return std::string("a key");
    });
    Works                     works = works_of(500);
    works.lost_in_transfer          = -496;
    watch.count(works, 0, 1);
    EXPECT_TRUE(says(watch, ": a key"));
    EXPECT_EQ(asked, std::vector<EnergySource>{EnergySource::transfers});
  }



  TEST(EnergyWatch, round_off_is_not_looked_at)
  {
    EnergyWatch watch(1000, remedy);
    watch.count(works_of(1000), 0, 1);
    EXPECT_EQ(watch.failure(), "");
    watch.count(works_of(1001), 0, 2);
    EXPECT_NE(watch.failure(), "");
  }



  TEST(EnergyWatch, bodies_bring_energy_with_them)
  {
    EnergyWatch watch(0, remedy);
    watch.bodies_change();
    watch.count(works_of(500), 0, 1);
    EXPECT_EQ(watch.failure(), "");
    watch.count(works_of(50001), 0, 2);
    EXPECT_NE(watch.failure(), "");
  }



  TEST(EnergyWatch, goes_through_an_archive)
  {
    EnergyWatch watch(0, remedy), copy(0, remedy);
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
