// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/end_watch.h>

#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a cell. */
    constexpr double told_behind_ends = 0.1;



    /** Around the places where a boundary is beside cells during a step, on all
     * ranks, with a @p margin; nothing if there are none. Collective. */
    template <int dim>
    std::optional<BoundingBox<dim>>
    box_around(const ImplicitBoundary<dim> &boundary,
               const double                 margin,
               const MPI_Comm              &communicator)
    {
      // Lower bounds, and upper ones with the other sign.
      std::vector<double> bounds(2 * dim, std::numeric_limits<double>::max());
      for (const auto &place : boundary.points())
        for (const Point<dim> &x : {place.x, place.x + place.prescribed})
          for (unsigned int d = 0; d < dim; ++d)
            {
              bounds[d]       = std::min(bounds[d], x[d]);
              bounds[dim + d] = std::min(bounds[dim + d], -x[d]);
            }
      Utilities::MPI::min(bounds, communicator, bounds);
      if (bounds[0] == std::numeric_limits<double>::max())
        return {};
      Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = bounds[d] - margin;
          upper[d] = -bounds[dim + d] + margin;
        }
      return BoundingBox<dim>({lower, upper});
    }
  } // namespace



  template <int dim>
  EndWatch<dim>::EndWatch(const Model<dim> &model)
    : model(model)
  {}



  template <int dim>
  typename EndWatch<dim>::PastEnds
  EndWatch<dim>::past_ends(const ImplicitBoundary<dim> &boundary,
                           const When                   when) const
  {
    const MPI_Comm       communicator = model.space->communicator();
    const double         h            = model.mesh->cell_size();
    const PointSet<dim> &points       = *model.points;
    PastEnds             found;
    const auto           box = box_around(boundary, h, communicator);
    for (unsigned int p = 0; box && p < points.n_local(); ++p)
      if (box->point_inside(points.position(p)))
        {
          const Point<dim> &x       = points.position(p);
          const auto        nearest = when == When::start ?
                                        boundary.nearest_at_start(x) :
                                        boundary.nearest_at_end(x);
          if (nearest.in_extent || std::abs(nearest.level) > h)
            continue;
          found.beside = true;
          found.depth  = std::max(found.depth, -nearest.level);
        }
    found.beside = Utilities::MPI::max(found.beside ? 1 : 0, communicator) == 1;
    found.depth  = Utilities::MPI::max(found.depth, communicator);
    return found;
  }



  template <int dim>
  void
  EndWatch<dim>::step_begins(const StageParameters &stage)
  {
    if (model.state->mesh_after_step() == MeshAfterStep::keep)
      return;
    for (const auto &boundary : model.boundaries)
      if (contains(stage.boundaries, boundary.name()) &&
          known.insert(boundary.name()).second &&
          !past_ends(boundary, When::start).beside)
        watched.insert(boundary.name());
  }



  template <int dim>
  std::vector<std::string>
  EndWatch<dim>::look(const std::vector<BoundaryReport<dim>> &reports,
                      const double                            t)
  {
    std::vector<std::string> notes;
    for (const auto &boundary : model.boundaries)
      {
        const std::string &name = boundary.name();
        if (watched.count(name) == 0 ||
            std::none_of(reports.begin(),
                         reports.end(),
                         [&name](const auto &report) {
                           return report.name == name;
                         }))
          continue;
        const PastEnds past = past_ends(boundary, When::end);
        if (!(past.depth > told_behind_ends * model.mesh->cell_size()))
          continue;
        watched.erase(name);
        std::ostringstream text;
        text << "boundary '" << name << "': by t = " << t
             << " material has come past its end and is " << past.depth
             << " behind where it would go on; nothing holds it there. A "
                "surface that is longer than the body ('Points') holds what "
                "grows past a 'Part' of it";
        notes.push_back(text.str());
      }
    return notes;
  }



  template <int dim>
  void
  EndWatch<dim>::write(Archive &archive) const
  {
    archive.write_lines("checks/ends/known", {known.begin(), known.end()});
    archive.write_lines("checks/ends/watched",
                        {watched.begin(), watched.end()});
  }



  template <int dim>
  void
  EndWatch<dim>::read(const Archive &archive)
  {
    const auto names = [&](const std::string &set) {
      const auto lines = archive.lines(set);
      return std::set<std::string>(lines.begin(), lines.end());
    };
    known   = names("checks/ends/known");
    watched = names("checks/ends/watched");
  }



  template class EndWatch<2>;
  template class EndWatch<3>;
} // namespace moraine
