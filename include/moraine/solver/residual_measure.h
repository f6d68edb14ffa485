// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_residual_measure_h
#define moraine_solver_residual_measure_h

#include <moraine/solver/nonlinear_system.h>

#include <vector>

namespace moraine
{
  /** Of each part of a system: the norm of its residual and the goal for it. */
  struct ResidualParts
  {
    std::vector<double> norms;
    std::vector<double> goals;
  };



  /**
   * How far a residual is from what counts as balance. Each part k of the
   * system has its goal,
   *
   * @f[ g_k = \max(\text{tol}\, s_k, \ \text{abs}, \ 10^{-14} s_k^0, \
   *     4 \epsilon \lVert \mathrm{diag} K\, (|x| + \ell) \rVert_k) , @f]
   *
   * @f$s_k@f$ its force scale, @f$s_k^0@f$ that at the start of the step, and
   * the last term what rounding leaves of the residual, with the system's
   * displacement scale @f$\ell@f$ and K at most @f$10^{10}@f$ times its
   * geometric mean: a point that is squeezed to nothing is no excuse for the
   * forces of the others. The distance is
   * @f$(\sum_k \lVert r \rVert_k^2 / g_k^2)^{1/2}@f$, 1 or less in balance; a
   * soft part is not forgiven because a stiff one has larger forces.
   */
  class ResidualMeasure
  {
  public:
    ResidualMeasure(const NonlinearSystem &system,
                    const double           tolerance,
                    const double           absolute_tolerance)
      : system(system)
      , tolerance(tolerance)
      , absolute_tolerance(absolute_tolerance)
    {}

    /** After an assemble() at @p x; @p tangent: with a new tangent. */
    void
    update(const LA::Vector &x, const bool tangent);

    /** The force scales are now those of the start of the step. */
    void
    start()
    {
      scales_at_start = scales;
    }

    const ResidualParts &
    parts() const
    {
      return now;
    }

    /** Whether the residual of the last assemble() is a number. */
    bool
    finite() const;

    /** Of the residual of the last assemble(), 1 or less in balance. */
    double
    distance() const;

    /** Whether the residual of a part that has forces, a hundred times as large
     * at least, is more than 1e-6 and the tolerance of them: if it counts as
     * balanced, then by what rounding may leave of stiff entries, or of forces
     * at the start. */
    bool
    much_is_forgiven() const;

    /** The residual over that @p before, both by the larger goal of each part:
     * the goals of a part that was without forces say nothing. */
    double
    ratio_to(const ResidualParts &before) const;

    /** The residual over the force scales, the norm where they are zero. */
    double
    relative() const;

    /** The factors of the unknowns that make distance() a norm. Null if there
     * is one part: it is then the norm over goals[0]. */
    const LA::Vector *
    weights();

    /** The norm of weights() times the residual at @p distance. */
    double
    weighted_norm(const double distance) const
    {
      return now.goals.size() == 1 ? distance * now.goals[0] : distance;
    }

  private:
    std::vector<double>
    norms_of_parts(const LA::Vector &v) const;

    /** Of the tangent, whose unknowns are like those of @p x. */
    void
    take_diagonal(const LA::Vector &x);

    const NonlinearSystem &system;
    const double           tolerance;
    const double           absolute_tolerance;
    LA::Vector             diagonal;
    LA::Vector             weight;
    std::vector<double>    scales;
    std::vector<double>    scales_at_start;
    ResidualParts          now;
  };
} // namespace moraine

#endif
