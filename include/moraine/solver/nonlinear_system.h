// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_nonlinear_system_h
#define moraine_solver_nonlinear_system_h

#include <moraine/core/linear_algebra.h>

#include <moraine/solver/linear_report.h>

#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * The equations of one step as the solver sees them: find the increment x
   * with r(x) = 0, where r = external + boundary - internal forces and
   * K = -dr/dx, so that Newton's correction is K dx = r.
   *
   * The system owns residual and tangent and condenses constraints itself:
   * constrained rows of the residual are zero. All vectors are fully
   * distributed (owned entries only).
   */
  class NonlinearSystem
  {
  public:
    virtual ~NonlinearSystem() = default;

    /**
     * Size @p x and fill it with the start of the iteration. It satisfies the
     * constraints with their prescribed values; everything later is
     * homogeneous.
     */
    virtual void
    initial_guess(LA::Vector &x) const = 0;

    /**
     * Compute the residual at @p x and, if asked, the tangent. Entries that
     * are not finite say that the state at @p x does not exist (an inverted
     * point, say); Newton then takes a shorter step.
     *
     * The first residual and tangent after initial_guess() may be those
     * linearised about the start of the step, so that prescribed values reach
     * the whole body at once instead of the cells beside them.
     */
    virtual void
    assemble(const LA::Vector &x, const bool tangent) = 0;

    /** Whether places have come into contact or left it since the last tangent
     * was assembled: the residual at the end of Newton's step may be larger,
     * though the step is a good one. Collective. */
    virtual bool
    acts_otherwise() const
    {
      return false;
    }

    /** Whether those of the last assemble() were linearised. */
    virtual bool
    linearised() const
    {
      return false;
    }

    /**
     * Why the residual of the last assemble() is not finite, or "". Collective.
     */
    virtual std::string
    failure() const
    {
      return "";
    }

    /** After the first tangent of a step: why it determines no solution, as of
     * a body that nothing holds, or "". Collective. */
    virtual std::string
    why_not_held() const
    {
      return "";
    }

    /** Where an unknown is, as "the node at (1 2)", or "". Collective. */
    virtual std::string
    place_of(const dealii::types::global_dof_index) const
    {
      return "";
    }

    /** The tangent of the last assemble(x, true). A new object whenever its
     * sparsity pattern is new: solvers keep what they know of the old one. */
    virtual std::shared_ptr<const LA::SparseMatrix>
    tangent() const = 0;

    /** The residual of the last assemble(). */
    virtual const LA::Vector &
    residual() const = 0;

    /**
     * The norm of the forces that should balance, as of the last assemble(),
     * for each part of the system (a body, say); the residual of each part is
     * measured against it.
     */
    virtual std::vector<double>
    force_scales() const = 0;

    /** The part of each owned unknown, in order; empty if there is one part. */
    virtual const std::vector<unsigned int> &
    part_of_unknown() const
    {
      static const std::vector<unsigned int> one_part;
      return one_part;
    }

    /**
     * A motion (length) that is lost in rounding when it is divided by 1e16,
     * however small the increments are: strains are sums of 1 and their
     * gradients, say. Zero if they are not.
     */
    virtual double
    displacement_scale() const
    {
      return 0.;
    }

    /** Whether the tangent is symmetric. */
    virtual bool
    symmetric() const = 0;

    /** Rigid-body modes on the unknowns, zero where constrained. Empty if not
     * known. */
    virtual const std::vector<LA::Vector> &
    near_null_space() const = 0;

    /** Fill the constrained entries of a correction from the free ones
     * (homogeneous constraints). */
    virtual void
    apply_constraints(LA::Vector &dx) const = 0;

    /** Forget what assemble() and augment() changed: the step begins anew. */
    virtual void
    start_over()
    {}

    /**
     * Called at a converged @p x: update what the system carries along
     * (multipliers of an augmented Lagrangian). True asks for another pass
     * with the same tangent. @p tolerance: that of Newton's method.
     */
    virtual bool
    augment(const LA::Vector &, const double /*tolerance*/)
    {
      return false;
    }
  };



  /** Why equations of @p system were not solved, and where if that is known.
   * Collective. */
  inline std::string
  failure_of(const LinearReport &linear, const NonlinearSystem &system)
  {
    const std::string place =
      linear.loosest_unknown ? system.place_of(*linear.loosest_unknown) : "";
    return linear.solver + ": " + linear.message +
           (place.empty() ? "" : ", most of all at " + place);
  }
} // namespace moraine

#endif
