// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_constraint_table_h
#define moraine_assembly_constraint_table_h

#include <moraine/core/linear_algebra.h>

#include <deal.II/base/index_set.h>

#include <deal.II/lac/affine_constraints.h>

#include <functional>

namespace moraine
{
  /**
   * The strong conditions on the unknowns of a step: lines
   * @f$\Delta u_i = \sum_j w_{ij} \Delta u_j + g_i@f$ for matrix and force
   * alike. With @f$\Delta u = W \Delta v + g@f$ the equations are
   * @f$W^T r = 0@f$ and the tangent is @f$W^T K W@f$. Ranks hold the lines of
   * all unknowns they know.
   *
   * Material beyond prescribed unknowns moves on as that before them does. What
   * acts on it the prescribed ones take: where the weights of prescribed
   * @f$j@f$ sum up to 1 or more, row i of W is left out of @f$W^T@f$. Handed to
   * the free ones, it would pull at the material before the prescribed ones.
   */
  class ConstraintTable
  {
  public:
    using AddLines = std::function<void(dealii::AffineConstraints<double> &)>;

    /** Take new lines among the unknowns @p relevant. Forces beyond prescribed
     * unknowns are theirs if @p prescribed_take, else those of the tie, which
     * keeps the tangent symmetric. Collective. */
    void
    reinit(const dealii::IndexSet &relevant,
           const MPI_Comm         &communicator,
           const AddLines         &add_lines,
           const bool              prescribed_take = false);

    /** The same lines with new @f$g@f$. */
    void
    set_values(const AddLines &add_lines);

    /** Whether any rank has a line. */
    bool
    any_lines() const
    {
      return has_lines;
    }

    /** Whether a @f$g@f$ of any rank is not zero. Collective. */
    bool
    any_values(const MPI_Comm &communicator) const;

    /** The lines without @f$g@f$: those of corrections and of the matrix. */
    const dealii::AffineConstraints<double> &
    homogeneous() const
    {
      return lines;
    }

    /** Whether an unknown is prescribed, not tied to others. */
    bool
    prescribes(const dealii::types::global_dof_index dof) const;

    /** Tied unknowns whose forces prescribed ones take. */
    const dealii::IndexSet &
    taken() const
    {
      return taken_by_prescribed;
    }

    /** Whether any rank has some. */
    bool
    any_taken() const
    {
      return has_taken;
    }

    /** Fill the constrained entries from the free ones. Collective. */
    void
    distribute(LA::Vector &x) const;

    /** The same for a correction, without @f$g@f$. Collective. */
    void
    distribute_correction(LA::Vector &dx) const;

    /** @f$r \leftarrow W^T r@f$ on owned entries. Collective. */
    void
    condense(LA::Vector &force) const;

    /** Give the forces of tied unknowns to those they are tied to, which may be
     * prescribed: reactions are read there. Collective. */
    void
    hand_over_ties(LA::Vector &force) const;

  private:
    dealii::AffineConstraints<double> lines;
    dealii::AffineConstraints<double> lines_with_values;
    /** Those to other unknowns, as terms added them: some of the others may be
     * prescribed. */
    std::vector<dealii::AffineConstraints<double>::ConstraintLine> ties;
    dealii::IndexSet taken_by_prescribed;
    bool             has_lines = false;
    bool             has_ties  = false;
    bool             has_taken = false;
    bool             takes     = false;
  };
} // namespace moraine

#endif
