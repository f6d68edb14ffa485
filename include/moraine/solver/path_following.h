// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_path_following_h
#define moraine_solver_path_following_h

#include <moraine/solver/newton.h>

#include <optional>

namespace moraine
{
  /** The equations of one step with a parameter t, on which forces and
   * prescribed values depend: r(x, t) = 0 is a path of equilibria. */
  class PathSystem : public NonlinearSystem
  {
  public:
    /** Take another t within the step: what was tried stays. Collective. */
    virtual void
    set_parameter(const double t) = 0;

    /**
     * Positive weights m of the unknowns that make
     * @f$\lVert x \rVert = (\sum_i m_i x_i^2)^{1/2}@f$ a mean over the body,
     * whatever the mesh. Collective.
     */
    virtual LA::Vector
    path_weights() const = 0;
  };



  /** A step along a path of equilibria. */
  struct PathStep
  {
    double radius;  ///< @f$R@f$: the norm of the increment
    double t_start; ///< the parameter of the state from which it goes
    double t_min;   ///< the parameter stays between these;
    double t_max;   ///< the step is shorter where it ends at one of them

    /** The step before, as far as unknowns still have it. */
    struct Before
    {
      LA::Vector x;
      double     dt_ds; ///< change of the parameter per length
    };

    /** None in the first step, in which t grows. */
    std::optional<Before> before;
  };



  /** What a step along a path of equilibria came to. */
  struct PathReport : public NewtonReport
  {
    double t = 0;

    /** Whether forces or prescribed values change with the parameter. */
    bool parameter_acts = true;
  };



  /**
   * Find the equilibrium at the distance R along the path: the parameter t is
   * an unknown beside x,
   *
   * @f[ r(x, t) = 0, \qquad \sum_i m_i x_i^2 = R^2 , @f]
   *
   * so that the path may have turning points in t (arc length method,
   * cylindrical constraint: Crisfield 1981, doi
   * 10.1016/0045-7949(81)90108-5). Both are linearised together (Ramm 1981):
   * with @f$K \delta_r = r@f$ and @f$K \delta_t = \partial r/\partial t@f$, by
   * one factorisation,
   *
   * @f[ \delta x = \delta_r + \delta t\, \delta_t, \quad
   *     2 \sum m x (\delta_r + \delta t\, \delta_t) = R^2 - \sum m x^2 . @f]
   *
   * No root has to be chosen, as Crisfield's own way asks for.
   * @f$\partial r/\partial t@f$ is a difference quotient.
   *
   * The predictor is @f$\pm R\, \delta_t / \lVert \delta_t \rVert@f$, ahead of
   * the step before; or, if the angle between the two has a cosine below 0.9,
   * that step's increment at the length R: where material flows, the tangent at
   * the start of a step is that of unloading and points elsewhere.
   *
   * @param parameters tolerance and number of iterations, as of Newton's method
   * @param system at the start of a step, with t_start as its parameter
   * @param linear_solver for the tangents of the system
   * @param step how far to go, between which parameters, and after which step
   * @param x at the end the last iterate, a solution if the report says so;
   * the system then has the report's parameter
   * @param watcher called after each correction
   */
  PathReport
  follow_path(const NewtonParameters &parameters,
              PathSystem             &system,
              LinearSolver           &linear_solver,
              const PathStep         &step,
              LA::Vector             &x,
              const Newton::Watcher  &watcher = {});
} // namespace moraine

#endif
