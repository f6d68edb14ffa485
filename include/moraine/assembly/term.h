// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_term_h
#define moraine_assembly_term_h

#include <moraine/boundary/implicit_boundary.h>
#include <moraine/state/state.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Matrix and force of the unknowns of one group of points or one cell, in
   * node major order, with the scratch arrays the terms share.
   */
  template <int dim>
  struct LocalSystem
  {
    dealii::FullMatrix<double>                   matrix;
    dealii::Vector<double>                       force;
    std::vector<dealii::types::global_dof_index> dofs;
    const unsigned int                          *nodes = nullptr;
    std::vector<dealii::Tensor<1, dim>>          nodal_increments;
    /** Moments of gradients. */
    std::vector<double> moments;
    TrialPoints<dim>    trial_points;
    /** Why a point has no stress, if one has none since reset. */
    std::string fault;
    /** Boundary fluxes of unit displacements of the unknowns. */
    std::vector<dealii::Tensor<1, dim>> fluxes;

    /** Take the unknowns and increments of @p n_nodes nodes and zero the rest.
     */
    void
    reinit(const State<dim>   &state,
           const unsigned int *nodes,
           const unsigned int  n_nodes,
           const bool          tangent);
  };

  /** A term of the weak form that is integrated by the material points. */
  template <int dim>
  class PointTerm
  {
  public:
    virtual ~PointTerm() = default;

    /**
     * Add the forces of the points of a block (positive where they push the
     * nodes along) and, if asked, minus their derivative to the matrix.
     */
    virtual void
    add(const State<dim>        &state,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const = 0;
  };

  /**
   * @f$-\sum_p B_p^T \sigma_p v_p@f$ with trial stresses, and
   * @f$K = \sum_p B_p^T C B_p v_p@f$ (Cortis et al. 2017, eqs. 7-9).
   *
   * With a constant isotropic C the sum over points needs only the moments
   * @f$G_{ai,bj} = \sum_p v_p\, \partial_i N_a\, \partial_j N_b@f$; then
   * @f$K_{ai,bj} = \lambda G_{ai,bj} + \mu G_{aj,bi}
   *  + \mu\, \delta_{ij} \sum_k G_{ak,bk}@f$, so that many points in a cell
   * cost little more than few.
   *
   * Otherwise, with TrialPoints' weights w and gradients g and the spatial
   * tangent c,
   * @f$f_{ai} = -\sum_p w\, \tau_{ij} g_{aj}@f$ and
   * @f$K_{ai,bj} = \sum_p w\, (g_{ak} c_{ikjl}\, g_{bl}
   *  + \delta_{ij}\, g_a \cdot \tau g_b)@f$, the second term at finite strain
   * only. It is the exact derivative, and symmetric.
   */
  template <int dim>
  class InternalForce : public PointTerm<dim>
  {
  public:
    void
    add(const State<dim>        &state,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const override;
  };

  /**
   * The traction on the body at a point of an implicit boundary, t plus what
   * the trial state adds; @p grad_du is the gradient of its increment there.
   * See Enforcement for the weak form.
   *
   * At finite strain the strain of the flux is that of the gradient with
   * respect to the middle of the step, @f$A (1 + A/2)^{-1}@f$ for
   * @f$A = W \nabla \Delta u@f$: a rotation has none, and a stretch differs
   * from its logarithm in the third order only (Hughes and Winget 1980). It
   * sees the elastic stiffness; what that leaves out goes into the reaction by
   * the penalty. The flux of the test function stays that of the start, so that
   * the derivative is exact.
   */
  template <int dim>
  dealii::Tensor<1, dim>
  boundary_traction(const BoundaryPoint<dim>     &point,
                    const ConstraintState<dim>   &constraint,
                    const Enforcement            &enforcement,
                    const LameConstants          &stiffness,
                    const StrainMeasure           measure,
                    const dealii::Tensor<2, dim> &grad_du);

  /** Adds the force of such a point and, if asked, its derivative. */
  template <int dim>
  void
  add_boundary_point(const BoundaryPoint<dim>     &point,
                     const ConstraintState<dim>   &constraint,
                     const Enforcement            &enforcement,
                     const LameConstants          &stiffness,
                     const StrainMeasure           measure,
                     const double                 *N,
                     const dealii::Tensor<1, dim> *grad_N,
                     const dealii::Tensor<2, dim> &grad_du,
                     const bool                    tangent,
                     LocalSystem<dim>             &local);
} // namespace moraine

#endif
