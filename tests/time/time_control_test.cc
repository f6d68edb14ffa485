// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <deal.II/base/parameter_handler.h>

#include <moraine/core/exceptions.h>
#include <moraine/time/time_control.h>

#include <gtest/gtest.h>

using namespace moraine;

namespace
{
  TimeParameters
  steps(const unsigned int n, const double end = 1.)
  {
    TimeParameters parameters;
    parameters.n_steps  = n;
    parameters.end_time = end;
    return parameters;
  }

  void
  step(TimeControl &time, const unsigned int iterations = 1)
  {
    time.next();
    time.accept(iterations);
  }
} // namespace

TEST(TimeControl, HitsEveryStepExactly)
{
  TimeControl time(steps(10, 0.7));
  for (unsigned int k = 1; k <= 10; ++k)
    {
      ASSERT_FALSE(time.finished());
      step(time);
      EXPECT_EQ(time.time(), k == 10 ? 0.7 : 0.7 * k / 10);
      EXPECT_TRUE(time.at_step_end());
      EXPECT_EQ(time.n_completed_steps(), k);
    }
  EXPECT_TRUE(time.finished());
  EXPECT_EQ(time.n_accepted(), 10u);
}

TEST(TimeControl, TakesTheCutThatIsWanted)
{
  TimeParameters parameters = steps(1);
  parameters.smallest_step  = 0.01;
  TimeControl time(parameters);
  const auto  next_after = [&](const double wanted) {
    time.next();
    EXPECT_TRUE(time.reject("test", wanted));
    time.next();
    return time.trial_time();
  };
  EXPECT_DOUBLE_EQ(next_after(0.2), 0.2);
  EXPECT_DOUBLE_EQ(next_after(1.), 0.1);
  // Neither below the smallest, nor with no end.
  EXPECT_DOUBLE_EQ(next_after(0.9999), 1. / 11);
  EXPECT_DOUBLE_EQ(next_after(1e-9), 0.01);
  EXPECT_FALSE(time.reject("test", 0.9));
}

TEST(TimeControl, LeavesNoSliverAfterCuts)
{
  // A cut of 0.3 does not divide a step: what remains is split evenly.
  TimeParameters parameters = steps(3);
  parameters.cut            = 0.3;
  parameters.growth         = 1.;
  TimeControl time(parameters);
  time.next();
  EXPECT_TRUE(time.reject("test"));
  double       smallest = 1.;
  unsigned int n        = 0;
  while (!time.finished())
    {
      time.next();
      smallest = std::min(smallest, time.trial_time() - time.time());
      time.accept(1);
      ++n;
    }
  EXPECT_EQ(time.time(), 1.);
  EXPECT_EQ(n, 12u); // 1/0.3 is more than 3: four parts for each step
  EXPECT_NEAR(smallest, 1. / 12., 1e-14);
}

TEST(TimeControl, GrowsBackAfterEasySteps)
{
  TimeControl time(steps(2, 2.));
  time.next();
  EXPECT_TRUE(time.reject("test"));
  time.next();
  EXPECT_TRUE(time.reject("test"));
  time.next();
  EXPECT_EQ(time.trial_time(), 0.25);
  time.accept(6); // not easy: the size stays
  EXPECT_FALSE(time.at_step_end());
  time.next();
  EXPECT_EQ(time.trial_time(), 0.5);
  time.accept(5); // easy: it doubles
  time.next();
  EXPECT_EQ(time.trial_time(), 1.);
  time.accept(1);
  EXPECT_EQ(time.n_completed_steps(), 1u);
  time.next();
  EXPECT_EQ(time.trial_time(), 2.); // never more than one step
  time.accept(1);
  EXPECT_TRUE(time.finished());
  EXPECT_EQ(time.n_accepted(), 4u);
  EXPECT_EQ(time.n_rejected(), 2u);
}

TEST(TimeControl, GrowsBackAfterFiveHardSteps)
{
  TimeControl time(steps(2, 2.));
  time.next();
  for (unsigned int n = 0; n < 4; ++n)
    {
      EXPECT_TRUE(time.reject("test"));
      time.next();
    }
  for (unsigned int n = 1; n <= 5; ++n)
    {
      EXPECT_NEAR(time.trial_time(), n / 16., 1e-14);
      time.accept(100);
      time.next();
    }
  // twice the size; 11/16 are left to the end of the step
  EXPECT_NEAR(time.trial_time() - time.time(), 11. / 96, 1e-14);
}

TEST(TimeControl, CutsTheStepThatFailed)
{
  // The last part before a stop may be shorter than the size; a cut must
  // shorten the part, not the size.
  TimeControl time(steps(1), {0.9});
  step(time);
  time.next();
  EXPECT_NEAR(time.trial_time() - time.time(), 0.1, 1e-15);
  EXPECT_TRUE(time.reject("test"));
  time.next();
  EXPECT_NEAR(time.trial_time() - time.time(), 0.05, 1e-15);
}

TEST(TimeControl, HitsTheTimesAskedFor)
{
  TimeControl  time(steps(2), {0.75, 0.1, 0.5 + 1e-13, 0., 1., 2., -1.});
  const double expected[] = {0.1, 0.5, 0.75, 1.};
  for (const double t : expected)
    {
      step(time);
      EXPECT_EQ(time.time(), t);
      EXPECT_EQ(time.at_step_end(), t == 0.5 || t == 1.);
    }
  EXPECT_TRUE(time.finished());
}

TEST(TimeControl, StopsBelowTheSmallestStep)
{
  TimeParameters parameters = steps(1);
  parameters.smallest_step  = 0.125;
  TimeControl time(parameters);
  for (unsigned int i = 0; i < 3; ++i)
    {
      time.next();
      EXPECT_TRUE(time.reject("test"));
    }
  time.next();
  EXPECT_EQ(time.trial_time() - time.time(), 0.125);
  EXPECT_FALSE(time.reject("no equilibrium"));
  EXPECT_EQ(time.time(), 0.);
  EXPECT_EQ(time.message(),
            "The step from t = 0 to 0.125 failed: no equilibrium. A cut would "
            "go below the smallest step, 0.125 (Smallest step = 0.125 of a "
            "step).");
}

TEST(TimeControl, TakesBackTheCutsOfAStep)
{
  TimeControl time(steps(2));
  step(time);
  for (unsigned int i = 0; i < 3; ++i)
    {
      time.next();
      EXPECT_NEAR(time.trial_time(), 0.5 + 0.5 / (1 << i), 1e-15);
      EXPECT_TRUE(time.reject("test"));
    }
  time.take_back_cuts();
  time.next();
  EXPECT_EQ(time.trial_time(), 1.);
}

TEST(TimeControl, StartsWithTheLargestStep)
{
  TimeParameters parameters = steps(2);
  parameters.start_time     = -1.;
  parameters.largest_step   = 0.25;
  TimeControl  time(parameters);
  unsigned int n = 0;
  for (; !time.finished(); ++n)
    {
      time.next();
      EXPECT_NEAR(time.trial_time() - time.time(), 0.25, 1e-15);
      time.accept(1);
    }
  EXPECT_EQ(n, 8u);
}

TEST(TimeControl, RefusesWhatCannotBe)
{
  TimeParameters backwards = steps(1, -1.);
  EXPECT_THROW(TimeControl{backwards}, InputError);
  TimeParameters inverted = steps(1);
  inverted.smallest_step  = 0.5;
  inverted.largest_step   = 0.1;
  EXPECT_THROW(inverted.check(), InputError);
  EXPECT_NO_THROW(steps(1).check());
}

TEST(TimeControl, ReadsItsKeys)
{
  TimeParameters           parameters;
  OutputTimes              output;
  dealii::ParameterHandler prm;
  parameters.add_parameters(prm);
  output.add_parameters(prm);
  prm.parse_input_from_string("set End time = 3\nset Steps = 6\n"
                              "set Cut = 0.25\nset Every = 2\n");
  EXPECT_EQ(parameters.end_time, 3.);
  EXPECT_EQ(parameters.n_steps, 6u);
  EXPECT_EQ(parameters.cut, 0.25);
  EXPECT_EQ(output.every, 2u);
}

TEST(TimeControl, GoesOnFromAnArchive)
{
  TimeControl time(steps(4)), resumed(steps(4));
  time.next();
  time.reject("test");
  time.next();
  time.accept(100);
  moraine::Archive archive;
  time.write(archive);
  resumed.read(archive);
  EXPECT_EQ(resumed.time(), 0.125);
  EXPECT_EQ(resumed.n_rejected(), 1u);
  while (!time.finished())
    {
      step(time);
      step(resumed);
      EXPECT_EQ(time.time(), resumed.time());
      EXPECT_EQ(time.at_step_end(), resumed.at_step_end());
      EXPECT_EQ(time.n_completed_steps(), resumed.n_completed_steps());
      EXPECT_EQ(time.n_accepted(), resumed.n_accepted());
    }
  EXPECT_TRUE(resumed.finished());
}

TEST(TimeControl, GoesOnWithOtherStepsToAnotherEnd)
{
  TimeControl time(steps(4));
  step(time);
  step(time);
  moraine::Archive archive;
  time.write(archive);

  TimeParameters other;
  other.end_time = 2.;
  other.n_steps  = 20;
  TimeControl resumed(other);
  resumed.read(archive);
  EXPECT_EQ(resumed.time(), 0.5);
  EXPECT_EQ(resumed.n_completed_steps(), 5u);
  step(resumed);
  EXPECT_DOUBLE_EQ(resumed.time(), 0.6);
  EXPECT_TRUE(resumed.at_step_end());
  while (!resumed.finished())
    step(resumed);
  EXPECT_EQ(resumed.time(), 2.);
  EXPECT_EQ(resumed.n_accepted(), 2u + 15u);
}

TEST(CheckpointTimes, WhatIsAllowed)
{
  using moraine::CheckpointTimes;
  EXPECT_TRUE(CheckpointTimes::from_text("never").never());
  EXPECT_EQ(CheckpointTimes::from_text("10 steps").steps, 10u);
  EXPECT_EQ(CheckpointTimes::from_text("1 step").steps, 1u);
  EXPECT_EQ(CheckpointTimes::from_text("0.5 minutes").minutes, 0.5);
  EXPECT_EQ(CheckpointTimes::from_text("0.5 minutes").steps, 0u);
  for (const char *text : {"",
                           "10",
                           "steps",
                           "0 steps",
                           "1.5 steps",
                           "1 h",
                           "-1 minutes",
                           "10 steps more",
                           "nan minutes"})
    EXPECT_THROW(CheckpointTimes::from_text(text), moraine::InputError) << text;
}

TEST(TimeControl, UndoLeavesTheLastAcceptedStep)
{
  const auto archive_of = [](const TimeControl &time) {
    moraine::Archive archive;
    time.write(archive);
    return archive;
  };
  TimeControl time(steps(4));
  step(time);
  const moraine::Archive accepted = archive_of(time);
  time.next();
  time.reject("test");
  time.next();
  EXPECT_TRUE(archive_of(time) == accepted);
  time.undo();
  EXPECT_EQ(time.trial_time(), time.time());
  time.next();
  EXPECT_EQ(time.trial_time(), 0.5);
}

TEST(OutputTimes, SayWhenResultsAreDue)
{
  const auto written = [](const std::string &when, const unsigned int every) {
    TimeParameters parameters = steps(5);
    parameters.largest_step   = 0.5;
    TimeControl         time(parameters);
    const OutputTimes   output{when, every};
    std::vector<double> times;
    while (!time.finished())
      {
        step(time);
        if (output.due(time))
          times.push_back(time.time());
      }
    return times;
  };
  EXPECT_EQ(written("steps", 2), (std::vector<double>{0.4, 0.8, 1.}));
  EXPECT_EQ(written("steps", 1).size(), 5u);
  EXPECT_EQ(written("all", 1).size(), 10u);
  EXPECT_EQ(written("end", 1), (std::vector<double>{1.}));
}

TEST(TimeControl, StagesFollowEachOther)
{
  std::vector<TimeParameters> stages{steps(2), steps(10, 2.)};
  stages[1].start_time   = 1.;
  stages[1].largest_step = 0.5;
  TimeControl time(stages, {0.25, 1., 1.55});
  EXPECT_EQ(time.stage(), 0u);
  std::vector<double> times;
  for (; time.time() < 1.; step(time))
    {
      EXPECT_EQ(time.stage(), 0u);
      times.push_back(time.time());
    }
  EXPECT_EQ(times, (std::vector<double>{0., 0.25, 0.5}));
  EXPECT_EQ(time.time(), 1.);
  EXPECT_TRUE(time.at_step_end());
  EXPECT_EQ(time.stage(), 1u);
  step(time);
  EXPECT_DOUBLE_EQ(time.time(), 1.05); // its own size, not that before
  bool asked = false;
  for (; !time.finished(); step(time))
    asked = asked || time.time() == 1.55;
  EXPECT_TRUE(asked);
  EXPECT_EQ(time.time(), 2.);
  EXPECT_EQ(time.stage(), 1u);
  EXPECT_EQ(time.n_completed_steps(), 12u);
}

TEST(TimeControl, GrowsNoMoreThanAllowed)
{
  TimeParameters parameters = steps(1);
  parameters.largest_step   = 0.1;
  TimeControl time(parameters);
  time.next();
  time.accept(1, 0.5);
  time.next();
  EXPECT_NEAR(time.trial_time(), 0.15, 0.003); // equal parts of what is left
  time.accept(1, 1e-9);
  time.next();
  EXPECT_GE(time.trial_time() - time.time(), 0.9e-3); // the smallest
  time.accept(1, 10.);
  time.next();
  EXPECT_LE(time.trial_time() - time.time(), 2.1e-3); // it doubles at most
}

TEST(TimeControl, FollowsAPathByItsLength)
{
  TimeParameters parameters = steps(4, 3.);
  parameters.arc_length     = 0.5;
  TimeControl  time(parameters);
  const double found[]  = {1., 2., 1.5, -1.};
  double       previous = 0.;
  for (unsigned int k = 0; k < 4; ++k)
    {
      ASSERT_TRUE(time.follows_path());
      ASSERT_FALSE(time.finished());
      time.next();
      EXPECT_EQ(time.trial_length(), 0.5);
      time.set_trial_time(found[k]);
      EXPECT_EQ(time.time(), previous);
      EXPECT_EQ(time.trial_time(), found[k]);
      time.accept(1);
      EXPECT_EQ(time.time(), found[k]);
      EXPECT_EQ(time.path_length(), 0.5 * (k + 1));
      EXPECT_DOUBLE_EQ(time.path_rate(), (found[k] - previous) / 0.5);
      EXPECT_TRUE(time.at_step_end());
      previous = found[k];
    }
  EXPECT_TRUE(time.finished());
}

TEST(TimeControl, CutsTheLengthOfAPathAndEndsAtTheEndTime)
{
  std::vector<TimeParameters> stages{steps(2), steps(8, 2.)};
  stages[1].start_time = 1.;
  stages[1].arc_length = 0.2;
  TimeControl time(stages);
  step(time);
  EXPECT_FALSE(time.follows_path());
  EXPECT_EQ(time.path_length(), 0.);
  step(time);
  time.next();
  time.set_trial_time(1.7);
  EXPECT_TRUE(time.reject("test"));
  EXPECT_EQ(time.time(), 1.);
  EXPECT_EQ(time.trial_time(), 1.);
  time.next();
  EXPECT_NEAR(time.trial_length(), 0.1, 1e-12);
  time.set_trial_time(1.4);
  time.accept(9);

  // Where it goes on from an archive.
  Archive archive;
  time.write(archive);
  TimeControl other(stages);
  other.read(archive);
  EXPECT_EQ(other.time(), 1.4);
  EXPECT_EQ(other.path_rate(), time.path_rate());
  EXPECT_EQ(other.path_length(), time.path_length());
  EXPECT_FALSE(other.finished());

  time.next();
  EXPECT_NEAR(time.trial_length(), 0.1, 1e-12);
  time.set_trial_time(2.);
  time.accept(9);
  EXPECT_TRUE(time.finished());
  Archive at_end;
  time.write(at_end);
  other.read(at_end);
  EXPECT_TRUE(other.finished());
}

namespace
{
  TimeParameters
  divided_steps(const unsigned int n)
  {
    TimeParameters parameters             = steps(n);
    parameters.integrator.integrator      = "Bathe";
    parameters.integrator.spectral_radius = 1.;
    parameters.growth                     = 1.;
    return parameters;
  }
} // namespace

TEST(TimeControl, DividesSteps)
{
  TimeControl time(divided_steps(2));
  for (const double end : {0.5, 1.})
    {
      time.next();
      EXPECT_EQ(time.trial_time(), end - 0.25);
      time.accept(1);
      EXPECT_TRUE(time.between_parts());
      EXPECT_FALSE(time.at_step_end());
      time.next();
      EXPECT_EQ(time.trial_time(), end);
      time.accept(1);
      EXPECT_FALSE(time.between_parts());
      EXPECT_TRUE(time.at_step_end());
    }
  EXPECT_TRUE(time.finished());
  EXPECT_EQ(time.n_accepted(), 2u);
  EXPECT_EQ(time.n_completed_steps(), 2u);
}

TEST(TimeControl, SecondPartsLookBack)
{
  TimeParameters parameters             = divided_steps(1);
  parameters.integrator.spectral_radius = 0.5;
  TimeControl time(parameters);
  time.next();
  EXPECT_FALSE(time.integrator().looks_back());
  time.accept(1);
  time.next();
  EXPECT_TRUE(time.integrator().looks_back());
}

TEST(TimeControl, CutsEitherPartOfAStep)
{
  TimeControl time(divided_steps(1));
  time.next();
  EXPECT_TRUE(time.reject("test"));
  time.next();
  EXPECT_EQ(time.trial_time(), 0.25);
  time.accept(1);
  time.next();
  EXPECT_EQ(time.trial_time(), 0.5);
  EXPECT_TRUE(time.reject("test"));
  time.next();
  EXPECT_EQ(time.trial_time(), 0.375);
  time.accept(1);
  EXPECT_FALSE(time.between_parts());
  EXPECT_FALSE(time.at_step_end());
  // What remains is divided anew, and its end hit.
  unsigned int n = 0;
  for (; !time.finished(); ++n)
    step(time);
  EXPECT_EQ(time.time(), 1.);
  EXPECT_EQ(n % 2, 0u);
}

TEST(TimeControl, GoesOnBetweenPartsOfAStep)
{
  TimeControl time(divided_steps(3));
  step(time);
  time.next();
  EXPECT_TRUE(time.reject("test"));
  Archive archive;
  time.write(archive);
  TimeControl other(divided_steps(3));
  other.read(archive);
  EXPECT_TRUE(other.between_parts());
  other.next();
  EXPECT_EQ(other.trial_time(), 1. / 3);
  other.accept(1);
  EXPECT_EQ(other.n_completed_steps(), 1u);
  // With fewer steps the second part may end at the next.
  TimeParameters fewer = divided_steps(30);
  TimeControl    third(fewer);
  third.read(archive);
  third.next();
  EXPECT_GT(third.trial_time(), third.time());
  EXPECT_LE(third.trial_time(), 1. / 3);
}
