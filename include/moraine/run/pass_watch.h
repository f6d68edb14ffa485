// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_pass_watch_h
#define moraine_run_pass_watch_h

#include <moraine/run/model.h>

#include <deal.II/base/bounding_box.h>

#include <set>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Looks whether bodies whose nodes stay with the material, which know nothing
   * of each other, move into each other, or through a side of the mesh that has
   * a condition and no body at it. Goes by the boxes around bodies along the
   * axes: what was apart at the start and overlaps by now. Where points move
   * through the mesh, whether bodies with such boxes come to touch the same
   * nodes, by which they hang together. Displacements that a stage has reset
   * end it.
   */
  template <int dim>
  class PassWatch : public StatePart
  {
  public:
    explicit PassWatch(const Model<dim> &model);

    /** After a step in which the node that moved furthest did so by @p motion:
     * what hardly moves need not be looked at. */
    void
    add_motion(const double motion)
    {
      since_look += motion;
    }

    /** As a step of @p stage begins at @p t: what is to be told, of each pair
     * once; or "". Collective. */
    std::string
    look(const StageParameters &stage, const double t);

    /** Data sets "checks/passes/...". */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    using Box = dealii::BoundingBox<dim>;

    /** Around the points of each body at the start, or with @p moved, by now.
     */
    std::vector<Box>
    boxes_of_bodies(const bool moved) const;

    std::string
    pair_that_met(const std::vector<Box> &start, const std::vector<Box> &now);

    /** Collective. */
    std::string
    pair_that_sticks(const std::vector<Box> &start,
                     const std::vector<Box> &now);

    std::string
    side_passed(const StageParameters &stage, const std::vector<Box> &now);

    const Model<dim>     &model;
    std::set<std::string> told;           ///< pairs, or body and condition
    double                since_look = 0; ///< motion since then [length]
  };
} // namespace moraine

#endif
