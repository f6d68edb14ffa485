// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/load_notes.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/run/hold_watch.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Which cells material fills to less than nine tenths, on all ranks. */
    template <int dim>
    std::vector<bool>
    partly_filled_cells(const Model<dim> &model)
    {
      const std::vector<double> filled = model.points->volumes_in_cells();
      std::vector<bool>         partly(filled.size());
      for (const auto &cell :
           model.mesh->triangulation().active_cell_iterators())
        partly[cell->active_cell_index()] =
          filled[cell->active_cell_index()] < 0.9 * cell->measure();
      return partly;
    }
  } // namespace



  template <int dim>
  void
  check_loads(const StageParameters    &stage,
              const Model<dim>         &model,
              std::vector<std::string> &notes)
  {
    for (const auto &force : model.loads.body_forces)
      for (unsigned int b = 0; b < model.bodies.size(); ++b)
        if (force.times_density && force.acts_on[b] &&
            !(model.materials[b]->density() > 0))
          throw InputError("section 'Loads/" + force.name +
                           "': found gravity on body '" + model.bodies[b].name +
                           "', whose material has no 'Density', allowed: "
                           "bodies with a density > 0");
    for (const auto &traction : model.loads.side_tractions)
      {
        if (!contains(stage.loads, traction.name))
          continue;
        const unsigned int n_faces = n_faces_of(traction, model);
        if (n_faces == 0)
          throw InputError("section 'Loads/" + traction.name +
                           "': found a side of the mesh without a body beside "
                           "it, allowed: a side that a body touches");
        const unsigned int n_partly =
          n_faces_of(traction, model, partly_filled_cells(model));
        if (n_partly > 0)
          notes.push_back(
            traction.name + ": " + std::to_string(n_partly) + " of the " +
            std::to_string(n_faces) +
            " faces of cells that it pushes on belong to cells that material "
            "fills in part, and are pushed on as a whole; 'surface traction' "
            "acts on the rim of a body");
      }
  }



  template <int dim>
  void
  tell_of_loads_outside(const Model<dim>         &model,
                        std::vector<std::string> &notes)
  {
    for (const auto &load : model.loads.carried)
      if (load.share_outside() > 0.01)
        notes.push_back(
          "load " + load.name() + ": " +
          std::to_string(std::lround(100 * load.share_outside())) +
          " % of its surface is outside the mesh or beside no body, "
          "where it does not act");
  }



#define INSTANTIATE(dim)                                  \
  template void check_loads(const StageParameters &,      \
                            const Model<dim> &,           \
                            std::vector<std::string> &);  \
  template void tell_of_loads_outside(const Model<dim> &, \
                                      std::vector<std::string> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
