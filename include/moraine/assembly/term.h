// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_term_h
#define moraine_assembly_term_h

#include <moraine/assembly/boundary_report.h>
#include <moraine/assembly/global_system.h>
#include <moraine/assembly/step_context.h>
#include <moraine/basis/stencil.h>

#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace moraine
{
  /** An effect as a run tells of it. */
  struct Effect
  {
    std::string name; ///< in the list of effects
    std::string kind; ///< what the console calls it; "" if it is always there
    std::string text; ///< what the console tells of it
  };

  /** How the assembly treats a term. */
  struct TermTraits
  {
    /** The entry of the energy balance for the work of its forces. */
    WorkKind work_kind = WorkKind::external;
    /** The part of a run that begin_step() is timed as; "" if none is. */
    const char *timer      = "";
    bool        is_dead    = false; ///< its forces depend on time alone
    bool        is_inertia = false; ///< it is minus mass times acceleration
    /** It only holds what would be free: its share is watched. */
    bool stabilises = false;
    /** failure() reads where points would move. */
    bool watches_points = false;
    /** Its places have a status: open, sticking or slipping. */
    bool has_statuses = false;
    /** prepare() reads the forces of nodes. */
    bool wants_unbalanced_forces = false;
  };



  /**
   * A physical effect or a strong condition of a scene, as MechanicsSystem sees
   * it. A term exists only if the scene names it. Functions do nothing unless
   * said otherwise.
   *
   * What a term carries from step to step is committed and written by keep()
   * alone; everything else is derived from it and can be thrown away.
   */
  template <int dim>
  class Term
  {
  public:
    /** Takes batches of nodes that are coupled with each other. */
    using Couple =
      std::function<void(const unsigned int *nodes, const unsigned int n)>;

    virtual ~Term() = default;

    /** Its name and extent at the start of a step, for the console.
     * Collective. */
    virtual std::vector<Effect>
    effects(const StepContext<dim> &context) const = 0;

    virtual TermTraits
    traits() const
    {
      return {};
    }

    /** Before cells are found: whether it holds means over pieces of a surface
     * in @p cell, through which points move; see State::begin_step(). The same
     * on all ranks. */
    virtual bool
    holds_mean_in(const StepContext<dim> &,
                  const typename GridSpace<dim>::CellIterator &)
    {
      return false;
    }

    /**
     * Find cells, pieces, nodes at the start of a step, from committed values.
     * @return whether couplings or constraints of this rank are new.
     * Collective.
     */
    virtual bool
    begin_step(const StepContext<dim> &)
    {
      return false;
    }

    /** Name the nodes that it couples beyond cells and stencils. */
    virtual void
    couple(const StepContext<dim> &, const Couple &) const
    {}

    /** Add its lines to those that are there, with values at the end of the
     * step. */
    virtual void
    constrain(const StepContext<dim> &,
              dealii::AffineConstraints<double> &) const
    {}

    /** Ask for a value at the end of the step. @throws InputError, perhaps on
     * one rank alone, if there is none. */
    virtual void
    check_values(const StepContext<dim> &)
    {}

    /**
     * Add the forces of the trial state (positive where they push the nodes
     * along) and, if asked, minus their derivative to the matrix.
     */
    virtual void
    add(const StepContext<dim> &, const bool, GlobalSystem<dim> &) const
    {}

    /** Whether its derivative is symmetric. */
    virtual bool
    symmetric(const StepContext<dim> &) const
    {
      return true;
    }

    /** Why the trial state, in which points move by @p moves, cannot be
     * accepted; or "". Collective. */
    virtual std::string
    failure(const StepContext<dim> &,
            const std::vector<dealii::Tensor<1, dim>> & /*moves*/) const
    {
      return "";
    }

    /**
     * Add the forces by which the constraint @p name holds the nodes, if this
     * is its term, in the trial state; @p unbalanced as in prepare().
     */
    virtual void
    add_constraint_forces(const StepContext<dim> &,
                          const std::string & /*name*/,
                          const LA::Vector & /*unbalanced*/,
                          GlobalSystem<dim> &) const
    {}

    /**
     * Find what keep() is to commit, while everything can still be undone.
     * @p unbalanced is the residual with the forces that strong conditions
     * take. Collective.
     */
    virtual void
    prepare(const StepContext<dim> &, const LA::Vector & /*unbalanced*/)
    {}

    /** Commit what was prepared. */
    virtual void
    keep() noexcept
    {}

    /** Tell of the step that was kept; points are at its end already.
     * Collective. */
    virtual void
    report(const StepContext<dim> &, std::vector<BoundaryReport<dim>> &) const
    {}
  };

  /** A term that enforces a constraint by forces of its own, which it finds
   * anew in each trial. */
  template <int dim>
  class ConstraintTerm : public Term<dim>
  {
  public:
    /** Aim at the end of the step and forget what was tried before. */
    virtual void
    begin_trial(const StepContext<dim> &context) = 0;

    /** Aim at another end of the step; what was tried stays. */
    virtual void
    move_trial(const StepContext<dim> &)
    {}

    /** The largest violation of the constraint on this rank. */
    virtual double
    violation(const StepContext<dim> &context) const = 0;

    /** Whether places of this rank touch that did not when the last tangent was
     * added, or the other way round. */
    virtual bool
    acts_otherwise(const StepContext<dim> &) const
    {
      return false;
    }

    /** Whether another pass would change tractions by less than @p tolerance
     * times the largest one. Collective. */
    virtual bool
    is_settled(const StepContext<dim> &, const double /*tolerance*/) const
    {
      return false;
    }

    /** A violation that passes may leave where they get no better; else the
     * step has no solution. */
    virtual double
    largest_violation_left(const StepContext<dim> &) const
    {
      return std::numeric_limits<double>::max();
    }

    /** Take multipliers from the trial state, until the next begin_trial(). */
    virtual void
    augment(const StepContext<dim> &context) = 0;

    /** A length that is lost in rounding when it is divided by 1e16, however
     * small the increments are; zero if there is none. The same on all ranks.
     */
    virtual double
    rounded_length() const
    {
      return 0.;
    }

    /** In dynamics: the trial state is that at the start of the step, whose
     * forces count half in its work; see Motion. */
    virtual void
    note_start(const StepContext<dim> &)
    {}

    /** In dynamics: whether add() has its force of the whole step, so that the
     * one at the start is not among those that the integrator adds. */
    virtual bool
    acts_over_step(const StepContext<dim> &) const
    {
      return false;
    }

    /** If so, the weight that the integrator gives forces at the start of the
     * step. */
    double
    share_of_start(const StepContext<dim> &context) const
    {
      return acts_over_step(context) && context.step_size() > 0 ?
               context.motion->integrator().start_forces() :
               0.;
    }

    /** If so, the work of the step on this rank; @p of_force: that of the force
     * that add() added. */
    virtual double
    work_of_step(const StepContext<dim> &, const double of_force) const
    {
      return of_force;
    }
  };



  /** A term that is integrated over the material points. They share one pass
   * over the stencils. */
  template <int dim>
  class PointTerm : public Term<dim>
  {
  public:
    using Term<dim>::add;

    /** Term::add() for the points of a block. */
    virtual void
    add(const StepContext<dim>  &context,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const = 0;

    /** The forces alone, of a step that has begun and moved nothing yet. */
    virtual void
    add_at_start(const StepContext<dim>  &context,
                 const StencilBlock<dim> &block,
                 LocalSystem<dim>        &local) const
    {
      add(context, block, false, local);
    }
  };
} // namespace moraine

#endif
