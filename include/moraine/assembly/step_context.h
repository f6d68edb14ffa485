// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_step_context_h
#define moraine_assembly_step_context_h

#include <moraine/assembly/cell_materials.h>
#include <moraine/state/motion.h>
#include <moraine/state/state.h>

#include <vector>

namespace moraine
{
  /**
   * What terms are told of a step: from when to when, the state at its start
   * and the trial motion of the nodes. Quasi-static steps know nothing of the
   * motion but its increments @f$\Delta u@f$; a time integrator adds
   * velocities, accelerations and their derivatives by @f$\Delta u@f$ here, for
   * the terms that ask.
   */
  template <int dim>
  struct StepContext
  {
    /** Committed values of points, unknowns, and the trial increments. */
    const State<dim>  &state;
    CellMaterials<dim> cell_materials;
    double             t_start = 0; ///< @f$t_n@f$
    double             t_end   = 0; ///< @f$t_{n+1}@f$
    /** Points close to the edge of the active cells stand for material that
     * reaches over it by this much: the size of the largest one. */
    double search_tolerance = 0;
    /** Whether unknowns or their couplings are new in this step. */
    bool couplings_changed = true;
    /** Whether cells are not where they were, or others are active. */
    bool cells_moved = true;
    /** Whether the mesh that points move through moves between steps. */
    bool mesh_moves = false;
    /** Velocities and accelerations of nodes; none in quasi-static steps. */
    Motion<dim> *motion = nullptr;

    explicit StepContext(const State<dim> &state)
      : state(state)
    {}

    /** @f$\Delta t@f$ */
    double
    step_size() const
    {
      return t_end - t_start;
    }

    /** How far in the step the forces are that are asked for: 1, or 1/2. */
    double
    share_of_step() const
    {
      return motion && motion->integrator().forces_in_the_middle() ? 0.5 : 1.;
    }

    /** Where in the step a curved roller pushes: 1, its end, or the place that
     * weighs forces at both ends as the integrator does. */
    double
    share_of_push() const
    {
      return motion && !motion->integrator().forces_in_the_middle() ?
               motion->integrator().divisor() :
               share_of_step();
    }

    /** Whether forces balance in the places at the end of the step, as at
     * finite strain; else in those at its start, about which they have moments.
     */
    bool
    balances_at_end() const
    {
      return state.strain_measure() == StrainMeasure::finite;
    }

    /** Trial increments @f$\Delta u_a@f$ of the nodes. */
    const std::vector<dealii::Tensor<1, dim>> &
    increments() const
    {
      return state.nodal_increments();
    }
  };
} // namespace moraine

#endif
