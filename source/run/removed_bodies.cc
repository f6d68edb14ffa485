// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/removed_bodies.h>

#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
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

      /** How many of the points that @p force is on stay, and how many go.
       * Collective. */
      std::pair<unsigned int, unsigned int>
      n_points(const ForceOnPoints<dim> &force) const
      {
        std::vector<unsigned int> n{0, 0};
        for (unsigned int p = 0; p < model.points->n_local(); ++p)
          if (force.is_on(model.points->id(p)))
            ++n[goes[model.points->body(p)] ? 1 : 0];
        Utilities::MPI::sum(n, model.space->communicator(), n);
        return {n[0], n[1]};
      }

      void
      clear()
      {
        areas.assign(goes.size() + 1, 0.);
      }

      /** A place of the surface, if its cell keeps a body; with @p keeping
       * false, if it loses all of them. */
      void
      add(const Point<dim>  &x,
          const unsigned int cell,
          const double       area,
          const bool         keeping = true)
      {
        const auto [first, last] = model.points->points_in(cell);
        bool keeps               = false;
        for (unsigned int p = first; p < last; ++p)
          keeps = keeps || !goes[model.points->body(p)];
        if (first < last && keeps == keeping)
          {
            areas[nearest_body(x, cell)] += area;
            areas.back() += area;
          }
      }

      /** Whether the body goes that a place in a cell of this rank is on; a
       * cell without points is on the rim of a body, which is asked as it was
       * drawn. */
      bool
      is_on_what_goes(const Point<dim> &x, const unsigned int cell) const
      {
        const auto [first, last] = model.points->points_in(cell);
        if (first < last)
          return goes[nearest_body(x, cell)];
        double nearest = std::numeric_limits<double>::max();
        bool   of_goes = false;
        for (unsigned int b = 0; b < goes.size(); ++b)
          if (model.present[b] && model.bodies[b].shape)
            {
              const double away =
                -model.bodies[b].shape->distance(x, model.mesh->cell_size());
              if (away < nearest)
                {
                  nearest = away;
                  of_goes = goes[b];
                }
            }
        return of_goes;
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
      /** That of the nearest point in a cell that has points. */
      unsigned int
      nearest_body(const Point<dim> &x, const unsigned int cell) const
      {
        const auto [first, last] = model.points->points_in(cell);
        double       nearest     = std::numeric_limits<double>::max();
        unsigned int body        = 0;
        for (unsigned int p = first; p < last; ++p)
          {
            const double away = model.points->position(p).distance(x);
            if (away < nearest)
              {
                nearest = away;
                body    = model.points->body(p);
              }
          }
        return body;
      }

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
          grounds.clear();
          for (const auto &place : load.places())
            if (place.active_cell_index != GridSpace<dim>::no_cell)
              grounds.add(place.x,
                          place.active_cell_index,
                          place.weight,
                          false);
          if (const std::string body = grounds.lost(); !body.empty())
            notes.push_back(load.name() + ": lies on '" + body +
                            "', which is gone; leave it out of 'Loads' of the "
                            "stage");
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
      if (contains(stage.loads, force.name()))
        {
          const auto [stay, go]  = grounds.n_points(force);
          const unsigned int all = force.n_points();
          // Or they went while it did not act.
          if (stay < all && (go > 0 || !contains(before.loads, force.name())))
            notes.push_back(
              force.name() + ": " +
              (stay == 0 ?
                 "the body of its points is gone, and it with them" :
                 std::to_string(all - stay) + " of its " + std::to_string(all) +
                   " points are gone, and their share of it with them"));
        }
  }



  template <int dim>
  void
  remove_absorbing_places(const StageParameters    &stage,
                          Model<dim>               &model,
                          std::vector<std::string> &notes)
  {
    const Grounds<dim> grounds(stage, model);
    for (auto &boundary : model.absorbing_boundaries)
      {
        const auto               &places = boundary.places();
        std::vector<unsigned int> is_lost(places.size(), 0);
        for (unsigned int k = 0; k < places.size(); ++k)
          if (places[k].active_cell_index != GridSpace<dim>::no_cell)
            is_lost[k] =
              grounds.is_on_what_goes(places[k].x, places[k].active_cell_index);
        Utilities::MPI::max(is_lost, model.space->communicator(), is_lost);
        double                    lost = 0, all = 0;
        std::vector<unsigned int> numbers;
        for (unsigned int k = 0; k < places.size(); ++k)
          {
            all += places[k].weight;
            if (is_lost[k] > 0)
              {
                lost += places[k].weight;
                numbers.push_back(k);
              }
          }
        if (numbers.empty())
          continue;
        boundary.remove_places(numbers);
        notes.push_back(boundary.name() + ": " +
                        std::to_string(std::lround(100 * lost / all)) +
                        " % of what absorbs lies on bodies that are gone, and "
                        "is gone with them");
      }
  }



  template void
  tell_of_removed_bodies(const StageParameters &,
                         const StageParameters &,
                         const Model<2> &,
                         std::vector<std::string> &);
  template void
  remove_absorbing_places(const StageParameters &,
                          Model<2> &,
                          std::vector<std::string> &);
  template void
  remove_absorbing_places(const StageParameters &,
                          Model<3> &,
                          std::vector<std::string> &);
  template void
  tell_of_removed_bodies(const StageParameters &,
                         const StageParameters &,
                         const Model<3> &,
                         std::vector<std::string> &);
} // namespace moraine
