// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/core/simulation_state.h>

#include <gtest/gtest.h>

#include <string>

#include "message.h"

using namespace moraine;

namespace
{
  /** A number with a trial value. */
  class Number : public StatePart
  {
  public:
    explicit Number(const std::string &name)
      : name(name)
    {}

    void
    write(Archive &archive) const override
    {
      archive.write(name, accepted);
    }

    void
    read(const Archive &archive) override
    {
      accepted = archive.number(name);
      undo();
    }

    void
    undo() override
    {
      trial = accepted;
    }

    const std::string name;
    double            accepted = 0;
    double            trial    = 0;
  };
} // namespace



TEST(SimulationState, KeepsAllOrNothing)
{
  Number          a("a"), b("b");
  SimulationState state;
  state.add(a);
  state.add(b);
  a.trial = 1;
  b.trial = 2;
  state.keep([&]() {
    a.accepted = a.trial;
    b.accepted = b.trial;
  });
  EXPECT_EQ(a.accepted, 1.);
  EXPECT_EQ(b.accepted, 2.);

  a.trial = 10;
  b.trial = 20;
  EXPECT_EQ(message_of<ComputationError>([&]() {
              state.keep([&]() {
                a.accepted = a.trial;
                throw ComputationError("between the parts");
              });
            }),
            "between the parts");
  state.undo();
  EXPECT_EQ(a.accepted, 1.);
  EXPECT_EQ(a.trial, 1.);
  EXPECT_EQ(b.trial, 2.);
}



TEST(SimulationState, UndoForgetsTheTrial)
{
  Number          a("a");
  SimulationState state;
  state.add(a);
  a.trial = 5;
  state.undo();
  EXPECT_EQ(a.trial, 0.);
}



TEST(SimulationState, WhatIsWrittenIsRead)
{
  Number          a("a"), b("b"), c("a"), d("b");
  SimulationState written, read;
  written.add(a);
  written.add(b);
  read.add(c);
  read.add(d);
  a.accepted = 3;
  b.accepted = 4;
  Archive archive;
  written.write(archive);
  read.read(archive);
  EXPECT_EQ(c.accepted, 3.);
  EXPECT_EQ(d.accepted, 4.);
}
