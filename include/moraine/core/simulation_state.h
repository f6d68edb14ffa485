// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_simulation_state_h
#define moraine_core_simulation_state_h

#include <moraine/core/archive.h>

#include <functional>
#include <optional>
#include <vector>

namespace moraine
{
  /**
   * Something that outlives a step: points, what surfaces and loads carry, the
   * mesh, step control, probes, what output has written. It keeps the accepted
   * state apart from what a step tries.
   */
  class StatePart
  {
  public:
    virtual ~StatePart() = default;

    /**
     * Write the accepted state into data sets of names of its own. What can be
     * computed from it is not written.
     */
    virtual void
    write(Archive &archive) const = 0;

    /**
     * Take the accepted state from an archive, bit by bit, and forget what was
     * tried. Collective.
     */
    virtual void
    read(const Archive &archive) = 0;

    /** Forget what was tried since the state was accepted. Collective. */
    virtual void
    undo()
    {}
  };

  /**
   * The owner of everything that outlives a step, kept or undone as a whole:
   *
   *     try
   *       {
   *         // solve for the end of the step
   *         state.keep([&]() { ... every part commits ... });
   *       }
   *     catch (...)
   *       {
   *         state.undo();
   *         throw;
   *       }
   *
   * Whatever throws, the parts are in the last accepted state after undo(). A
   * checkpoint is write() and write_file().
   */
  class SimulationState
  {
  public:
    /** Parts are written and read in the order in which they were added. The
     * part must live as long as this object is used. */
    void
    add(StatePart &part);

    /** The same for what is only written after a step was accepted, such as
     * lists of output: keep() and undo() leave it alone. */
    void
    add_record(StatePart &part);

    /**
     * The one place in which a step is accepted: @p commit writes the state of
     * all parts. If it throws, undo() has to follow.
     */
    void
    keep(const std::function<void()> &commit);

    /**
     * Give all parts what they had before a keep() that threw, if there was
     * one, and let them forget what was tried. Before they read it, @p prepare
     * may look at it. Collective.
     */
    void
    undo(const std::function<void(const Archive &)> &prepare = {});

    void
    write(Archive &archive) const;

    void
    read(const Archive &archive);

  private:
    static void
    write(const std::vector<StatePart *> &parts, Archive &archive);

    static void
    read(const std::vector<StatePart *> &parts, const Archive &archive);

    std::vector<StatePart *> parts;
    std::vector<StatePart *> records;
    /** What was accepted, while keep() is not done. */
    std::optional<Archive> accepted;
  };
} // namespace moraine

#endif
