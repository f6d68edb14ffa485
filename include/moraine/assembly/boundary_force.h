// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_boundary_force_h
#define moraine_assembly_boundary_force_h

#include <moraine/assembly/boundary_piece.h>
#include <moraine/assembly/local_system.h>
#include <moraine/boundary/implicit_boundary.h>

#include <vector>

namespace moraine
{
  /**
   * The traction on the body at a point of an implicit boundary, t plus what
   * the trial state adds; @p grad_du is the gradient of its increment there,
   * and @p mean_grad_du that by which the volume changes, the mean over the
   * cell where strains have one (CellMeans): the flux is that of the stress
   * that points have. See Enforcement for the weak form.
   *
   * At finite strain the strain of the flux is that of the gradient with
   * respect to the middle of the step, @f$A (1 + A/2)^{-1}@f$ for
   * @f$A = W \nabla \Delta u@f$: a rotation has none, and a stretch differs
   * from its logarithm in the third order only (Hughes and Winget 1980). It
   * sees the elastic stiffness; what that leaves out goes into the multiplier
   * by the penalty. The flux of the test function stays that of the start, so
   * that the derivative is exact.
   */
  template <int dim>
  dealii::Tensor<1, dim>
  boundary_traction(const BoundaryPoint<dim>     &point,
                    const ConstraintState<dim>   &constraint,
                    const Enforcement            &enforcement,
                    const LameConstants          &stiffness,
                    const StrainMeasure           measure,
                    const dealii::Tensor<2, dim> &grad_du,
                    const dealii::Tensor<2, dim> &mean_grad_du);

  /** The same of a point of @p piece. */
  template <int dim>
  dealii::Tensor<1, dim>
  boundary_traction(const BoundaryPiece<dim> &piece,
                    const unsigned int        q,
                    const Enforcement        &enforcement,
                    const LameConstants      &stiffness,
                    const StrainMeasure       measure);

  /** Adds the force of point @p q, whose functions @p piece has, and, if asked,
   * its derivative. @p of_start times the force at the start of the step comes
   * to it, where it pushes now. @p fluxes is scratch. */
  template <int dim>
  void
  add_boundary_point(const BoundaryPiece<dim>            &piece,
                     const unsigned int                   q,
                     const double                         of_start,
                     const Enforcement                   &enforcement,
                     const LameConstants                 &stiffness,
                     const StrainMeasure                  measure,
                     const bool                           tangent,
                     std::vector<dealii::Tensor<1, dim>> &fluxes,
                     LocalSystem<dim>                    &local);

  /** @f$c_3\, M Q M@f$ with @f$Q = n\cdot C\cdot n@f$, of which @p enforcement
   * may leave out @f$\lambda@f$, and c_3 by @p depth. */
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  penalty(const Enforcement                     &enforcement,
          const double                           depth,
          const dealii::Tensor<1, dim>          &n,
          const dealii::SymmetricTensor<2, dim> &M,
          const LameConstants                   &stiffness);

  /** Adds what the mean violation of a piece of a boundary adds to the
   * derivative; its force is in boundary_traction(). */
  template <int dim>
  void
  add_mean_penalty(const BoundaryPiece<dim> &piece,
                   const Enforcement        &enforcement,
                   const LameConstants      &stiffness,
                   LocalSystem<dim>         &local);
} // namespace moraine

#endif
