// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_hold_watch_h
#define moraine_run_hold_watch_h

#include <moraine/run/model.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Looks whether what acts keeps the material that it acts on. Nodes, sides
   * of the mesh and surfaces with a 'Displacement' stay where they are while
   * they move material, or what pushes on a side does; material that has left
   * their cells is not held any more, and nothing else of a run shows it.
   */
  template <int dim>
  class HoldWatch : public StatePart
  {
  public:
    HoldWatch(const Scene<dim> &scene, const Model<dim> &model);

    /** What acts may be another: what it holds is counted anew. */
    void
    stage_begins();

    /**
     * In a step of @p stage that has begun at @p t: what is to be told, each
     * once. Collective.
     * @throws ComputationError if something that moves or pushes material had
     * some and has none any more.
     */
    std::vector<std::string>
    look(const StageParameters &stage, const double t);

    /** Data sets "checks/holds/...": what was held at most, what was told. */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    /** A component that a condition prescribes at a node. */
    struct HeldPlace
    {
      dealii::Point<dim> x;
      unsigned int       component;
    };

    /** Find anew what grid conditions hold and side tractions push. */
    void
    count(const StageParameters &stage, const double t);

    /** That a condition has pushed material off its nodes; or "". */
    std::string
    pushed_off(const unsigned int     condition,
               const StageParameters &stage,
               const double           t);

    /** The same of a boundary, whose 'Displacement' has moved material through
     * its surface; or "". */
    std::string
    moved_through(const ImplicitBoundary<dim> &boundary,
                  const StageParameters       &stage,
                  const double                 t);

    /** That a boundary which goes with the material holds nothing any more,
     * with @p n places by @p t, without inertia; or "". */
    std::string
    torn_off(const std::string &section, const unsigned int n, const double t);

    /**
     * Compare @p n pieces of what is held by @p t with the most so far.
     * @param section of the input that says what acts
     * @param remedy what helps
     * @return the most
     * @throws ComputationError if there were some and none is left.
     */
    unsigned int
    check_that_some_is_left(const std::string &section,
                            const unsigned int n,
                            const double       t,
                            const std::string &remedy);

    /** The same of the faces that a load pushes on; that some are lost or new,
     * or "". */
    std::string
    other_faces(const std::string &section,
                const unsigned int n,
                const double       t);

    /** That material has moved away from the side on which a load pushes; or
     * "". */
    std::string
    left_behind(const SideTraction<dim> &traction, const double t);

    const Scene<dim>               &scene;
    const Model<dim>               &model;
    std::vector<GridCondition<dim>> conditions; ///< that act
    /** Of each, on this rank, when it held most: nodes may all be lost in one
     * step. */
    std::vector<std::vector<HeldPlace>> held;
    std::vector<unsigned int>           n_nodes; ///< of each, by now
    bool                                counted = false;
    std::map<std::string, unsigned int> most; ///< pieces, by section
    std::set<std::string>               told;
  };

} // namespace moraine

#endif
