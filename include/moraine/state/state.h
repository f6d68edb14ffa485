// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_state_h
#define moraine_state_state_h

#include <moraine/basis/basis.h>
#include <moraine/core/linear_algebra.h>
#include <moraine/material/material.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

#include <memory>
#include <vector>

namespace moraine
{
  /** What the mesh and the points do when a step is accepted. */
  enum class MeshAfterStep
  {
    /** The points move, the mesh stays: the material point method. */
    reset,
    /** The nodes move with the points, which stay in their cells. */
    follow_material,
    /** Nothing moves: small displacement. */
    keep
  };

  /** Engineering view of @f$\mathrm{sym} \sum_a \Delta u_a \otimes \nabla
   * N_a@f$. */
  template <int dim>
  inline dealii::SymmetricTensor<2, 3>
  strain_increment(const dealii::Tensor<1, dim> *nodal_increments,
                   const dealii::Tensor<1, dim> *grad_N,
                   const unsigned int            n_nodes)
  {
    dealii::Tensor<2, dim> gradient;
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          gradient[i][j] += nodal_increments[a][i] * grad_N[a][j];
    dealii::SymmetricTensor<2, 3> strain;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        strain[i][j] = 0.5 * (gradient[i][j] + gradient[j][i]);
    return strain;
  }

  /** The stress stored at a point: xx, yy, zz, xy[, xz, yz]. */
  template <int dim>
  inline dealii::SymmetricTensor<2, 3>
  load_stress(const double *components)
  {
    dealii::SymmetricTensor<2, 3> stress;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      stress.access_raw_entry(c) = components[c];
    return stress;
  }

  template <int dim>
  class State;

  /** Trial stresses of points of one body that share their nodes. */
  template <int dim>
  class TrialStresses
  {
  public:
    /**
     * The stresses of the points [begin, end) of a block, valid until the next
     * call.
     */
    const std::vector<dealii::SymmetricTensor<2, 3>> &
    evaluate(const State<dim>             &state,
             const StencilBlock<dim>      &block,
             const unsigned int            begin,
             const unsigned int            end,
             const dealii::Tensor<1, dim> *nodal_increments);

  private:
    std::vector<dealii::SymmetricTensor<2, 3>> strains;
    std::vector<dealii::SymmetricTensor<2, 3>> stresses;
  };

  /**
   * The state of a step. Committed values live at the points; the trial state
   * is the nodal increment @f$\Delta u@f$ alone, because trial stresses and
   * positions are functions of it and of the committed values. accept() is the
   * only function that writes committed values; reject() forgets the trial.
   */
  template <int dim>
  class State
  {
  public:
    /** @p materials holds the material of each body. */
    State(GridSpace<dim>                              &space,
          PointSet<dim>                               &points,
          Basis<dim>                                  &basis,
          std::vector<std::shared_ptr<const Material>> materials,
          const MeshAfterStep                          mesh_after_step);

    /**
     * Bring cells, unknowns and groups up to date with the points.
     * @return whether the coupling of unknowns changed. Collective.
     */
    bool
    begin_step();

    /** Set the trial increment. Collective. */
    void
    set_trial(const LA::Vector &increment);

    /** Trial increments @f$\Delta u_a@f$ of the nodes. */
    const std::vector<dealii::Tensor<1, dim>> &
    nodal_increments() const
    {
      return trial;
    }

    /**
     * Commit the trial state: @f$\sigma_n@f$, displacement and, by
     * MeshAfterStep, positions @f$x_n = x_{n-1} + \sum_a N_a \Delta u_a@f$
     * (Cortis et al. 2017, eqs. 10 and 11).
     *
     * @throws ComputationError if a point leaves the mesh. Collective.
     */
    void
    accept();

    /** Forget the trial state. */
    void
    reject();

    /**
     * The displacement increment of every local point in the trial state, in
     * the flat numbering.
     */
    std::vector<dealii::Tensor<1, dim>>
    point_increments() const;

    /**
     * The end of the run of points of one body that starts at @p begin of a
     * block. Nearly always that is all of them.
     */
    unsigned int
    end_of_body(const StencilBlock<dim> &block, const unsigned int begin) const;

    const GridSpace<dim> &
    grid() const
    {
      return space;
    }

    const PointSet<dim> &
    material_points() const
    {
      return points;
    }

    const Basis<dim> &
    point_basis() const
    {
      return basis;
    }

    const Material &
    material(const unsigned int body) const
    {
      return *materials[body];
    }

    MeshAfterStep
    mesh_after_step() const
    {
      return after_step;
    }

  private:
    GridSpace<dim>                                    &space;
    PointSet<dim>                                     &points;
    Basis<dim>                                        &basis;
    const std::vector<std::shared_ptr<const Material>> materials;
    const MeshAfterStep                                after_step;
    bool                                               first_step = true;
    std::vector<dealii::Tensor<1, dim>>                trial;
  };
} // namespace moraine

#endif
