// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_buckling_watch_h
#define moraine_run_buckling_watch_h

#include <moraine/core/archive.h>

#include <moraine/run/model.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Watches for stress that makes slender bodies buckle, which small strain has
   * too late: asks for geometric_share() in the step that ends the run and in
   * quasi-static ones that move much further than those before them, as what
   * grows without bound does; when it has grown, stress is another.
   */
  template <int dim>
  class BucklingWatch
  {
  public:
    BucklingWatch(const Model<dim>             &model,
                  const LinearSolverParameters &solver);

    /** Displacements will not know any more how bodies are strained.
     * Collective. */
    void
    displacements_begin_anew();

    /** In the trial state @p x that is to be accepted. @p ends: the run ends
     * with it. Collective. */
    void
    try_step(const LA::Vector &x,
             const bool        ends,
             const bool        quasi_static,
             const double      largest_motion);

    /** The step of try_step() is accepted, or the last. Collective. */
    void
    keep_step();

    /** What stress makes of the bodies, if it was 0.1 or more and more than
     * their strain explains. */
    std::vector<std::string>
    doubts() const;

    /** Data sets "run/...". */
    void
    write(Archive &archive) const;

    void
    read(const Archive &archive);

  private:
    const Model<dim>             &model;
    const LinearSolverParameters &solver;
    double                        trial_share      = 0;
    double                        largest_share    = 0;
    double                        strain_at_resets = 0; ///< largest mean one
    /** In the step of the last share, or in the first. */
    double motion_of_share = 0;
  };
} // namespace moraine

#endif
