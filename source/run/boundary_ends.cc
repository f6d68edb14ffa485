// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/boundary_ends.h>

#include <moraine/core/words.h>
#include <moraine/run/drawn_bodies.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a surface: what it holds past its ends shows in forces. */
    constexpr double told_past_ends = 0.05, least_own_share = 0.02;

    /** Of a cell: surfaces that are as deep are one. */
    constexpr double same_level = 0.05;



    /** What of a boundary a body is at, and whether it goes through bodies. */
    struct AtBody
    {
      std::vector<double> area; ///< in each cell
      double              sum      = 0;
      bool                embedded = false;
    };



    template <int dim>
    AtBody
    area_at_body(const ImplicitBoundary<dim> &boundary, const Model<dim> &model)
    {
      AtBody              at;
      std::vector<double> area(2, 0.); // with a body inside, on both sides
      at.area.resize(model.mesh->triangulation().n_active_cells(), 0.);
      for (const auto &place : boundary.points())
        {
          const SurfacePoint<dim> foot = foot_of(place, boundary);
          const Tensor<1, dim>    step = 0.1 * place.h * foot.normal;
          if (!in_a_body(foot.x - step, model))
            continue;
          at.area[place.cell] += place.JxW;
          area[0] += place.JxW;
          area[1] += in_a_body(foot.x + step, model) ? place.JxW : 0.;
        }
      Utilities::MPI::sum(area, model.space->communicator(), area);
      at.sum      = area[0];
      at.embedded = area[1] > 0.5 * area[0];
      return at;
    }



    /** The share of a point that @p is_there, asked at places that are spread
     * over its cube and moved along @p normal into the plane of its middle. */
    template <int dim, typename Predicate>
    double
    share_of_point(const PointSet<dim>  &points,
                   const unsigned int    p,
                   const Tensor<1, dim> &normal,
                   const Predicate      &is_there)
    {
      constexpr unsigned int n     = dim == 2 ? 16 : 4; // along each axis
      const unsigned int     n_all = Utilities::fixed_power<dim>(n);
      const double           size  = std::pow(points.volume(p), 1. / dim) / n;
      unsigned int           found = 0;
      for (unsigned int k = 0; k < n_all; ++k)
        {
          Tensor<1, dim> offset;
          unsigned int   i = k;
          for (unsigned int d = 0; d < dim; ++d, i /= n)
            offset[d] = (i % n - 0.5 * (n - 1)) * size;
          found +=
            is_there(points.position(p) + offset - (offset * normal) * normal);
        }
      return 1. * found / n_all;
    }



    /** Whether all of a point's cube is between the ends of a boundary. */
    template <int dim>
    bool
    is_within_ends(const ImplicitBoundary<dim> &boundary,
                   const PointSet<dim>         &points,
                   const unsigned int           p)
    {
      const double half = 0.5 * std::pow(points.volume(p), 1. / dim);
      for (const unsigned int corner : GeometryInfo<dim>::vertex_indices())
        {
          Point<dim> x = points.position(p);
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += (corner >> d) & 1 ? half : -half;
          if (!boundary.nearest_at_start(x).in_extent)
            return false;
        }
      return true;
    }



    /** Whether another boundary of a stage goes on where one ends, so that it
     * is as deep below @p x. */
    template <int dim>
    bool
    goes_on(const ImplicitBoundary<dim> &boundary,
            const StageParameters       &stage,
            const Model<dim>            &model,
            const Point<dim>            &x,
            const double                 depth)
    {
      return std::any_of(model.boundaries.begin(),
                         model.boundaries.end(),
                         [&](const auto &other) {
                           if (other.name() == boundary.name() ||
                               !contains(stage.boundaries, other.name()))
                             return false;
                           const NearestPoint<dim> nearest =
                             other.nearest_at_start(x);
                           return nearest.in_extent &&
                                  std::abs(nearest.level - depth) <
                                    same_level * model.mesh->cell_size();
                         });
    }



    /** The area past the ends of a boundary that its cells have and bodies are
     * at as they are at it, over its own: it holds that, too. From the volume
     * of points in a cell, and how deep they lie. Collective. */
    template <int dim>
    double
    area_past_ends(const ImplicitBoundary<dim> &boundary,
                   const StageParameters       &stage,
                   const Model<dim>            &model)
    {
      const PointSet<dim> &points = *model.points;
      const AtBody         at     = area_at_body(boundary, model);
      const double         step   = 0.1 * model.mesh->cell_size();
      double               past   = 0;
      for (const auto &in_cell : points.cells())
        {
          const double own = at.area[in_cell.cell->active_cell_index()];
          if (own == 0)
            continue;
          double volume = 0, moment = 0; // of a layer along the surface
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            {
              const NearestPoint<dim> middle =
                boundary.nearest_at_start(points.position(p));
              if (middle.level <= 0 || is_within_ends(boundary, points, p))
                continue;
              const Tensor<1, dim> out = (middle.level + step) * middle.normal;
              const double         part =
                points.volume(p) *
                share_of_point(points, p, middle.normal, [&](const auto &x) {
                  return !boundary.nearest_at_start(x).in_extent &&
                         in_a_body(x, model) &&
                         in_a_body(x + out, model) == at.embedded &&
                         !goes_on(boundary, stage, model, x, middle.level);
                });
              volume += part;
              moment += part * middle.level;
            }
          if (volume == 0)
            continue;
          const double area = volume / (2 * moment / volume);
          // A sliver of it hardly holds its cell.
          if (own > least_own_share * area)
            past += area;
        }
      past = Utilities::MPI::sum(past, model.space->communicator());
      return at.sum > 0 ? past / at.sum : 0.;
    }
  } // namespace



  template <int dim>
  void
  tell_of_ends(const StageParameters          &stage,
               const std::vector<std::string> &known,
               const Model<dim>               &model,
               std::vector<std::string>       &notes)
  {
    if (!are_drawn(model.bodies))
      return;
    for (const auto &boundary : model.boundaries)
      {
        if (!contains(stage.boundaries, boundary.name()) ||
            contains(stage.absorbing, boundary.name()) ||
            contains(known, boundary.name()))
          continue;
        const double past = area_past_ends(boundary, stage, model);
        if (past > told_past_ends)
          notes.push_back(
            boundary.name() + ": it ends inside cells and holds all of them, " +
            std::to_string(std::lround(100 * past)) +
            " % more than was drawn; forces on it can come out as much larger, "
            "or more; let it end on faces of cells, or take smaller ones");
      }
  }



  template void
  tell_of_ends(const StageParameters &,
               const std::vector<std::string> &,
               const Model<2> &,
               std::vector<std::string> &);
  template void
  tell_of_ends(const StageParameters &,
               const std::vector<std::string> &,
               const Model<3> &,
               std::vector<std::string> &);
} // namespace moraine
