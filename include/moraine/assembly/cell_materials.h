// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_cell_materials_h
#define moraine_assembly_cell_materials_h

#include <moraine/material/material.h>
#include <moraine/state/state.h>

#include <vector>

namespace moraine
{
  /**
   * The material in each cell, for terms that are not integrated over points
   * but scale with its stiffness: a mean, weighted with the volumes of points.
   * A cell without points, which domains reach into, has that of the points
   * that touch its nodes. Cells of other ranks are not known.
   */
  template <int dim>
  class CellMaterials
  {
  public:
    /** Look at the points where they are now. Collective. */
    void
    update(const State<dim> &state);

    /** The body that has most of the material of an active cell. */
    unsigned int
    body(const unsigned int active_cell_index) const
    {
      return body_of_cell[active_cell_index];
    }

    const LameConstants &
    elastic_stiffness(const unsigned int active_cell_index) const
    {
      return stiffness[active_cell_index];
    }

    double
    density(const unsigned int active_cell_index) const
    {
      return densities[active_cell_index];
    }

  private:
    /** Give a cell the mean of its points, if it has any, from sums over them.
     */
    void
    take_mean(const State<dim>          &state,
              const unsigned int         cell,
              const std::vector<double> &sums);

    /** Of active cells of this rank. Collective. */
    void
    update_cells_without_points(const State<dim>  &state,
                                const unsigned int n_sums);

    std::vector<LameConstants> stiffness;
    std::vector<double>        densities;
    std::vector<unsigned int>  body_of_cell;
  };
} // namespace moraine

#endif
