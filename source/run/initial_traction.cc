// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/initial_traction.h>

#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/geometry/covered_pieces.h>
#include <moraine/points/body_cover.h>
#include <moraine/points/linear_fit.h>

#include <deal.II/base/mpi.h>

#include <vector>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the square of a cell's size: points that are spread by less along a
     * direction say nothing of how stress changes along it. */
    constexpr double least_spread_of_points = 1e-3;



    /** Stress in a cell, its components in the space of the mesh. Places are
     * seen from the middle of the cell, which may be far from the origin. */
    template <int dim>
    LinearFit<dim, SymmetricTensor<2, dim>>
    fit_stress(const PointSet<dim>                      &points,
               const typename PointSet<dim>::CellPoints &in_cell)
    {
      const Point<dim> middle = in_cell.cell->center();
      const double     h      = in_cell.cell->minimum_vertex_distance();
      return {points,
              in_cell,
              [&](const unsigned int p) { return points.position(p) - middle; },
              [&](const unsigned int p) {
                const auto sigma = points.stress_field()(points.values(p));
                SymmetricTensor<2, dim> in_space;
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = i; j < dim; ++j)
                    in_space[i][j] = sigma[i][j];
                return in_space;
              },
              least_spread_of_points * h * h};
    }



    /** At the points of a boundary, and of its slopes. */
    template <int dim>
    struct Tractions
    {
      explicit Tractions(const ImplicitBoundary<dim> &boundary)
        : at_points(boundary.points().size())
        , of_slopes(boundary.slopes().size())
      {}

      std::vector<Tensor<1, dim>> at_points;
      std::vector<Tensor<1, dim>> of_slopes;
    };



    /** @f$M \sigma n@f$ where a body is at a boundary. */
    template <int dim>
    Tractions<dim>
    tractions_on(const ImplicitBoundary<dim> &boundary,
                 const PointSet<dim>         &points,
                 const BodyCover<dim>        &covers)
    {
      const auto                            &places = boundary.points();
      Tractions<dim>                         tractions(boundary);
      std::vector<std::vector<unsigned int>> places_in(
        points.mesh().triangulation().n_active_cells());
      std::vector<std::vector<unsigned int>> slopes_of(places.size());
      for (unsigned int q = 0; q < places.size(); ++q)
        places_in[places[q].cell].push_back(q);
      for (unsigned int k = 0; k < boundary.slopes().size(); ++k)
        slopes_of[boundary.slopes()[k].point].push_back(k);
      for (const auto &in_cell : points.cells())
        {
          const auto &here = places_in[in_cell.cell->active_cell_index()];
          if (here.empty())
            continue;
          const auto stress = fit_stress(points, in_cell);
          for (const unsigned int q : here)
            {
              const BoundaryPoint<dim> &place       = places[q];
              const Covers<dim>         covers_here = [&](const Point<dim> &x,
                                                  const double      margin) {
                return covers(place.cell, x, margin);
              };
              if (!is_at_body(covers_here, place.x, place.normal, place.h))
                continue;
              const auto traction = [&](const Tensor<1, dim> &offset) {
                return boundary.constraint().projection(place.normal) *
                       (stress.at(place.x + offset - in_cell.cell->center()) *
                        place.normal);
              };
              tractions.at_points[q] = traction(Tensor<1, dim>());
              for (const unsigned int k : slopes_of[q])
                tractions.of_slopes[k] = traction(boundary.slopes()[k].offset) -
                                         tractions.at_points[q];
            }
        }
      return tractions;
    }



    /** What the law lets through of @f$\sigma n@f$ where rims touch a surface.
     * Collective. */
    template <int dim>
    std::vector<Tensor<1, dim>>
    tractions_on(const ContactBoundary<dim> &boundary,
                 const PointSet<dim>        &points)
    {
      const auto &places = boundary.places_of_rim().places();
      std::vector<std::vector<unsigned int>> places_in(
        points.mesh().triangulation().n_active_cells());
      for (unsigned int k = 0; k < places.size(); ++k)
        if (places[k].active_cell_index != GridSpace<dim>::no_cell &&
            boundary.touches(k))
          places_in[places[k].active_cell_index].push_back(k);
      std::vector<double> components(dim * places.size(), 0.);
      for (const auto &in_cell : points.cells())
        {
          const auto &here = places_in[in_cell.cell->active_cell_index()];
          if (here.empty())
            continue;
          const auto stress = fit_stress(points, in_cell);
          for (const unsigned int k : here)
            {
              const Point<dim>     x = boundary.position(k);
              const Tensor<1, dim> n = boundary.normal_at_start(x);
              const Tensor<1, dim> t =
                boundary.law()
                  .template response<dim>(
                    stress.at(x - in_cell.cell->center()) * n, n, true, 0.)
                  .traction;
              for (unsigned int d = 0; d < dim; ++d)
                components[dim * k + d] = t[d];
            }
        }
      Utilities::MPI::sum(components,
                          points.mesh().triangulation().get_communicator(),
                          components);
      std::vector<Tensor<1, dim>> tractions(places.size());
      for (unsigned int k = 0; k < places.size(); ++k)
        for (unsigned int d = 0; d < dim; ++d)
          tractions[k][d] = components[dim * k + d];
      return tractions;
    }
  } // namespace



  template <int dim>
  void
  set_initial_tractions(const StageParameters          &stage,
                        const std::vector<std::string> &before,
                        Model<dim>                     &model)
  {
    std::vector<ImplicitBoundary<dim> *> holding;
    for (ImplicitBoundary<dim> &boundary : model.boundaries)
      if (contains(stage.boundaries, boundary.name()) &&
          !contains(before, boundary.name()) &&
          !contains(stage.absorbing, boundary.name()) &&
          boundary.enforcement().carries_multiplier)
        holding.push_back(&boundary);
    const ShapesOfBodies<dim> shapes = shapes_of(model.bodies);
    const BodyCover<dim>      covers(*model.points,
                                shapes,
                                model.state->mesh_after_step() !=
                                  MeshAfterStep::keep);
    const auto                hold = [&](ImplicitBoundary<dim> &boundary,
                          const Tractions<dim>  &tractions) {
      boundary.prepare(tractions.at_points,
                       Tractions<dim>(boundary).at_points,
                       tractions.of_slopes);
      boundary.keep();
      model.system->begin_step(stage.time.start_time);
    };
    for (ContactBoundary<dim> &boundary : model.contact_boundaries)
      if (contains(stage.boundaries, boundary.name()) &&
          !contains(before, boundary.name()))
        {
          boundary.set_tractions(tractions_on(boundary, *model.points));
          model.system->begin_step(stage.time.start_time);
        }
    // Walls that share nodes balance them together or not at all.
    for (ImplicitBoundary<dim> *boundary : holding)
      hold(*boundary, tractions_on(*boundary, *model.points, covers));
    double share = model.system->unbalanced_share();
    for (ImplicitBoundary<dim> *boundary : holding)
      {
        const Tractions<dim> tractions =
          tractions_on(*boundary, *model.points, covers);
        hold(*boundary, Tractions<dim>(*boundary));
        const double without = model.system->unbalanced_share();
        if (without <= share)
          share = without;
        else
          hold(*boundary, tractions);
      }
  }



  template <int dim>
  void
  set_tractions_of_new_bodies(const StageParameters &stage,
                              const StageParameters &before,
                              Model<dim>            &model)
  {
    const PointSet<dim> &points = *model.points;
    std::vector<bool>    is_new;
    for (const std::string &body : model.body_names)
      is_new.push_back(contains(stage.bodies, body) &&
                       !contains(before.bodies, body));
    if (none_of(is_new, [](const bool b) { return b; }))
      return;
    std::vector<bool> has_old(points.mesh().triangulation().n_active_cells(),
                              false);
    for (const auto &in_cell : points.cells())
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        if (!is_new[points.body(p)])
          has_old[in_cell.cell->active_cell_index()] = true;
    const ShapesOfBodies<dim> shapes = shapes_of(model.bodies);
    const BodyCover<dim>      covers(
      points, shapes, model.state->mesh_after_step() != MeshAfterStep::keep);
    for (ImplicitBoundary<dim> &boundary : model.boundaries)
      {
        if (!contains(stage.boundaries, boundary.name()) ||
            !contains(before.boundaries, boundary.name()) ||
            contains(stage.absorbing, boundary.name()) ||
            !boundary.enforcement().carries_multiplier)
          continue;
        Tractions<dim> tractions = tractions_on(boundary, points, covers);
        std::vector<Tensor<1, dim>> violations(boundary.points().size());
        for (unsigned int q = 0; q < boundary.points().size(); ++q)
          {
            const BoundaryPoint<dim> &place = boundary.points()[q];
            if (has_old[place.cell])
              tractions.at_points[q] = place.multiplier_at_start;
            else
              violations[q] = -place.accumulated_violation;
          }
        for (unsigned int k = 0; k < boundary.slopes().size(); ++k)
          {
            const auto &slope = boundary.slopes()[k];
            if (has_old[boundary.points()[slope.point].cell])
              tractions.of_slopes[k] = slope.multiplier_at_start;
          }
        boundary.prepare(tractions.at_points, violations, tractions.of_slopes);
        boundary.keep();
      }
    for (ContactBoundary<dim> &boundary : model.contact_boundaries)
      if (contains(stage.boundaries, boundary.name()) &&
          contains(before.boundaries, boundary.name()))
        {
          std::vector<Tensor<1, dim>> tractions =
            tractions_on(boundary, points);
          for (unsigned int k = 0; k < tractions.size(); ++k)
            if (!is_new[boundary.at_place(k).body])
              tractions[k] = boundary.at_place(k).traction;
          boundary.set_tractions(tractions);
        }
    model.system->begin_step(stage.time.start_time);
  }



#define INSTANTIATE(dim)                                                    \
  template decltype(set_initial_tractions<dim>) set_initial_tractions<dim>; \
  template decltype(set_tractions_of_new_bodies<dim>)                       \
    set_tractions_of_new_bodies<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
