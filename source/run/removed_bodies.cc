// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/removed_bodies.h>

#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <limits>
#include <vector>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Finds the bodies that places of a surface lie on. */
    template <int dim>
    class Grounds
    {
    public:
      Grounds(const StageParameters &stage, const Model<dim> &model)
        : model(model)
        , goes(model.bodies.size())
      {
        for (unsigned int b = 0; b < goes.size(); ++b)
          goes[b] =
            model.present[b] && !contains(stage.bodies, model.body_names[b]);
      }

      /** Whether a body goes that the points @p acts_on are of. */
      template <typename Predicate>
      bool
      any_goes(const Predicate &acts_on) const
      {
        unsigned int found = 0;
        for (unsigned int p = 0; p < model.points->n_local(); ++p)
          if (acts_on(p) && goes[model.points->body(p)])
            found = 1;
        return Utilities::MPI::max(found, model.space->communicator()) > 0;
      }

      void
      clear()
      {
        areas.assign(goes.size() + 1, 0.);
      }

      /** A place of the surface, if its cell keeps a body. */
      void
      add(const Point<dim> &x, const unsigned int cell, const double area)
      {
        const auto [first, last] = model.points->points_in(cell);
        double       nearest     = std::numeric_limits<double>::max();
        unsigned int body        = 0;
        bool         keeps       = false;
        for (unsigned int p = first; p < last; ++p)
          {
            const unsigned int b = model.points->body(p);
            keeps                = keeps || !goes[b];
            const double away    = model.points->position(p).distance(x);
            if (away < nearest)
              {
                nearest = away;
                body    = b;
              }
          }
        if (keeps)
          {
            areas[body] += area;
            areas.back() += area;
          }
      }

      /** The body that goes on which most of the places lie; "" without one.
       * Collective. */
      std::string
      lost()
      {
        Utilities::MPI::sum(areas, model.space->communicator(), areas);
        for (unsigned int b = 0; b < goes.size(); ++b)
          if (goes[b] && areas[b] > 0.5 * areas.back())
            return model.body_names[b];
        return "";
      }

    private:
      const Model<dim>   &model;
      std::vector<bool>   goes;  ///< bodies
      std::vector<double> areas; ///< and the sum
    };
  } // namespace



  template <int dim>
  void
  tell_of_removed_bodies(const StageParameters    &stage,
                         const StageParameters    &before,
                         const Model<dim>         &model,
                         std::vector<std::string> &notes)
  {
    Grounds<dim> grounds(stage, model);
    const auto   tell = [&](const std::string &name, const std::string &key) {
      const std::string body = grounds.lost();
      if (!body.empty())
        notes.push_back(name + ": lies on '" + body +
                        "', which is gone, and from now on acts on what is "
                          "left beside it; leave it out of '" +
                        key + "' of the stage unless that is meant");
    };
    for (const auto &load : model.loads.carried)
      if (contains(stage.loads, load.name()) &&
          contains(before.loads, load.name()))
        {
          grounds.clear();
          for (const auto &place : load.places())
            if (place.active_cell_index != GridSpace<dim>::no_cell)
              grounds.add(place.x, place.active_cell_index, place.weight);
          tell(load.name(), "Loads");
        }
    for (const auto &boundary : model.boundaries)
      if (contains(stage.boundaries, boundary.name()) &&
          contains(before.boundaries, boundary.name()) &&
          !contains(stage.absorbing, boundary.name()))
        {
          grounds.clear();
          for (const auto &place : boundary.points())
            grounds.add(place.x, place.cell, place.JxW);
          tell(boundary.name(), "Boundaries");
        }
    for (const auto &force : model.loads.on_points)
      if (contains(stage.loads, force.name()) &&
          contains(before.loads, force.name()) &&
          grounds.any_goes(
            [&force](const unsigned int p) { return force.acts_on(p); }))
        notes.push_back(force.name() +
                        ": the body of its points is gone, and it with them");
  }



  template void
  tell_of_removed_bodies(const StageParameters &,
                         const StageParameters &,
                         const Model<2> &,
                         std::vector<std::string> &);
  template void
  tell_of_removed_bodies(const StageParameters &,
                         const StageParameters &,
                         const Model<3> &,
                         std::vector<std::string> &);
} // namespace moraine
