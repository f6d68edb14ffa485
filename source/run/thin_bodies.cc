// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/thin_bodies.h>

#include <moraine/core/words.h>
#include <moraine/state/aggregates.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What a body has of a cell of its own is more than this. */
    constexpr double least_share = 0.01, most_share = 0.5;

    /** Of shear moduli: a soft and a stiff body. */
    constexpr double contrast = 10;

    /** Of the volume of a soft body: what does not give way is told of. */
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
            parts[b][cell->active_cell_index()] /= cell->measure();
        }
      return parts;
    }



    /** What share of the soft body is in cells that the stiff one has a part
     * of. @param volumes of cells */
    double
    share_beside(const std::vector<double> &stiff,
                 const std::vector<double> &soft,
                 const std::vector<double> &volumes)
    {
      double beside = 0, all = 0;
      for (unsigned int c = 0; c < stiff.size(); ++c)
        {
          const double volume = soft[c] * volumes[c];
          all += volume;
          if (stiff[c] > least_share)
            beside += volume;
        }
      return beside / all;
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



    /** That a stiff body fills @p n cells by less than half beside a soft one,
     * of which @p share is in cells of both. */
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
          text
            << soft << ": " << std::lround(100 * share)
            << " % of its volume is in cells that '" << stiff
            << "', much stiffer, has a share of, and hardly gives way there; "
               "settlements come out too small by about as much: let it end "
               "on mesh lines, or take smaller cells";
          notes.push_back(text.str());
        }
    }
  } // namespace



  template <int dim>
  void
  tell_of_thin_bodies(const Model<dim>               &model,
                      const std::vector<std::string> &known,
                      std::vector<std::string>       &notes)
  {
    const auto          parts = filled_parts(model);
    std::vector<double> volumes;
    for (const auto &cell : model.mesh->triangulation().active_cell_iterators())
      volumes.push_back(cell->measure());
    for (unsigned int b = 0; b < parts.size(); ++b)
      {
        if (!model.present[b])
          continue;
        const std::string &name    = model.body_names[b];
        const bool         is_new  = !contains(known, name);
        const auto         in_bulk = vertices_in_bulk(*model.space, parts[b]);
        if (is_new && model.space->degree() == 1 &&
            std::find(in_bulk.begin(), in_bulk.end(), true) == in_bulk.end())
          notes.push_back(
            name +
            ": nowhere as thick as one and a half cells; linear functions make "
            "what bends much too stiff there, smaller cells or 'Degree = 2' "
            "with method 'finite element' do not");
        const double mu = model.materials[b]->elastic_stiffness().mu;
        for (unsigned int a = 0; a < parts.size(); ++a)
          if (model.present[a] &&
              (is_new || !contains(known, model.body_names[a])) &&
              mu > contrast * model.materials[a]->elastic_stiffness().mu)
            tell_of_shared_cells(name,
                                 model.body_names[a],
                                 n_shared(parts[b], parts[a]),
                                 share_beside(parts[b], parts[a], volumes),
                                 notes);
      }
  }



  template void
  tell_of_thin_bodies(const Model<2> &,
                      const std::vector<std::string> &,
                      std::vector<std::string> &);
  template void
  tell_of_thin_bodies(const Model<3> &,
                      const std::vector<std::string> &,
                      std::vector<std::string> &);
} // namespace moraine
