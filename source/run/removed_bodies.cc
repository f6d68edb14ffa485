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
    /** Whether the body that is nearest to a place in a cell of this rank goes.
     * A cell without points is on the rim of a body as it was drawn. */
    template <int dim>
    bool
    is_on_what_goes(const Point<dim>        &x,
                    const unsigned int       cell,
                    const std::vector<bool> &goes,
                    const Model<dim>        &model)
    {
      const auto [first, last] = model.points->points_in(cell);
      double nearest           = std::numeric_limits<double>::max();
      bool   of_goes           = false;
      const auto take = [&](const double away, const unsigned int body) {
        if (away >= nearest)
          return;
        nearest = away;
        of_goes = goes[body];
      };
      for (unsigned int p = first; p < last; ++p)
        take(model.points->position(p).distance(x), model.points->body(p));
      for (unsigned int b = 0; first == last && b < goes.size(); ++b)
        if (model.present[b] && model.bodies[b].shape)
          take(-model.bodies[b].shape->distance(x, model.mesh->cell_size()), b);
      return of_goes;
    }
  } // namespace



  template <int dim>
  std::optional<Finding>
  remove_absorbing_places(const StageParameters &stage, Model<dim> &model)
  {
    std::vector<bool> goes;
    for (unsigned int b = 0; b < model.bodies.size(); ++b)
      goes.push_back(model.present[b] &&
                     !contains(stage.bodies, model.body_names[b]));
    std::optional<Finding> found;
    for (auto &boundary : model.absorbing_boundaries)
      {
        const auto               &places = boundary.places();
        std::vector<unsigned int> is_lost(places.size(), 0);
        for (unsigned int k = 0; k < places.size(); ++k)
          if (places[k].active_cell_index != GridSpace<dim>::no_cell)
            is_lost[k] = is_on_what_goes(places[k].x,
                                         places[k].active_cell_index,
                                         goes,
                                         model);
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
        found = {"absorbing-boundary",
                 boundary.name(),
                 lost / all,
                 0,
                 per_cent(lost / all) +
                   " of it lies on bodies that go, and goes with them"};
      }
    return found;
  }



  template std::optional<Finding>
  remove_absorbing_places(const StageParameters &, Model<2> &);
  template std::optional<Finding>
  remove_absorbing_places(const StageParameters &, Model<3> &);
} // namespace moraine
