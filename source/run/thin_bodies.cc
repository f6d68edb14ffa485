// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/thin_bodies.h>

#include <moraine/core/words.h>
#include <moraine/state/aggregates.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What a body has of a cell of its own is more than this. */
    constexpr double least_share = 0.01, most_share = 0.5;

    /** Of the vertices of a body along the edge of the mesh: from here on what
     * holds them does not let it bend. */
    constexpr double held_share = 0.4;

    /** Of shear moduli: a stiff body makes cells stiff beside a soft one. */
    constexpr double contrast = 10;

    /** Of cells side by side: what fills as much of both, but for round-off, is
     * one and a half cells thick there. */
    constexpr double least_of_pair = 1.5 - 1e-9;

    /** Of the compression of a soft body: what is held back is told of. */
    constexpr double told_share_of_soft = 0.05;



    /** What part of each active cell every body fills; the same on all ranks.
     */
    template <int dim>
    std::vector<std::vector<double>>
    filled_parts(const Model<dim> &model)
    {
      const auto         &tria  = model.mesh->triangulation();
      const unsigned int  n     = tria.n_active_cells();
      const unsigned int  n_all = n * model.bodies.size();
      std::vector<double> volumes(n_all, 0.);
      for (const auto &in_cell : model.points->cells())
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          volumes[model.points->body(p) * n +
                  in_cell.cell->active_cell_index()] += model.points->volume(p);
      Utilities::MPI::sum(volumes, tria.get_communicator(), volumes);
      std::vector<std::vector<double>> parts(model.bodies.size());
      for (unsigned int b = 0; b < parts.size(); ++b)
        {
          parts[b].assign(volumes.begin() + b * n,
                          volumes.begin() + (b + 1) * n);
          for (const auto &cell : tria.active_cell_iterators())
            parts[b][cell->active_cell_index()] /= volume_of_cell(cell);
        }
      return parts;
    }



    /** Vertices of cells that a boundary or a condition of the stage holds in
     * any direction; the same on all ranks. */
    template <int dim>
    std::vector<double>
    held_vertices(const StageParameters &stage, const Model<dim> &model)
    {
      const auto         &tria = model.mesh->triangulation();
      std::vector<double> held(tria.n_vertices(), 0.);
      for (const auto &entry :
           find_prescribed_nodes(acting_conditions(model.grid_conditions,
                                                   stage),
                                 *model.space,
                                 stage.time.start_time)
             .entries)
        for (const unsigned int v : model.space->node_vertices(entry.node))
          held[v] = 1;
      std::vector<bool> holds(tria.n_active_cells(), false);
      for (const auto &boundary : model.boundaries)
        if (contains(stage.boundaries, boundary.name()))
          for (const auto &point : boundary.points())
            holds[point.cell] = true;
      for (const auto &cell : tria.active_cell_iterators())
        if (holds[cell->active_cell_index()])
          for (const unsigned int a : cell->vertex_indices())
            held[cell->vertex_index(a)] = 1;
      Utilities::MPI::max(held, tria.get_communicator(), held);
      return held;
    }



    /** Vertices within what fills @p parts of cells: of the cells around one
     * all but a quarter is filled, or it is thick in each direction. */
    template <int dim>
    std::vector<bool>
    thick_vertices(const Model<dim> &model, const std::vector<double> &parts)
    {
      std::vector<bool> thick = vertices_in_bulk(*model.space, parts);
      for (const auto &cell :
           model.mesh->triangulation().active_cell_iterators())
        if (const double part = parts[cell->active_cell_index()];
            part > most_share)
          for (const unsigned int v : cell->vertex_indices())
            {
              const auto &faces = GeometryInfo<dim>::vertex_to_face[v];
              if (std::all_of(faces.begin(),
                              faces.end(),
                              [&](const unsigned int f) {
                                return cell->at_boundary(f) ||
                                       part + parts[cell->neighbor(f)
                                                      ->active_cell_index()] >=
                                         least_of_pair;
                              }))
                thick[cell->vertex_index(v)] = true;
            }
      return thick;
    }



    /** Whether a body, of which @p parts fill the cells, is nowhere as thick as
     * one and a half cells, or as a cell if the mesh is as thick, hardly any of
     * its vertices are @p held and nothing hangs on it: @p all_in_bulk says
     * which vertices are within all bodies together. */
    template <int dim>
    bool
    is_thin(const Model<dim>          &model,
            const std::vector<double> &parts,
            const std::vector<bool>   &all_in_bulk,
            const std::vector<double> &held)
    {
      const auto             &tria    = model.mesh->triangulation();
      const std::vector<bool> in_bulk = thick_vertices(model, parts);
      std::vector<bool>       at_edge(in_bulk.size(), false),
        is_its(in_bulk.size(), false);
      for (const auto &cell : tria.active_cell_iterators())
        {
          if (parts[cell->active_cell_index()] > most_share)
            for (const unsigned int a : cell->vertex_indices())
              is_its[cell->vertex_index(a)] = true;
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              for (unsigned int a = 0; a < face->n_vertices(); ++a)
                at_edge[face->vertex_index(a)] = true;
        }
      unsigned int n = 0, n_held = 0;
      bool         hangs_on = false;
      for (unsigned int v = 0; v < in_bulk.size(); ++v)
        {
          hangs_on = hangs_on || (is_its[v] && all_in_bulk[v] && !at_edge[v]);
          if (!in_bulk[v])
            continue;
          if (!at_edge[v])
            return false;
          ++n;
          n_held += held[v] > 0;
        }
      return n == 0 || (n_held < held_share * n && !hangs_on);
    }



    /** What cells of both hold back of the compression of a soft body, over all
     * of it: layers in a row give way by the mean of their compliances, the one
     * displacement of a cell by that of their stiffnesses.
     * @param ratio of the stiffnesses
     * @param volumes of cells */
    double
    share_held_back(const std::vector<double> &stiff,
                    const std::vector<double> &soft,
                    const double               ratio,
                    const std::vector<double> &volumes)
    {
      double held = 0, all = 0;
      for (unsigned int c = 0; c < stiff.size(); ++c)
        {
          all += soft[c] * volumes[c];
          if (!(stiff[c] > least_share) || !(soft[c] > 0))
            continue;
          const double both = soft[c] + stiff[c];
          held += volumes[c] * (soft[c] + stiff[c] / ratio -
                                both * both / (soft[c] + ratio * stiff[c]));
        }
      return held / all;
    }



    /** The number of cells that the stiff body fills in part beside the soft
     * one. */
    unsigned int
    n_shared(const std::vector<double> &stiff, const std::vector<double> &soft)
    {
      unsigned int n = 0;
      for (unsigned int c = 0; c < stiff.size(); ++c)
        n += stiff[c] > least_share && stiff[c] < most_share &&
             soft[c] > least_share;
      return n;
    }



    /** The number of cells in which the stiff body has next to nothing beside
     * the soft one. */
    unsigned int
    n_slivers(const std::vector<double> &stiff, const std::vector<double> &soft)
    {
      unsigned int n = 0;
      for (unsigned int c = 0; c < stiff.size(); ++c)
        n += stiff[c] > 0 && stiff[c] <= least_share && soft[c] > least_share;
      return n;
    }



    /** That a stiff body has a sliver in @p n cells of a soft one. */
    void
    tell_of_slivers(const std::string        &stiff,
                    const std::string        &soft,
                    const unsigned int        n,
                    const double              ratio,
                    std::vector<std::string> &notes)
    {
      if (n == 0)
        return;
      std::ostringstream text;
      text
        << std::setprecision(3) << stiff << ": fills " << n
        << " cells by less than a hundredth, which are else of '" << soft
        << "', softer: with the strain of that, its stress is up to " << ratio
        << " times too large there, at these points only; let it end on mesh "
           "lines";
      notes.push_back(text.str());
    }



    /** That a stiff body fills @p n cells by less than half beside a soft one,
     * and that cells of both hold back @p share of the compression of that. */
    void
    tell_of_shared_cells(const std::string        &stiff,
                         const std::string        &soft,
                         const unsigned int        n,
                         const double              share,
                         std::vector<std::string> &notes)
    {
      std::ostringstream text;
      if (n > 0)
        {
          text << stiff << ": fills " << n
               << " cells by less than half, which '" << soft
               << "', much softer, has a share of; they become as stiff as '"
               << stiff
               << "', and limit loads too high: let it end on mesh lines, or "
                  "take smaller cells";
          notes.push_back(text.str());
          text.str("");
        }
      if (share > told_share_of_soft)
        {
          text << soft << ": cells that '" << stiff
               << "', stiffer, has a share of hold back about "
               << std::lround(100 * share)
               << " % of its compression across them, and settlements: let it "
                  "end on mesh lines, or take smaller cells";
          notes.push_back(text.str());
        }
    }
  } // namespace



  template <int dim>
  void
  tell_of_thin_bodies(const StageParameters          &stage,
                      const Model<dim>               &model,
                      const std::vector<std::string> &known,
                      std::vector<std::string>       &notes)
  {
    const auto          parts = filled_parts(model);
    const auto          held  = held_vertices(stage, model);
    std::vector<double> all(parts[0].size(), 0.);
    for (const auto &of_body : parts)
      for (unsigned int c = 0; c < all.size(); ++c)
        all[c] += of_body[c];
    const std::vector<bool> all_in_bulk = thick_vertices(model, all);
    std::vector<double>     volumes;
    for (const auto &cell : model.mesh->triangulation().active_cell_iterators())
      volumes.push_back(volume_of_cell(cell));
    for (unsigned int b = 0; b < parts.size(); ++b)
      {
        if (!model.present[b])
          continue;
        const std::string &name   = model.body_names[b];
        const bool         is_new = !contains(known, name);
        if (is_new && model.space->degree() == 1 &&
            is_thin(model, parts[b], all_in_bulk, held))
          notes.push_back(
            name +
            ": nowhere as thick as one and a half cells; what bends comes out "
            "much too stiff there, by 'Volumetric strain = cell mean' much too "
            "soft; smaller cells, or 'Degree = 2' with method 'finite element',"
            " help");
        const auto modulus = [&model](const unsigned int body) {
          return model.materials[body]->elastic_stiffness().mu;
        };
        for (unsigned int a = 0; a < parts.size(); ++a)
          if (model.present[a] &&
              (is_new || !contains(known, model.body_names[a])) &&
              modulus(b) > modulus(a))
            {
              const double ratio = modulus(b) / modulus(a);
              if (ratio > contrast)
                tell_of_slivers(name,
                                model.body_names[a],
                                n_slivers(parts[b], parts[a]),
                                ratio,
                                notes);
              tell_of_shared_cells(
                name,
                model.body_names[a],
                ratio > contrast ? n_shared(parts[b], parts[a]) : 0,
                share_held_back(parts[b], parts[a], ratio, volumes),
                notes);
            }
      }
  }



  template void
  tell_of_thin_bodies(const StageParameters &,
                      const Model<2> &,
                      const std::vector<std::string> &,
                      std::vector<std::string> &);
  template void
  tell_of_thin_bodies(const StageParameters &,
                      const Model<3> &,
                      const std::vector<std::string> &,
                      std::vector<std::string> &);
} // namespace moraine
