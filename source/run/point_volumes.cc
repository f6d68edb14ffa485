// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/point_volumes.h>

#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools_cache.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the volume of points: what cells have no room for. A grid of points
     * has at most 0.20 in 2D and 0.26 in 3D, if it is nearly as coarse as the
     * cells: those near a face reach into the next cell. */
    template <int dim>
    constexpr double told_excess = dim == 2 ? 0.22 : 0.3;

    /** What points of cells in the inside of bodies have too much or too
     * little, over the volume of these cells, root of the mean square. */
    constexpr double told_unevenness = 0.1;

    /** What cells that have points of new and of old bodies are filled by:
     * where these only meet, points near faces may fill them by a quarter more.
     */
    constexpr double told_fill = 1.3;

    /** What a new body shares with others, of its volume. */
    constexpr double told_share_of_volume = 0.02;



    template <int dim>
    void
    tell_of_full_cells(const Model<dim>          &model,
                       const std::vector<double> &volumes,
                       std::vector<std::string>  &notes)
    {
      double all = 0, too_much = 0;
      for (const auto &cell :
           model.mesh->triangulation().active_cell_iterators())
        {
          const double volume = volumes[cell->active_cell_index()];
          all += volume;
          too_much += std::max(0., volume - volume_of_cell(cell));
        }
      if (too_much > told_excess<dim> * all)
        notes.push_back("points: cells have no room for " +
                        per_cent(too_much / all) +
                        " of their volume; the points of a file are in it "
                        "twice, their volumes are wrong, or there are fewer "
                        "than one for a cell");
    }



    /** Cells in the inside of bodies whose points are given have points in all
     * cells around; at the edge of the mesh nothing tells whether the body
     * fills them. */
    template <int dim>
    void
    tell_of_uneven_cells(const Model<dim>          &model,
                         const std::vector<double> &volumes,
                         std::vector<std::string>  &notes)
    {
      const auto &cells_at_vertex =
        model.mesh->search_cache().get_vertex_to_cell_map();
      std::vector<double> drawn(volumes.size(), 0.); // points of shapes
      for (const auto &in_cell : model.points->cells())
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          if (model.bodies[model.points->body(p)].shape)
            drawn[in_cell.cell->active_cell_index()] = 1;
      Utilities::MPI::max(drawn, model.space->communicator(), drawn);
      double all = 0, squares = 0, most = 0;
      double least = std::numeric_limits<double>::max();
      for (const auto &cell :
           model.mesh->triangulation().active_cell_iterators())
        {
          const auto has_points = [&](const auto &near) {
            return volumes[near->active_cell_index()] > 0;
          };
          const auto vertices = cell->vertex_indices();
          if (cell->at_boundary() || drawn[cell->active_cell_index()] > 0 ||
              !std::all_of(vertices.begin(), vertices.end(), [&](const auto a) {
                const auto &near = cells_at_vertex[cell->vertex_index(a)];
                return std::all_of(near.begin(), near.end(), has_points);
              }))
            continue;
          const double filled =
            volumes[cell->active_cell_index()] / volume_of_cell(cell);
          all += volume_of_cell(cell);
          squares += volume_of_cell(cell) * (filled - 1) * (filled - 1);
          least = std::min(least, filled);
          most  = std::max(most, filled);
        }
      if (squares > told_unevenness * told_unevenness * all)
        notes.push_back(
          "points: cells in the inside of bodies have points for " +
          per_cent(least) + " to " + per_cent(most) +
          " of their volume, and a method without domains integrates as if "
          "there were that much material: stresses come out wrong by as much, "
          "displacements by a part of it, with smaller cells, too; points that "
          "fit the cells ('Points per direction' alone) or 'Method = GIMP' help");
    }
  } // namespace



  template <int dim>
  void
  tell_of_point_volumes(const Model<dim>         &model,
                        std::vector<std::string> &notes)
  {
    if (std::all_of(model.bodies.begin(),
                    model.bodies.end(),
                    [](const auto &body) { return body.shape; }))
      return;
    const std::vector<double> volumes = model.points->volumes_in_cells();
    tell_of_full_cells(model, volumes, notes);
    if (!model.basis->has_domains())
      tell_of_uneven_cells(model, volumes, notes);
  }



  template <int dim>
  void
  tell_of_volume_twice(const Model<dim>               &model,
                       const std::vector<std::string> &bodies,
                       const std::vector<std::string> &known,
                       std::vector<std::string>       &notes)
  {
    const auto         &tria = model.mesh->triangulation();
    const unsigned int  n    = tria.n_active_cells();
    std::vector<double> volumes(2 * n, 0.); // of bodies known, of new ones
    for (const auto &in_cell : model.points->cells())
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        {
          const bool is_known =
            contains(known, model.body_names[model.points->body(p)]);
          volumes[(is_known ? 0 : n) + in_cell.cell->active_cell_index()] +=
            model.points->volume(p);
        }
    Utilities::MPI::sum(volumes, model.space->communicator(), volumes);
    double of_new = 0, twice = 0;
    for (const auto &cell : tria.active_cell_iterators())
      {
        const double of_known = volumes[cell->active_cell_index()];
        const double comes    = volumes[n + cell->active_cell_index()];
        of_new += comes;
        if (of_known > 0 && comes > 0 &&
            of_known + comes > told_fill * volume_of_cell(cell))
          twice += of_known + comes - volume_of_cell(cell);
      }
    if (!(twice > told_share_of_volume * of_new))
      return;
    std::string names;
    for (const std::string &body : bodies)
      if (!contains(known, body))
        names += (names.empty() ? "" : ", ") + body;
    notes.push_back(names + ": about " + per_cent(twice / of_new) +
                    " of what comes stands where material is that has moved "
                    "since it was drawn, which is there twice; draw it from "
                    "where the surface is now");
  }



  template void
  tell_of_point_volumes(const Model<2> &, std::vector<std::string> &);
  template void
  tell_of_point_volumes(const Model<3> &, std::vector<std::string> &);
  template void
  tell_of_volume_twice(const Model<2> &,
                       const std::vector<std::string> &,
                       const std::vector<std::string> &,
                       std::vector<std::string> &);
  template void
  tell_of_volume_twice(const Model<3> &,
                       const std::vector<std::string> &,
                       const std::vector<std::string> &,
                       std::vector<std::string> &);
} // namespace moraine
