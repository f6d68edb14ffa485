// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/simulation_state.h>

namespace moraine
{
  void
  SimulationState::add(StatePart &part)
  {
    parts.push_back(&part);
  }



  void
  SimulationState::add_record(StatePart &part)
  {
    records.push_back(&part);
  }



  void
  SimulationState::keep(const std::function<void()> &commit)
  {
    accepted.emplace();
    write(parts, *accepted);
    commit();
    accepted.reset();
  }



  void
  SimulationState::undo(const std::function<void(const Archive &)> &prepare)
  {
    if (accepted && prepare)
      prepare(*accepted);
    if (accepted)
      read(parts, *accepted);
    accepted.reset();
    for (StatePart *part : parts)
      part->undo();
  }



  void
  SimulationState::write(Archive &archive) const
  {
    write(parts, archive);
    write(records, archive);
  }



  void
  SimulationState::read(const Archive &archive)
  {
    read(parts, archive);
    read(records, archive);
  }



  void
  SimulationState::write(const std::vector<StatePart *> &parts,
                         Archive                        &archive)
  {
    for (const StatePart *part : parts)
      part->write(archive);
  }



  void
  SimulationState::read(const std::vector<StatePart *> &parts,
                        const Archive                  &archive)
  {
    for (StatePart *part : parts)
      part->read(archive);
  }
} // namespace moraine
