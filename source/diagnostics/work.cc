// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Balance of forces and of work over the steps of a run.

#include <moraine/core/words.h>
#include <moraine/diagnostics/checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  namespace checks
  {
    using namespace dealii;

    namespace
    {
      /**
       * Forces out of balance in the mean, and steps at least. Beams, bars and
       * columns of standard MPM whose forces or settlements were 7 to 70 % off
       * had 0.4 to 0.9 of them; blocks that hardly move, less than 0.2.
       */
      constexpr double       allowed_imbalance = 0.25;
      constexpr unsigned int least_steps       = 3;

      /** Stress over the stiffness of the stiffest material. */
      constexpr double unstressed = 1e-8;



      template <int dim>
      bool
      has_stress(const Facts<dim> &facts)
      {
        const PointSet<dim> &points  = facts.of.points;
        double               largest = 0;
        for (unsigned int p = 0; p < points.n_local(); ++p)
          largest =
            std::max(largest, points.stress_field()(points.values(p)).norm());
        return Utilities::MPI::max(largest, facts.communicator()) >
               unstressed * facts.largest_modulus();
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    cell_crossing(Facts<dim> &facts, Ledger &ledger)
    {
      // What begins to act in a stage is out of balance with a right.
      double    &begins  = ledger.number("cell-crossing/stage has begun");
      const bool goes_on = begins != 0;
      begins             = 1;
      if (!goes_on || facts.now.stage->time.integrator.dynamic() ||
          facts.of.scene.method.method != "material point" ||
          facts.of.state.mesh_after_step() != MeshAfterStep::reset ||
          !has_stress(facts))
        return {};
      double &n     = ledger.number("cell-crossing/steps");
      double &share = ledger.number("cell-crossing/sum of shares");
      share += facts.of.system.unbalanced_share();
      if (++n < least_steps || share < allowed_imbalance * n)
        return {};
      return Finding{"cell-crossing",
                     "points",
                     share / n,
                     allowed_imbalance,
                     "points cross cells: " + per_cent(share / n) +
                       " of the forces are out of balance as steps begin; use "
                       "'Method = GIMP'"};
    }



    namespace
    {
      /** Over the fastest step before. A load that grows evenly up to the limit
       * makes the last step before it up to three times as fast. */
      constexpr double slide_ratio = 5;

      /** Over the fastest step before: a load begins. */
      constexpr double next_to_none = 1e-4;

      /** Over the fastest step of a slide: it has come to rest. */
      constexpr double rests_below = 0.3;

      /** Of a cell: a slide, not a jerk. */
      constexpr double least_slide = 0.02;

      /** Steps of a stage before a slide; fast steps of a slide that rests but
       * moves faster than all before it; fast steps of a slide at most. */
      constexpr unsigned int steps_before = 3, least_fast = 2, most_fast = 5;
    } // namespace



    template <int dim>
    std::optional<Finding>
    slide(Facts<dim> &facts, Ledger &ledger)
    {
      const auto number = [&ledger](const std::string &name) -> double & {
        return ledger.number("slide/" + name);
      };
      const double before =
        number("begun") == 0 ? facts.of.scene.start_time() : number("time");
      number("begun") = 1;
      number("time")  = facts.now.t;
      if (!facts.of.state.dissipates() || facts.has_inertia() ||
          facts.now.follows_path ||
          facts.of.state.mesh_after_step() == MeshAfterStep::keep)
        return {};
      const double motion  = facts.now.node_motion;
      const double rate    = motion / std::abs(facts.now.t - before);
      double      &fastest = number("of stage: fastest"),
             &n_steps      = number("of stage: steps"),
             &n_fast       = number("of stage: fast steps"),
             &n_as_fast    = number("of stage: as fast"),
             &slid_by      = number("of stage: slid by"),
             &fast_rate    = number("of stage: fast rate"),
             &fast_time    = number("of stage: fast time");
      const bool rests     = n_fast > 0 && rate < rests_below * fast_rate;
      if (n_steps++ >= steps_before && rate > slide_ratio * fastest &&
          fastest > next_to_none * rate && n_fast < most_fast &&
          !(rests && n_as_fast >= least_fast))
        {
          ++n_fast;
          n_as_fast += rests ? 0 : 1;
          slid_by += motion;
          if (rate > fast_rate)
            {
              fast_rate = rate;
              fast_time = facts.now.t;
            }
          return {};
        }
      std::optional<Finding> found;
      if (rests && slid_by > least_slide * facts.cell_size())
        found = {"slide",
                 "",
                 fast_rate / fastest,
                 slide_ratio,
                 "material slid in the step to t = " + text_of(fast_time, 3) +
                   ": a limit load is passed; find it by 'Kind = factor of "
                   "safety' in section 'Study'"};
      fastest = std::max(fastest, rests ? rate : std::max(rate, fast_rate));
      n_fast = n_as_fast = slid_by = fast_rate = fast_time = 0;
      return found;
    }



    MORAINE_INSTANTIATE_CHECK(cell_crossing)
    MORAINE_INSTANTIATE_CHECK(slide)
  } // namespace checks
} // namespace moraine
