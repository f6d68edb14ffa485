// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_double_mapping_h
#define moraine_assembly_double_mapping_h

#include <moraine/assembly/internal_force.h>
#include <moraine/basis/local_functions.h>

#include <vector>

namespace moraine
{
  /**
   * The internal force of DM, DM-G, DM-C and DM-GC: what points carry from the
   * step before acts where they are, and what a step adds is integrated over
   * the Gauss points of the cells that they touch,
   * @f[ f_a = -\sum_p v_p\, \sigma_{n,p} \nabla S_a(x_p)
   *          - \sum_g \sum_p v_p\, w_{pg}\,
   *            (P_p(\nabla\Delta u(x_g)) - \sigma_{n,p}) \nabla N_a(x_g),
   *    \qquad w_{pg} = \sum_i N_i(x_g)\, S^*_{ip} . @f]
   * @f$P_p(\nabla\Delta u)@f$ is the stress that the point would have with that
   * gradient: Cauchy's at small strain, and at finite strain that per area of
   * the configuration at the start of the step. The first sum is the internal
   * force of Phuong et al. (2023), eq. 5, the derivative of the second one
   * their stiffness,
   * @f$K = \sum_g B(x_g)^T [\sum_i N_i(x_g) \sum_p S^*_{ip} D_p W_p] B(x_g)
   *  |J|@f$ (eq. 7, with B at the Gauss point and W_p in the cell's reference
   * coordinates, so that @f$|J| W_p = v_p@f$). It is the exact derivative of
   * f, and symmetric if D is.
   *
   * The stress that points are given at the end of the step is that of their
   * own strain (Basis::strain_basis()), not that of the Gauss points. The
   * difference is out of balance until the next step balances it.
   *
   * With inertia the difference of both stiffnesses would be a damping of
   * either sign. There all of the force is integrated over points by their own
   * functions, at small strain without State::stress_of_recovery().
   *
   * Points of a material that is linear at small strain cost the sums over
   * @f$w_{pg}@f$ alone; others ask the material once for each Gauss point of
   * each cell that they touch.
   */
  template <int dim>
  class DoubleMapping : public Term<dim>
  {
  public:
    /** For points on a mesh of equal boxes. @p method is named in messages. */
    DoubleMapping(const GridSpace<dim> &space,
                  const PointSet<dim>  &points,
                  const std::string    &method);

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind = WorkKind::internal;
      is.timer     = "stencils";
      return is;
    }

    /** Find the points that touch each cell, and what they carry that is not in
     * balance. @throws InputError if the mesh was moved. */
    bool
    begin_step(const StepContext<dim> &context) override;

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

    bool
    symmetric(const StepContext<dim> &context) const override
    {
      return context.state.has_symmetric_tangents();
    }

    /** Why a point has no stress with the strain that it is going to have. */
    std::string
    failure(const StepContext<dim>                    &context,
            const std::vector<dealii::Tensor<1, dim>> &moves) const override;

  private:
    static constexpr unsigned int n_gauss = 1 << dim;

    /** A cell and the points that touch it. */
    struct Cell
    {
      std::array<unsigned int, dim> place;
      unsigned int                  index; ///< active_cell_index()
      unsigned int                  first; ///< in points_of_cells
      unsigned int                  last;
    };

    /** The points of a cell at its Gauss points, one after the other, as
     * points of a stencil. */
    struct GaussBlock
    {
      StencilBlock<dim>         stencil;
      std::vector<unsigned int> points;
      std::vector<double>       shares;
    };

    void
    find_cells();

    /** Carry the force of stress(p) at points. */
    template <class Stress>
    void
    carry(const State<dim> &state, const Stress &stress);

    void
    find_carried_forces(const State<dim> &state);

    /** With inertia. */
    void
    find_recovered_forces(const State<dim> &state);

    void
    evaluate(const Cell &cell, GaussBlock &block) const;

    const GridSpace<dim>     &space;
    const PointSet<dim>      &points;
    const std::string         method;
    const CellNeighbours<dim> neighbours;
    const LocalFunctions<dim> local_functions;
    const InternalForce<dim>  internal_force;
    std::vector<Cell>         cells;
    std::vector<unsigned int> points_of_cells;
    /** Of a cell's functions at its Gauss points. */
    std::array<std::array<dealii::Tensor<1, dim>, n_gauss>, n_gauss> gradients;
    /** Of nodes: what @f$\sigma_n@f$ does at points and not at Gauss points.
     */
    std::vector<dealii::Tensor<1, dim>> carried_forces;
  };
} // namespace moraine

#endif
