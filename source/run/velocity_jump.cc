// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/velocity_jump.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Differences of velocities, over the largest, that are no jump. Users
     * round what they write; means of points around a node that is held need
     * not be held as well. */
    constexpr double allowed_at_nodes  = 1e-3;
    constexpr double allowed_of_points = 0.25;

    /** Of sizes that are the same. */
    constexpr double same_size = 1e-9;

    /** Of the first step: over this time the mean velocity of what is
     * prescribed is its derivative at the start. */
    constexpr double short_share = 1e-3;



    /** The largest difference at a place, and the largest velocity at all. */
    template <int dim>
    struct Difference
    {
      Tensor<1, dim> of_body, prescribed;
      Point<dim>     place;
      double         largest_velocity = 0;

      double
      size() const
      {
        return (of_body - prescribed).norm();
      }

      void
      compare(const Tensor<1, dim> &v,
              const Tensor<1, dim> &wanted,
              const Point<dim>     &x)
      {
        largest_velocity =
          std::max({largest_velocity, v.norm(), wanted.norm()});
        const double here = (v - wanted).norm();
        if (here == 0. || (size() > 0. && comes_before(size(), place, here, x)))
          return;
        of_body    = v;
        prescribed = wanted;
        place      = x;
      }

      /** Whether the first one is larger, or as large with a smaller place, so
       * that the choice does not depend on the order. */
      static bool
      comes_before(const double      size_1,
                   const Point<dim> &place_1,
                   const double      size_2,
                   const Point<dim> &place_2)
      {
        if (std::abs(size_1 - size_2) > same_size * std::max(size_1, size_2))
          return size_1 > size_2;
        for (unsigned int d = 0; d < dim; ++d)
          if (place_1[d] != place_2[d])
            return place_1[d] < place_2[d];
        return false;
      }
    };



    double
    first_step_size(const TimeParameters &time)
    {
      return time.largest_step * (time.end_time - time.start_time) /
             time.n_steps;
    }



    /** At nodes: the velocities that bodies have @p given them and those with
     * conditions. Nodes that follow a root begin with what it has. */
    template <int dim>
    void
    compare_nodes(const std::vector<Tensor<1, dim>> &given,
                  const Model<dim>                  &model,
                  Difference<dim>                   &difference)
    {
      const auto       &held = model.motion->velocities();
      std::vector<bool> follows(given.size(), false);
      if (const auto *aggregates = model.state->strict_aggregates())
        for (const auto &tie : aggregates->ties())
          follows[tie.node] = true;
      for (unsigned int k = 0; k < given.size(); ++k)
        difference.compare(follows[k] ? held[k] : given[k],
                           held[k],
                           model.space->node_position(k));
    }



    /** At implicit boundaries that move, the components that they hold. Those
     * at rest only stop what comes. */
    template <int dim>
    void
    compare_surfaces(const std::vector<Tensor<1, dim>> &given,
                     const StageParameters             &stage,
                     const Model<dim>                  &model,
                     const double                       step_size,
                     Difference<dim>                   &difference)
    {
      for (const auto &boundary : model.boundaries)
        if (contains(stage.boundaries, boundary.name()) &&
            !contains(stage.absorbing, boundary.name()))
          for (unsigned int q = 0; q < boundary.points().size(); ++q)
            {
              const BoundaryPoint<dim> &point = boundary.points()[q];
              const auto M = boundary.constraint().projection(point.normal);
              const Tensor<1, dim> wall = M * point.prescribed / step_size;
              if (!(wall.norm() > 0))
                continue;
              const unsigned int *nodes = model.space->cell_nodes(point.cell);
              Tensor<1, dim>      v;
              for (unsigned int a = 0; a < model.space->nodes_per_cell(); ++a)
                v += boundary.N(q)[a] * given[nodes[a]];
              difference.compare(M * v, wall, point.x);
            }
    }



    /** The rank that has the largest one. Collective. */
    template <int dim>
    unsigned int
    rank_of_largest(const Difference<dim> &difference,
                    const MPI_Comm        &communicator)
    {
      const auto sizes =
        Utilities::MPI::all_gather(communicator, difference.size());
      const auto places =
        Utilities::MPI::all_gather(communicator, difference.place);
      unsigned int first = 0;
      for (unsigned int rank = 1; rank < sizes.size(); ++rank)
        if (Difference<dim>::comes_before(
              sizes[rank], places[rank], sizes[first], places[first]))
          first = rank;
      return first;
    }
  } // namespace



  template <int dim>
  void
  set_first_target(const TimeParameters &time, Model<dim> &model)
  {
    model.system->set_target(time.start_time + first_step_size(time));
  }



  template <int dim>
  std::optional<Finding>
  velocity_jump(const StageParameters &stage,
                const bool             first,
                Model<dim>            &model)
  {
    const std::vector<Tensor<1, dim>> given = model.motion->velocities();
    const double short_step = short_share * first_step_size(stage.time);
    model.system->set_target(stage.time.start_time + short_step);
    Difference<dim> difference;
    compare_nodes(given, model, difference);
    compare_surfaces(given, stage, model, short_step, difference);
    set_first_target(stage.time, model);

    std::string text;
    if (difference.prescribed.norm() != 0)
      text = fmt::format("the velocity at ({}) jumps from ({}) to ({}) at t = "
                         "{:.3g}, where what holds the body starts",
                         coordinates(difference.place, 3),
                         coordinates(difference.of_body, 3),
                         coordinates(difference.prescribed, 3),
                         stage.time.start_time);
    else if (first)
      text = fmt::format("section 'Bodies', key 'Initial velocity': found ({}) "
                         "at the node ({}), where conditions want ({}), "
                         "allowed: velocities that agree with what holds the "
                         "body",
                         coordinates(difference.of_body),
                         coordinates(difference.place),
                         coordinates(difference.prescribed));
    const MPI_Comm     communicator = model.space->communicator();
    const unsigned int rank         = rank_of_largest(difference, communicator);
    const double       allowed =
      model.state->mesh_after_step() == MeshAfterStep::reset ?
              allowed_of_points :
              allowed_at_nodes;
    const double share =
      Utilities::MPI::max(difference.size(), communicator) /
      Utilities::MPI::max(difference.largest_velocity, communicator);
    if (!(share > allowed))
      return {};
    const std::string found =
      Utilities::MPI::all_gather(communicator, text)[rank];
    if (found.rfind("section", 0) == 0)
      throw InputError(found);
    return Finding{"velocity-jump", "", share, allowed, found};
  }



#define INSTANTIATE(dim)                                    \
  template decltype(velocity_jump<dim>) velocity_jump<dim>; \
  template void set_first_target(const TimeParameters &, Model<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
