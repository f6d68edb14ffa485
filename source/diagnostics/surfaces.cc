// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Which part of a body a boundary holds, and how well.

#include <moraine/core/exceptions.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/checks.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  namespace checks
  {
    using namespace dealii;

    namespace
    {
      /** Of a surface: the area past its ends that it holds as well; a smaller
       * part of a cell hardly holds it. */
      constexpr double allowed_past_ends = 0.05, least_own_share = 0.02;

      /** Of a cell: surfaces at this difference of depth are one. */
      constexpr double same_level = 0.05;

      /** Of a cell. */
      constexpr double allowed_gap = 0.1, allowed_depth = 0.25,
                       allowed_behind_ends = 0.1, allowed_passing = 0.1;

      /** Of a cell: points that have passed a surface deeper would move on as
       * if it were not there. */
      constexpr double most_passing = 0.5;

      /** Of the material along a surface: it lies behind. */
      constexpr double allowed_share_behind = 0.1;

      /** What material may miss a boundary by: both of the largest motion of a
       * step and of a cell. */
      constexpr double allowed_share_of_motion = 0.05,
                       allowed_share_of_cell   = 1e-3;



      /** Whether another boundary continues this one at the same depth below
       * @p x. */
      template <int dim>
      bool
      is_continued(const ImplicitBoundary<dim> &boundary,
                   const Facts<dim>            &facts,
                   const Point<dim>            &x,
                   const double                 depth)
      {
        return any_of(facts.of.boundaries, [&](const auto &other) {
          if (other.name() == boundary.name() ||
              !contains(facts.now.stage->boundaries, other.name()))
            return false;
          const NearestPoint<dim> nearest = other.surface_at_start().nearest(x);
          return nearest.in_extent && std::abs(nearest.level - depth) <
                                        same_level * facts.cell_size();
        });
      }



      /** The material along a boundary, in a layer of half a cell on each side
       * of it. */
      struct Layer
      {
        double front  = 0; ///< volume on the inner side
        double behind = 0; ///< on the outer side
        double depth  = 0; ///< of what is behind

        double
        share_behind() const
        {
          return behind > 0 ? behind / (front + behind) : 0.;
        }
      };

      template <int dim>
      Layer
      layer_along(const ImplicitBoundary<dim> &boundary,
                  const Facts<dim>            &facts)
      {
        const PointSet<dim> &points = facts.of.points;
        const double         h      = facts.cell_size();
        std::vector<double>  sums(2, 0.);
        Layer                layer;
        for (unsigned int p = 0; p < points.n_local(); ++p)
          {
            const NearestPoint<dim> nearest =
              boundary.surface_at_start().nearest(points.position(p));
            const double half = 0.5 * std::pow(points.volume(p), 1. / dim);
            if (!nearest.in_extent || std::abs(nearest.level) > half + 0.5 * h)
              continue;
            sums[nearest.level < 0 ? 1 : 0] += points.volume(p);
            // A quarter of a point may be round-off.
            if (-nearest.level > 0.5 * allowed_depth * h)
              layer.depth = std::max(layer.depth, half - nearest.level);
          }
        Utilities::MPI::sum(sums, facts.communicator(), sums);
        layer.front  = sums[0];
        layer.behind = sums[1];
        layer.depth  = Utilities::MPI::max(layer.depth, facts.communicator());
        return layer;
      }



      /** The area past the ends of a boundary that its cells hold as well,
       * over its own, from the volume and the depth of points in its cells. */
      template <int dim>
      double
      area_past_ends(const ImplicitBoundary<dim> &boundary,
                     const Facts<dim>            &facts)
      {
        const PointSet<dim> &points = facts.of.points;
        const bool           embedded =
          layer_along(boundary, facts).share_behind() > 0.25;
        const double        step = 0.1 * facts.cell_size();
        std::vector<double> own(facts.of.mesh.triangulation().n_active_cells(),
                                0.),
          sums(2, 0.); // past its ends, its own
        for (const auto &point : boundary.points())
          {
            own[point.cell] += point.JxW;
            sums[1] += point.JxW;
          }
        for (const auto &in_cell : points.cells())
          {
            const double of_cell = own[in_cell.cell->active_cell_index()];
            double       volume = 0, moment = 0; // of a layer past the ends
            for (unsigned int p = in_cell.first;
                 of_cell > 0 && p < in_cell.last;
                 ++p)
              {
                const Point<dim>       &x = points.position(p);
                const NearestPoint<dim> nearest =
                  boundary.surface_at_start().nearest(x);
                if (nearest.level <= 0 || nearest.in_extent ||
                    facts.in_a_body(x + (nearest.level + step) *
                                          nearest.normal) != embedded ||
                    is_continued(boundary, facts, x, nearest.level))
                  continue;
                volume += points.volume(p);
                moment += points.volume(p) * nearest.level;
              }
            const double area =
              volume > 0 ? volume / (2 * moment / volume) : 0.;
            if (of_cell > least_own_share * area)
              sums[0] += area;
          }
        Utilities::MPI::sum(sums, facts.communicator(), sums);
        return sums[1] > 0 ? sums[0] / sums[1] : 0.;
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    ends_in_cells(Facts<dim> &facts, Ledger &)
    {
      Worst worst("surface-coverage", allowed_past_ends);
      if (facts.are_drawn())
        for (const auto &boundary : facts.of.boundaries)
          if (facts.begins_to_hold(boundary.name()))
            worst.take(boundary.name(), area_past_ends(boundary, facts));
      return worst.with("it ends inside cells and holds " +
                        per_cent(worst.value) +
                        " more than was drawn; end it on faces of cells, or "
                        "take smaller cells");
    }



    template <int dim>
    std::optional<Finding>
    held_beside_bodies(Facts<dim> &facts, Ledger &)
    {
      Worst worst("surface-coverage", 0.5);
      for (const auto &condition :
           acting_conditions(facts.of.grid_conditions, *facts.now.stage))
        {
          std::vector<unsigned int> n(2, 0); // faces off bodies, all
          for (const auto &in_cell : facts.of.points.cells())
            for (const unsigned int f : in_cell.cell->face_indices())
              {
                const auto face = in_cell.cell->face(f);
                if (facts.now.before || !condition.side ||
                    !face->at_boundary() ||
                    face->boundary_id() != *condition.side)
                  continue;
                const Tensor<1, dim> outward =
                  face->center() - in_cell.cell->center();
                const double h = 2 * outward.norm();
                n[0] +=
                  facts.of.points.gap_before(in_cell.cell->active_cell_index(),
                                             face->center(),
                                             2 / h * outward,
                                             h) > allowed_gap * h;
                ++n[1];
              }
          Utilities::MPI::sum(n, facts.communicator(), n);
          worst.take(condition.name, n[1] > 0 ? 1. * n[0] / n[1] : 0.);
        }
      return worst.with(
        per_cent(worst.value) +
        " of its faces are off the body but hold it; end the "
        "body on faces of cells, or hold its rim by a boundary");
    }



    namespace
    {
      /** Around the places where a boundary is in a step, with a @p margin. */
      template <int dim>
      std::optional<BoundingBox<dim>>
      box_around(const ImplicitBoundary<dim> &boundary,
                 const double                 margin,
                 const MPI_Comm              &communicator)
      {
        // Lower bounds, and upper ones with the other sign.
        std::vector<double> bounds(2 * dim, std::numeric_limits<double>::max());
        for (const auto &point : boundary.points())
          for (const Point<dim> &x : {point.x, point.x + point.prescribed})
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



      /** How deep material past the ends of a boundary is behind where the
       * surface would go on; less than 0 if there is none beside it. */
      template <int dim>
      double
      depth_past_ends(const ImplicitBoundary<dim> &boundary,
                      const Facts<dim>            &facts,
                      const bool                   at_start)
      {
        const double         h      = facts.cell_size();
        const PointSet<dim> &points = facts.of.points;
        double               depth  = -1;
        const auto box = box_around(boundary, h, facts.communicator());
        for (unsigned int p = 0; box && p < points.n_local(); ++p)
          {
            const Point<dim> &x = points.position(p);
            if (!box->point_inside(x))
              continue;
            const auto nearest = at_start ?
                                   boundary.surface_at_start().nearest(x) :
                                   boundary.surface_at_end().nearest(x);
            if (!nearest.in_extent && std::abs(nearest.level) <= h)
              depth = std::max({depth, 0., -nearest.level});
          }
        return Utilities::MPI::max(depth, facts.communicator());
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    grown_past_ends(Facts<dim> &facts, Ledger &ledger)
    {
      Worst worst("surface-coverage", allowed_behind_ends);
      if (facts.of.state.mesh_after_step() == MeshAfterStep::keep)
        return {};
      for (const auto &boundary : facts.of.boundaries)
        {
          if (!contains(facts.now.stage->boundaries, boundary.name()))
            continue;
          // 1: nothing was beside its ends as it began.
          const std::string name =
            "surface-coverage/watched " + boundary.name();
          if (!ledger.has_number(name))
            ledger.number(name) = depth_past_ends(boundary, facts, true) < 0;
          if (ledger.number(name) != 0 && facts.now.reports)
            worst.take(boundary.name(),
                       depth_past_ends(boundary, facts, false) /
                         facts.cell_size());
        }
      return worst.with("material has come past its end, where nothing holds "
                        "it; draw a surface that is longer than the body");
    }



    namespace
    {
      /** How far the material in its cells is from a boundary, less half the
       * size of points: the mean over the surface, and the least. */
      template <int dim>
      std::pair<double, double>
      gaps_before(const ImplicitBoundary<dim> &boundary,
                  const Facts<dim>            &facts)
      {
        std::vector<double> sums(2, 0.);
        double              least = facts.cell_size();
        for (const auto &point : boundary.points())
          {
            const double gap = std::max(facts.of.points.gap_before(point.cell,
                                                                   point.x,
                                                                   point.normal,
                                                                   point.h),
                                        0.);
            least            = std::min(least, gap);
            sums[0] += gap * point.JxW;
            sums[1] += point.JxW;
          }
        Utilities::MPI::sum(sums, facts.communicator(), sums);
        return {sums[1] > 0 ? sums[0] / sums[1] : 0.,
                Utilities::MPI::min(least, facts.communicator())};
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    away_from_bodies(Facts<dim> &facts, Ledger &)
    {
      Worst worst("surface-place", allowed_gap * facts.cell_size());
      for (const auto &boundary : facts.of.boundaries)
        if (facts.begins_to_hold(boundary.name()))
          {
            // A surface may at first be longer than its body.
            const auto [mean, least] = gaps_before(boundary, facts);
            worst.take(boundary.name(), facts.now.before ? mean : least);
          }
      return worst.with("as it begins, the body is " + text_of(worst.value, 3) +
                        " away from it and is held across the gap; draw it on "
                        "the rim of the body");
    }



    template <int dim>
    std::optional<Finding>
    inside_bodies(Facts<dim> &facts, Ledger &)
    {
      Worst  worst("surface-place", allowed_depth * facts.cell_size());
      double share = 0;
      for (const auto &boundary : facts.of.boundaries)
        if (facts.begins_to_hold(boundary.name()))
          if (const Layer layer = layer_along(boundary, facts);
              layer.share_behind() > allowed_share_behind &&
              worst.take(boundary.name(), layer.depth))
            share = layer.share_behind();
      return worst.with("as it begins, " + per_cent(share) +
                        " of the material along it lies behind it, up to " +
                        text_of(worst.value, 3) +
                        " deep; draw it on the rim of the body");
    }



    template <int dim>
    std::optional<Finding>
    nitsche_flux(Facts<dim> &facts, Ledger &)
    {
      Worst worst("nitsche-flux", 0);
      if (facts.of.state.strain_measure() == StrainMeasure::finite ||
          facts.of.state.dissipates())
        for (const auto &boundary : facts.of.boundaries)
          worst.take(boundary.name(), boundary.enforcement().w_constrained);
      return worst.with("the flux of Nitsche's method is elastic and of small "
                        "strain; use 'Enforcement = augmented Lagrangian'");
    }



    template <int dim>
    std::optional<Finding>
    missed_boundaries(Facts<dim> &facts, Ledger &)
    {
      Worst worst("surface-miss", allowed_share_of_motion);
      for (const auto &report : *facts.now.reports)
        // In waves the motion of one step is no measure.
        if (!facts.has_inertia() &&
            report.violation > allowed_share_of_cell * facts.cell_size())
          worst.take(report.name, report.violation / facts.now.point_motion);
      return worst.with("in the step to t = " + text_of(facts.now.t, 3) +
                        " the body misses it by " + per_cent(worst.value) +
                        " of the largest motion; take smaller cells or steps");
    }



    template <int dim>
    std::optional<Finding>
    passed_boundaries(Facts<dim> &facts, Ledger &ledger)
    {
      Worst worst("surface-miss", allowed_passing * facts.cell_size());
      for (const auto &report : *facts.now.reports)
        {
          const std::string name = "surface-miss/depth of " + report.name;
          if (!ledger.has_number(name))
            ledger.number(name) = report.penetration;
          worst.take(report.name, report.penetration - ledger.number(name));
        }
      // Where constraints conflict a gap of up to a cell is not held.
      if (worst.value > most_passing * facts.cell_size() &&
          !conflicting_constraints(facts, ledger))
        throw ComputationError(
          "material is " + text_of(worst.value, 3) + " behind '" +
          worst.object + "' at t = " + text_of(facts.now.t, 3) +
          " and no longer held; take smaller cells or steps, or set its "
          "'Penetration limit'");
      return worst.with("material has passed it by " + text_of(worst.value, 3) +
                        " in the step to t = " + text_of(facts.now.t, 3) +
                        ", so that its force is too small; take smaller cells");
    }



    MORAINE_INSTANTIATE_CHECK(ends_in_cells)
    MORAINE_INSTANTIATE_CHECK(held_beside_bodies)
    MORAINE_INSTANTIATE_CHECK(grown_past_ends)
    MORAINE_INSTANTIATE_CHECK(away_from_bodies)
    MORAINE_INSTANTIATE_CHECK(inside_bodies)
    MORAINE_INSTANTIATE_CHECK(nitsche_flux)
    MORAINE_INSTANTIATE_CHECK(missed_boundaries)
    MORAINE_INSTANTIATE_CHECK(passed_boundaries)
  } // namespace checks
} // namespace moraine
