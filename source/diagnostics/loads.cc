// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What loads, conditions and boundaries act on.

#include <moraine/core/exceptions.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/checks.h>
#include <moraine/scene/scene_curves.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  namespace checks
  {
    using namespace dealii;

    namespace
    {
      /** Of the force of a load: what finer places would change. */
      constexpr double allowed_error_of_force = 0.05;

      /** More points are not looked at. */
      constexpr unsigned int most_points = 20000;

      /** Of the surface of a load. */
      constexpr double allowed_outside = 0.05;

      /** Of a cell: by then the force on a pressed column is 3 % too small. */
      constexpr double allowed_push = 0.25;



      /** The value at @p x, or @p otherwise where it is no number: @p x may be
       * off the body. */
      template <int dim>
      Tensor<1, dim>
      value_or(const VectorFunction<dim> &value,
               const Point<dim>          &x,
               const double               t,
               const Tensor<1, dim>      &otherwise)
      {
        try
          {
            return value(x, t);
          }
        catch (const InputError &)
          {
            return otherwise;
          }
      }



      /** The difference of a body force at the points and at finer places in
       * the cubes they stand for, over the sum of its magnitudes. */
      template <int dim>
      double
      error_of_force(const BodyForce<dim> &load,
                     const Facts<dim>     &facts,
                     const double          t)
      {
        const PointSet<dim> &points = facts.of.points;
        const QIterated<dim> of_cube(QMidpoint<1>(), dim == 2 ? 6 : 3);
        Tensor<1, dim>       difference;
        double               size = 0;
        for (unsigned int p = 0; p < points.n_local(); ++p)
          {
            const unsigned int body = points.body(p);
            if (!load.acts_on[body])
              continue;
            const double V    = points.volume(p);
            const double edge = std::pow(V, 1. / dim);
            const double of_value =
              (load.times_density ? facts.of.materials[body]->density() : 1.) *
              V;
            const Point<dim>     x     = load.at_start ?
                                           facts.of.state.original_position(p) :
                                           points.position(p);
            const Tensor<1, dim> value = value_or(load.value, x, t, {});
            difference += of_value * value;
            for (const Point<dim> &xi : of_cube.get_points())
              {
                Tensor<1, dim> way = xi;
                for (unsigned int d = 0; d < dim; ++d)
                  way[d] -= 0.5;
                const Tensor<1, dim> part =
                  of_value / of_cube.size() *
                  value_or(load.value, x + edge * way, t, value);
                difference -= part;
                size += part.norm();
              }
          }
        difference = Utilities::MPI::sum(difference, facts.communicator());
        size       = Utilities::MPI::sum(size, facts.communicator());
        return size > 0 ? difference.norm() / size : 0.;
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    coarse_loads(Facts<dim> &facts, Ledger &)
    {
      if (Utilities::MPI::sum(facts.of.points.n_local(), facts.communicator()) >
          most_points)
        return {};
      const TimeParameters &time = facts.now.stage->time;
      for (const auto &force : facts.of.loads.body_forces)
        if (contains(facts.now.stage->loads, force.name))
          for (const double part : {0.4, 1.})
            if (const double error =
                  error_of_force(force,
                                 facts,
                                 time.start_time +
                                   part * (time.end_time - time.start_time));
                error > allowed_error_of_force)
              return Finding{"coarse-load",
                             force.name,
                             error,
                             allowed_error_of_force,
                             "points miss its force by " + per_cent(error) +
                               ", as its expression changes between them; let "
                               "it change on mesh lines, or take smaller "
                               "cells"};
      return {};
    }



    template <int dim>
    std::optional<Finding>
    loads_outside(Facts<dim> &facts, Ledger &)
    {
      for (const auto &load : facts.of.loads.carried)
        if (const double share = load.share_outside(); share > allowed_outside)
          return Finding{"load-outside",
                         load.name(),
                         share,
                         allowed_outside,
                         per_cent(share) +
                           " of its surface is outside the mesh or beside no "
                           "body and does not act"};
      return {};
    }



    template <int dim>
    std::optional<Finding>
    idle_conditions(Facts<dim> &facts, Ledger &)
    {
      const auto idle = idle_curves(facts.of.scene);
      if (!idle.empty() && !facts.now.before)
        return Finding{"no-effect",
                       idle.front(),
                       0,
                       0,
                       "its curve is 0 or does not change while it acts; "
                       "-0.1*t reaches -0.1 at t = 1"};
      const auto active =
        acting_conditions(facts.of.grid_conditions, *facts.now.stage);
      std::vector<unsigned int> n(active.size(), 0), acts = n;
      for (const auto &entry :
           find_prescribed_nodes(active,
                                 facts.of.space,
                                 facts.now.stage->time.start_time)
             .entries)
        {
          ++n[entry.condition];
          const auto value = [&](const double t) {
            return active[entry.condition].displacement(
              facts.of.space.built_position(entry.node), t)[entry.component];
          };
          const TimeParameters &time = facts.now.stage->time;
          if (value(time.start_time) == 0 ||
              value(time.start_time) != value(time.end_time) ||
              active[entry.condition].motion.moves())
            ++acts[entry.condition];
        }
      Utilities::MPI::sum(n, facts.communicator(), n);
      Utilities::MPI::sum(acts, facts.communicator(), acts);
      for (unsigned int c = 0; c < active.size(); ++c)
        if (n[c] > 0 && acts[c] == 0 && facts.now.before &&
            !contains(facts.now.before->grid_conditions, active[c].name))
          return Finding{"no-effect",
                         active[c].name,
                         0,
                         0,
                         "its 'Displacement' is constant, and only its change "
                         "from the start of the stage acts"};
        else if (n[c] == 0)
          return Finding{"no-effect",
                         active[c].name,
                         0,
                         0,
                         "it holds no node of a body as it begins"};
      return {};
    }



    namespace
    {
      /** Finds the bodies that places of a surface lie on, before some go. */
      template <int dim>
      class Ground
      {
      public:
        explicit Ground(const Facts<dim> &facts)
          : facts(facts)
          , areas(facts.of.bodies.size(), 0.)
        {}

        /** A place of the surface, in a cell of this rank. */
        void
        add(const Point<dim> &x, const unsigned int cell, const double area)
        {
          const auto [first, last] = facts.of.points.points_in(cell);
          double       nearest     = std::numeric_limits<double>::max();
          unsigned int body        = areas.size();
          for (unsigned int p = first; p < last; ++p)
            {
              const double away = facts.of.points.position(p).distance(x);
              if (away < nearest)
                {
                  nearest = away;
                  body    = facts.of.points.body(p);
                }
            }
          if (body < areas.size())
            areas[body] += area;
        }

        /** The share of the surface on bodies that go. Collective. */
        double
        lost()
        {
          Utilities::MPI::sum(areas, facts.communicator(), areas);
          double all = 0, gone = 0;
          for (unsigned int b = 0; b < areas.size(); ++b)
            {
              all += areas[b];
              if (facts.of.present[b] &&
                  !contains(facts.now.stage->bodies, facts.of.body_names[b]))
                gone += areas[b];
            }
          areas.assign(areas.size(), 0.);
          return all > 0 ? gone / all : 0.;
        }

      private:
        const Facts<dim>   &facts;
        std::vector<double> areas; ///< by body
      };
    } // namespace



    template <int dim>
    std::optional<Finding>
    removed_bodies(Facts<dim> &facts, Ledger &)
    {
      constexpr double allowed = 0.05;
      const auto      &stage = *facts.now.stage, &before = *facts.now.before;
      if (stage.bodies == before.bodies && stage.loads == before.loads)
        return {};
      Worst worst("removed-body", allowed);
      // A surface may go on beside what is dug.
      const auto take_most = [&worst](const std::string &name,
                                      const double       share) {
        if (share > 0.5)
          worst.take(name, share);
      };
      Ground<dim> ground(facts);
      for (const auto &load : facts.of.loads.carried)
        if (contains(stage.loads, load.name()) &&
            contains(before.loads, load.name()))
          {
            for (const auto &place : load.places())
              if (place.active_cell_index != GridSpace<dim>::no_cell)
                ground.add(place.x, place.active_cell_index, place.weight);
            take_most(load.name(), ground.lost());
          }
      for (const auto &boundary : facts.of.boundaries)
        if (facts.holds(boundary.name()) &&
            contains(before.boundaries, boundary.name()))
          {
            for (const auto &point : boundary.points())
              ground.add(point.x, point.cell, point.JxW);
            take_most(boundary.name(), ground.lost());
          }
      for (const auto &force : facts.of.loads.on_points)
        if (contains(stage.loads, force.name()))
          {
            std::vector<unsigned int> n{0, 0}; // points that stay, that go
            for (unsigned int p = 0; p < facts.of.points.n_local(); ++p)
              if (force.is_on(facts.of.points.id(p)))
                ++n[contains(stage.bodies,
                             facts.of.body_names[facts.of.points.body(p)]) ?
                      0 :
                      1];
            Utilities::MPI::sum(n, facts.communicator(), n);
            // Or they went while it did not act.
            if (n[1] > 0 || !contains(before.loads, force.name()))
              worst.take(force.name(), 1 - 1. * n[0] / force.n_points());
          }
      return worst.with(per_cent(worst.value) +
                        " of it lies on a body that goes; leave it out of the "
                        "stage unless it shall act on what is left");
    }



    template <int dim>
    std::optional<Finding>
    absorbing_at_rest(Facts<dim> &facts, Ledger &)
    {
      if (facts.now.stage->time.integrator.dynamic())
        return {};
      for (const auto &boundary : facts.of.absorbing_boundaries)
        {
          const std::string &name = boundary.name();
          if (contains(boundary.is_on_side() ?
                         facts.now.stage->grid_conditions :
                         facts.now.stage->boundaries,
                       name) &&
              !facts.of.scene.absorbs_later(name) &&
              boundary.law().springs == AbsorbingLaw::Springs::none)
            return Finding{"absorbing-boundary",
                           name,
                           0,
                           0,
                           "it holds nothing in a stage without inertia; name "
                           "it in 'Absorbing' of the stage with waves"};
        }
      return {};
    }



    template <int dim>
    std::optional<Finding>
    absorbing_on_new_bodies(Facts<dim> &facts, Ledger &)
    {
      if (!facts.now.before)
        return {};
      std::vector<std::string> come;
      for (const std::string &body : facts.now.stage->bodies)
        if (facts.is_new(body))
          come.push_back(body);
      for (const auto &boundary : facts.of.absorbing_boundaries)
        if (!come.empty() &&
            absorbs_in(*facts.now.before, facts.of.scene, boundary) &&
            absorbs_in(*facts.now.stage, facts.of.scene, boundary))
          return Finding{"absorbing-boundary",
                         boundary.name(),
                         1. * come.size(),
                         0,
                         list_of(come) +
                           " came later and is free where it touches it; add "
                           "a second absorbing boundary that begins with it"};
      return {};
    }



    template <int dim>
    std::optional<Finding>
    lost_boundaries(Facts<dim> &facts, Ledger &ledger)
    {
      for (const auto &boundary : facts.of.boundaries)
        {
          const std::string &name = boundary.name();
          if (!facts.holds(name))
            continue;
          const double n = boundary.n_points(facts.communicator());
          double &most = ledger.number("lost-hold/of stage: points of " + name);
          most         = std::max(most, n);
          // In dynamics a body may leave a wall.
          if (n == 0 && most > 0 && !facts.has_inertia())
            return Finding{"lost-hold",
                           name,
                           0,
                           most,
                           "no material is left at it, and its force is zero; "
                           "take shorter steps or smaller cells"};
        }
      return {};
    }



    namespace
    {
      /** Whether a condition prescribes anything but rest. */
      template <int dim>
      bool
      moves(const GridCondition<dim> &condition, const Facts<dim> &facts)
      {
        for (const auto &[name, parameters] : facts.of.scene.grid_conditions)
          if (name == condition.name &&
              parameters.displacement.find_first_not_of("0.; ") !=
                std::string::npos)
            return true;
        return condition.motion.moves();
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    pushed_off_nodes(Facts<dim> &facts, Ledger &ledger)
    {
      if (facts.of.state.mesh_after_step() != MeshAfterStep::reset ||
          facts.of.mesh_motion.moves())
        return {};
      Worst worst("lost-hold", allowed_push);
      for (const auto &condition :
           acting_conditions(facts.of.grid_conditions, *facts.now.stage))
        {
          if (!moves(condition, facts))
            continue;
          // Along a side of a box other material comes.
          const bool   of_box  = condition.side && facts.of.mesh.box_grid();
          double       largest = 0;
          unsigned int n       = 0;
          for (const auto &entry : find_prescribed_nodes<dim>({condition},
                                                              facts.of.space,
                                                              facts.now.t)
                                     .entries)
            {
              ++n;
              const Point<dim> x = facts.of.space.node_position(entry.node);
              if (!of_box || entry.component == *condition.side / 2)
                largest = std::max(
                  largest,
                  std::abs(condition.increment(x,
                                               x,
                                               facts.now.stage->time.start_time,
                                               facts.now.t)[entry.component]));
            }
          n = Utilities::MPI::sum(n, facts.communicator());
          double &push =
            ledger.number("lost-hold/of stage: push of " + condition.name);
          push = std::max(push,
                          Utilities::MPI::max(largest, facts.communicator()) /
                            facts.cell_size());
          double &most =
            ledger.number("lost-hold/of stage: nodes of " + condition.name);
          most = std::max(most, 1. * n);
          if (n == 0 && most > 0)
            throw ComputationError("section 'Grid conditions/" +
                                   condition.name +
                                   "': no material is left where it acts; use "
                                   "a boundary with 'Translation', or 'Mesh "
                                   "motion'");
          worst.take(condition.name, push);
        }
      return worst.with("it has pushed material off its nodes, which stay; use "
                        "a boundary with 'Translation', or 'Mesh motion'");
    }



    MORAINE_INSTANTIATE_CHECK(coarse_loads)
    MORAINE_INSTANTIATE_CHECK(loads_outside)
    MORAINE_INSTANTIATE_CHECK(idle_conditions)
    MORAINE_INSTANTIATE_CHECK(removed_bodies)
    MORAINE_INSTANTIATE_CHECK(absorbing_at_rest)
    MORAINE_INSTANTIATE_CHECK(absorbing_on_new_bodies)
    MORAINE_INSTANTIATE_CHECK(lost_boundaries)
    MORAINE_INSTANTIATE_CHECK(pushed_off_nodes)
  } // namespace checks
} // namespace moraine
