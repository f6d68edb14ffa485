// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/diagnostics/energy_balance.h>

#include <gtest/gtest.h>

#include <string>

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

    struct Balance
    {
      explicit Balance(const double round_off = 0)
        : energy(ledger, round_off)
      {}

      double
      growth_after(const Works &works, const double of_motions = 0)
      {
        energy.count(works, of_motions, ++t);
        return energy.growth();
      }

      bool
      fails() const
      {
        return !energy.failure().empty();
      }

      Ledger        ledger;
      EnergyBalance energy;
      double        t = 0;
    };
  } // namespace



  TEST(EnergyBalance, more_than_100_times_the_energy_given_is_a_failure)
  {
    Balance balance;
    balance.growth_after(works_of(400));
    EXPECT_FALSE(balance.fails());
    balance.growth_after(works_of(401));
    EXPECT_TRUE(balance.fails());
  }



  TEST(EnergyBalance, growth_in_five_steps_is_found_with_its_source)
  {
    Balance held, carried, made;
    Works   works          = works_of(4.3);
    works.lost_in_transfer = -0.3;
    for (unsigned int step = 1; step < 5; ++step)
      {
        EXPECT_EQ(held.growth_after(works_of(4.3, 0.3)), 0);
        EXPECT_EQ(carried.growth_after(works), 0);
        EXPECT_EQ(made.growth_after(works_of(4.3)), 0);
      }
    EXPECT_NEAR(held.growth_after(works_of(4.3, 0.3)), 0.075, 1e-12);
    EXPECT_EQ(held.energy.source(), "boundaries");
    EXPECT_GT(carried.growth_after(works), 0);
    EXPECT_EQ(carried.energy.source(), "transfers between points and nodes");
    EXPECT_GT(made.growth_after(works_of(4.3)), 0);
    EXPECT_EQ(made.energy.source(), "integrator");
  }



  TEST(EnergyBalance, errors_that_cancel_or_fall_behind_are_no_growth)
  {
    Balance cancel, behind;
    Works   works;
    for (unsigned int step = 1; step < 20; ++step)
      {
        EXPECT_EQ(cancel.growth_after(works_of(3, 0.2 * step)), 0);
        works.kinetic                                   = step * step;
        works.of_forces[unsigned(WorkKind::boundaries)] = step * step + 0.5;
        if (step < 10)
          {
            EXPECT_EQ(behind.growth_after(works, 2 * step - 1), 0);
          }
      }
  }



  TEST(EnergyBalance, all_kinds_of_energy_count)
  {
    for (double Works::*part : {&Works::stored, &Works::dissipated})
      {
        Balance balance;
        Works   works = works_of(0);
        works.*part   = 401;
        balance.growth_after(works);
        EXPECT_TRUE(balance.fails());
      }
    for (const auto kind : {WorkKind::external, WorkKind::absorbed})
      {
        Balance balance;
        Works   works                   = works_of(0);
        works.of_forces[unsigned(kind)] = 5;
        balance.growth_after(works);
        works.of_forces[unsigned(kind)] = 0;
        works.kinetic                   = 499;
        balance.growth_after(works);
        EXPECT_FALSE(balance.fails());
      }
  }



  /** A boundary gives energy by its motion; by holding it does not. */
  TEST(EnergyBalance, work_of_motions_adds_up)
  {
    Balance holds, moves;
    for (unsigned int step = 1; step <= 5; ++step)
      {
        holds.growth_after(works_of(100. * step, 100. * step));
        moves.growth_after(works_of(100. * step, 100. * step), 100);
      }
    EXPECT_FALSE(moves.fails());
    EXPECT_TRUE(holds.fails());
  }



  TEST(EnergyBalance, begins_with_dynamics_and_with_bodies)
  {
    Balance stage;
    stage.growth_after(works_of(1, -100), -100);
    stage.energy.motion_starts();
    stage.growth_after(works_of(0));
    EXPECT_FALSE(stage.fails());
    stage.growth_after(works_of(401));
    EXPECT_TRUE(stage.fails());

    Balance body;
    body.energy.bodies_change();
    body.growth_after(works_of(500));
    EXPECT_FALSE(body.fails());
    body.growth_after(works_of(50001));
    EXPECT_TRUE(body.fails());
  }



  TEST(EnergyBalance, round_off_is_not_looked_at)
  {
    Balance balance(1000);
    balance.growth_after(works_of(1000));
    EXPECT_FALSE(balance.fails());
    balance.growth_after(works_of(1001));
    EXPECT_TRUE(balance.fails());
  }



  TEST(EnergyBalance, goes_through_the_archive_of_the_ledger)
  {
    Balance balance, copy;
    Works   works                                 = works_of(16);
    works.of_forces[unsigned(WorkKind::absorbed)] = 5;
    balance.growth_after(works, 3);
    balance.ledger.add({"slide", "wall", 2, 1, "It slid."});
    Archive archive;
    balance.ledger.write(archive);
    copy.ledger.read(archive);
    for (Balance *each : {&balance, &copy})
      {
        works.kinetic = 499;
        each->growth_after(works, 1);
        EXPECT_FALSE(each->fails());
        works.kinetic = 601;
        each->growth_after(works);
        EXPECT_TRUE(each->fails());
        EXPECT_TRUE(each->ledger.has("slide"));
        EXPECT_FALSE(each->ledger.add({"slide", "", 1, 1, ""}));
      }
    EXPECT_EQ(copy.ledger.findings()[0].text, "It slid.");
  }
} // namespace moraine
