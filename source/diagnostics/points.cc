// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What material points fill, whether they stay together and in the mesh.

#include <moraine/basis/body_parts.h>
#include <moraine/core/ranges.h>
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
      /** Of the volume of points: cells have no room for it. A grid of points
       * nearly as coarse as the cells has at most 0.20 in 2D and 0.26 in 3D. */
      template <int dim>
      constexpr double allowed_excess = dim == 2 ? 0.22 : 0.3;

      /** Too much or too little volume of points in cells inside bodies, over
       * the volume of these cells, root of the mean square. */
      constexpr double allowed_unevenness = 0.1;

      /** Of a cell: points near faces of meeting bodies may fill a quarter
       * more. */
      constexpr double allowed_fill = 1.3;

      /** Of a new body: the volume it shares with others. */
      constexpr double allowed_share_twice = 0.05;

      /** Of the volume of a body: less may splash. */
      constexpr double smallest_part = 0.01;

      /** Limits of unevenness(). Of a bar on mesh lines with 2, 3 and 4 points
       * per direction and cell the force is 5 to 11 % too small by then, with
       * boxes that keep their size 7 %. */
      constexpr double allowed_stretch_of_points = 0.03,
                       allowed_stretch_of_boxes  = 0.75;
    } // namespace



    template <int dim>
    std::optional<Finding>
    full_cells(Facts<dim> &facts, Ledger &)
    {
      if (facts.are_drawn())
        return {};
      const std::vector<double> volumes = facts.of.points.volumes_in_cells();
      double                    all = 0, excess = 0;
      for (const auto &cell :
           facts.of.mesh.triangulation().active_cell_iterators())
        {
          const double volume = volumes[cell->active_cell_index()];
          all += volume;
          excess += std::max(0., volume - volume_of_cell(cell));
        }
      if (!(excess > allowed_excess<dim> * all))
        return {};
      return Finding{"point-volumes",
                     "",
                     excess / all,
                     allowed_excess<dim>,
                     "cells have no room for " + per_cent(excess / all) +
                       " of the volume of the points; check the volumes in the "
                       "point file, or take smaller cells"};
    }



    template <int dim>
    std::optional<Finding>
    uneven_cells(Facts<dim> &facts, Ledger &)
    {
      if (facts.are_drawn() || facts.of.basis.has_domains())
        return {};
      const std::vector<double> volumes = facts.of.points.volumes_in_cells();
      const auto               &cells_at_vertex =
        facts.of.mesh.search_cache().get_vertex_to_cell_map();
      std::vector<double> drawn(volumes.size(), 0.); // points of shapes
      for (const auto &in_cell : facts.of.points.cells())
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          if (facts.of.bodies[facts.of.points.body(p)].shape)
            drawn[in_cell.cell->active_cell_index()] = 1;
      Utilities::MPI::max(drawn, facts.communicator(), drawn);
      double all = 0, squares = 0;
      for (const auto &cell :
           facts.of.mesh.triangulation().active_cell_iterators())
        {
          // Cells inside bodies have points in all cells around.
          const auto has_points = [&](const auto &near) {
            return volumes[near->active_cell_index()] > 0;
          };
          const auto vertices = cell->vertex_indices();
          if (cell->at_boundary() || drawn[cell->active_cell_index()] > 0 ||
              !all_of(vertices, [&](const auto a) {
                const auto &near = cells_at_vertex[cell->vertex_index(a)];
                return all_of(near, has_points);
              }))
            continue;
          const double off =
            volumes[cell->active_cell_index()] / volume_of_cell(cell) - 1;
          all += volume_of_cell(cell);
          squares += volume_of_cell(cell) * off * off;
        }
      const double off = all > 0 ? std::sqrt(squares / all) : 0.;
      if (!(off > allowed_unevenness))
        return {};
      return Finding{"point-volumes",
                     "",
                     off,
                     allowed_unevenness,
                     "points fill the cells unevenly, by " + per_cent(off) +
                       ", and stresses are wrong by as much; use 'Method = "
                       "GIMP'"};
    }



    template <int dim>
    std::optional<Finding>
    volume_twice(Facts<dim> &facts, Ledger &)
    {
      if (!facts.now.before)
        return {};
      const auto &parts  = facts.filled_parts();
      double      of_new = 0, twice = 0;
      std::string names;
      for (const std::string &body : facts.now.stage->bodies)
        if (facts.is_new(body))
          names += (names.empty() ? "" : ", ") + body;
      for (const auto &cell :
           facts.of.mesh.triangulation().active_cell_iterators())
        {
          double old = 0, comes = 0;
          for (unsigned int b = 0; b < parts.size(); ++b)
            (facts.is_new(facts.of.body_names[b]) ? comes : old) +=
              parts[b][cell->active_cell_index()];
          of_new += comes * volume_of_cell(cell);
          if (old > 0 && comes > 0 && old + comes > allowed_fill)
            twice += (old + comes - 1) * volume_of_cell(cell);
        }
      const double share = of_new > 0 ? twice / of_new : 0.;
      if (!(share > allowed_share_twice))
        return {};
      return Finding{"point-volumes",
                     names,
                     share,
                     allowed_share_twice,
                     per_cent(share) +
                       " of it stands where material has moved; draw it from "
                       "where the surface is now"};
    }



    template <int dim>
    std::optional<Finding>
    separation(Facts<dim> &facts, Ledger &ledger)
    {
      const std::string n_parts = "separation/parts of ";
      const bool        first   = !ledger.has_number(n_parts + "all");
      if (!first && !facts.of.system.coupling_changed())
        return {};
      ledger.number(n_parts + "all") = 1;
      const auto parts               = parts_of_bodies(facts.of.space,
                                         facts.of.points,
                                         facts.of.basis,
                                         facts.of.body_names.size());
      for (unsigned int b = 0; b < parts.size(); ++b)
        {
          double &known = ledger.number(n_parts + facts.of.body_names[b]);
          if (first)
            known = parts[b].size();
          double volume = 0;
          for (const auto &part : parts[b])
            volume += part.volume;
          if (first || parts[b].size() <= known)
            continue;
          const auto  &next  = parts[b][static_cast<unsigned int>(known)];
          const double share = next.volume / volume;
          if (share < smallest_part)
            continue;
          known = parts[b].size();
          return Finding{"separation",
                         facts.of.body_names[b],
                         share,
                         smallest_part,
                         "it came apart: " + per_cent(share) +
                           " of it, around (" +
                           coordinates(next.centre, 6, ", ") +
                           "), shares no node with the rest; use domains that "
                           "are split, more points, or larger cells"};
        }
      return {};
    }



    namespace
    {
      /** How unevenly cells share points that were @p distance cells apart and
       * are stretched by @p lambda: by how much a cell of @f$1/d@f$ points per
       * direction that has one less is too soft, @f$(\lambda-1)d^2@f$; of boxes
       * that keep their size the distance itself, @f$\lambda d@f$. */
      double
      unevenness(const double lambda, const double distance, const bool boxes)
      {
        return boxes ? lambda * distance : (lambda - 1) * distance * distance;
      }



      /** The largest stretch of the distance to a neighbour along an axis. */
      template <int dim>
      double
      largest_stretch(const Tensor<2, dim> &F)
      {
        double largest = 0;
        for (unsigned int j = 0; j < dim; ++j)
          {
            double square = 0;
            for (unsigned int i = 0; i < dim; ++i)
              square += F[i][j] * F[i][j];
            largest = std::max(largest, square);
          }
        return std::sqrt(largest);
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    points_apart(Facts<dim> &facts, Ledger &)
    {
      const bool has_boxes = facts.of.basis.has_domains();
      if (!facts.of.scene.method.points_drift_apart(has_boxes))
        return {};
      const PointSet<dim> &points = facts.of.points;
      const auto           F =
        points.fields().find(FieldNames<dim>::deformation_gradient);
      const auto   v0 = points.fields().find(FieldNames<dim>::initial_volume);
      const double limit =
        has_boxes ? allowed_stretch_of_boxes : allowed_stretch_of_points;
      const unsigned int  n_bodies = facts.of.body_names.size();
      std::vector<double> volume(2 * n_bodies, 0.), largest(n_bodies, 0.);
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          const unsigned int b      = points.body(p);
          const double       v      = v0(points.values(p));
          const double       lambda = largest_stretch(F(points.values(p)));
          volume[n_bodies + b] += v;
          if (unevenness(lambda,
                         std::pow(v, 1. / dim) / facts.cell_size(),
                         has_boxes) > limit)
            volume[b] += v;
          largest[b] = std::max(largest[b], lambda);
        }
      Utilities::MPI::sum(volume, facts.communicator(), volume);
      Utilities::MPI::max(largest, facts.communicator(), largest);
      for (unsigned int b = 0; b < n_bodies; ++b)
        if (const double share = volume[b] / volume[n_bodies + b];
            share > smallest_part)
          return Finding{"points-apart",
                         facts.of.body_names[b],
                         share,
                         smallest_part,
                         "neighbouring points are " + text_of(largest[b], 3) +
                           " times as far apart as at first; use domains that "
                           "are split, more points, or larger cells"};
      return {};
    }



    template <int dim>
    std::optional<Finding>
    domains_beyond_cells(Facts<dim> &facts, Ledger &)
    {
      const auto n = Utilities::MPI::sum(facts.of.basis.n_far_domains(),
                                         facts.communicator());
      if (n == 0)
        return {};
      return Finding{
        "large-domains",
        "",
        1. * n,
        0,
        std::to_string(n) +
          " domains reach beyond the cells around their point; "
          "'Split domains = true' in section 'Method' halves them"};
    }



    template <int dim>
    std::optional<Finding>
    returned_points(Facts<dim> &facts, Ledger &)
    {
      const auto n =
        Utilities::MPI::sum(facts.of.points.n_returned(), facts.communicator());
      if (n == 0)
        return {};
      return Finding{"returned-points",
                     "",
                     1. * n,
                     0,
                     std::to_string(n) +
                       " points ended outside the mesh and were returned to "
                       "its edge"};
    }



    MORAINE_INSTANTIATE_CHECK(full_cells)
    MORAINE_INSTANTIATE_CHECK(uneven_cells)
    MORAINE_INSTANTIATE_CHECK(volume_twice)
    MORAINE_INSTANTIATE_CHECK(separation)
    MORAINE_INSTANTIATE_CHECK(points_apart)
    MORAINE_INSTANTIATE_CHECK(domains_beyond_cells)
    MORAINE_INSTANTIATE_CHECK(returned_points)
  } // namespace checks
} // namespace moraine
