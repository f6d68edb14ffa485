// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_state_h
#define moraine_state_state_h

#include <moraine/basis/basis.h>
#include <moraine/core/linear_algebra.h>
#include <moraine/material/material.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>
#include <moraine/state/aggregates.h>
#include <moraine/state/cell_means.h>
#include <moraine/state/fitted_weights.h>
#include <moraine/state/trial_points.h>

#include <functional>
#include <memory>
#include <optional>
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

  /** Over what the stress of points is integrated. */
  enum class PointWeights
  {
    /** Their volumes. */
    volumes,
    /** In filled cells times the factors of FittedWeights. */
    fitted_to_cells
  };

  /** Of the strain of points, what changes the volume. */
  enum class VolumetricStrain
  {
    /** Each point's own. */
    pointwise,
    /** The mean over the cell, CellMeans: B-bar, at finite strain F-bar. */
    cell_mean,
    /** The same, and most of all other strain is the cell's mean too. */
    cell_mean_with_shear
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
    /**
     * @p materials holds the material of each body. The fields of StateFields
     * are in the layout of @p points and get the values of a body at rest.
     */
    State(GridSpace<dim>                              &space,
          PointSet<dim>                               &points,
          Basis<dim>                                  &basis,
          std::vector<std::shared_ptr<const Material>> materials,
          const MeshAfterStep                          mesh_after_step,
          const StrainMeasure    measure    = StrainMeasure::small,
          const PointWeights     weights    = PointWeights::volumes,
          const VolumetricStrain volumetric = VolumetricStrain::pointwise);

    /** Whether points have the mean change of volume of their cells. */
    bool
    averages_volume() const
    {
      return cell_means.has_value();
    }

    /** Whether they have most of all other strain of their cells, too: not
     * where cells share a mean. */
    bool
    averages_all_strain() const
    {
      return cell_means && cell_means->averages_shear();
    }

    /** Before the first step: tie nodes without a cell of which points fill
     * enough, @p fill_of_bodies as Aggregates says, to the nearest one. Ties
     * that @p give_way are those of a GhostTerm, others lines of constraints.
     */
    void
    aggregate_below(const std::vector<double> &fill_of_bodies,
                    const bool                 give_way = false)
    {
      cell_aggregates.emplace(fill_of_bodies, cell_means.has_value());
      ties_give_way = give_way;
    }

    /**
     * Bring cells, unknowns and batches up to date with the points.
     * @param holds_mean_in see Aggregates::tie_nodes()
     * @return whether the coupling of unknowns changed. Collective.
     */
    bool
    begin_step(const typename Aggregates<dim>::AskOfCell &holds_mean_in = {});

    /**
     * Before the first step: give point @p p the @p stress and the elastic
     * strain that has it, at displacements of zero. Internal variables are
     * those of a body at rest.
     * @return the stress that the material has at this strain: another one if
     * it would yield before.
     */
    dealii::SymmetricTensor<2, 3>
    set_initial_stress(const unsigned int                   p,
                       const dealii::SymmetricTensor<2, 3> &stress);

    /** Points have come or gone: the next begin_step() finds cells and batches
     * anew. */
    void
    points_changed()
    {
      first_step = true;
    }

    /**
     * Where nodes move with the material, put the points of the bodies flagged
     * in @p new_bodies where their nodes have moved by now; they fill the
     * cells as these are, undeformed.
     */
    void
    place_by_nodes(const std::vector<bool> &new_bodies);

    /** From when to when the step goes, for materials that depend on it. */
    void
    set_step_time(const StepTime &time)
    {
      times = time;
    }

    const StepTime &
    step_time() const
    {
      return times;
    }

    /** Set the trial increment. Collective. */
    void
    set_trial(const LA::Vector &increment)
    {
      space.node_values(increment, trial);
    }

    /** Trial increments @f$\Delta u_a@f$ of the nodes. */
    const std::vector<dealii::Tensor<1, dim>> &
    nodal_increments() const
    {
      return trial;
    }

    /**
     * Commit the trial state: stress, displacement and, by MeshAfterStep,
     * positions @f$x_n = x_{n-1} + \sum_a N_a \Delta u_a@f$ (Cortis et al.
     * 2017, eqs. 10 and 11); at finite strain @f$F = \Delta F F_n@f$,
     * @f$b^e@f$ and @f$v = \det(\Delta F)\, v_n@f$ too, and the stress is
     * Cauchy's @f$\sigma = \tau/J@f$. Where points move through the mesh,
     * @p move_mesh, if there is one, moves its vertices before the cells of the
     * points are searched. @p energies, if asked for, gets the sums of this
     * rank's points, weighted as their stress.
     *
     * @throws ComputationError if a point leaves the mesh. Collective.
     */
    void
    accept(const std::function<void()> &move_mesh = {},
           StepEnergies                *energies  = nullptr);

    /** Forget the trial state. */
    void
    reject()
    {
      trial.assign(space.n_nodes(), dealii::Tensor<1, dim>());
    }

    /** The displacement increment of every local point in the trial state, in
     * the flat numbering. */
    std::vector<dealii::Tensor<1, dim>>
    point_increments() const;

    /** Fill @p block with batch @p batch, and with the means of its cells if
     * strains have them. */
    void
    evaluate(const unsigned int batch, StencilBlock<dim> &block) const;

    /** The nodes of a batch, as evaluate() gives them. */
    dealii::ArrayView<const unsigned int>
    nodes_of_batch(const unsigned int batch) const
    {
      const auto own = basis.batch_nodes(batch);
      return cell_means ? cell_means->nodes_of_batch(batch, own) : own;
    }

    /** The mean by which the volume of a cell changes; no parts if that is a
     * matter of each point. */
    void
    mean_of_cell(const unsigned int                          active_cell_index,
                 std::vector<typename CellMeans<dim>::Part> &parts) const
    {
      parts.clear();
      if (cell_means)
        cell_means->of_cell(active_cell_index, parts);
    }

    /**
     * The part a of the change of volume of a point with elastic stiffness C
     * that is the means' of its cells: 1, but for points with domains at finite
     * strain. There a mesh that begins each step anew forgets how it moved,
     * while stress turned with the points, and where only shape resists what
     * points of a cell do against each other grows from step to step in a
     * stretched body. So points keep of their own what has the modulus
     * @f$K_o@f$,
     * @f[ a = 1 - \min\left(1, \frac{K_o}{K}\right), \qquad
     *     K_o = 6\, q \min\left(1, \frac q\mu\right) \sqrt{\frac K\mu},
     *     \qquad q = |\mathrm{dev}\,\sigma_n|, \quad
     *     K = \lambda + \frac{2\mu}{n} , @f]
     * found by trial, doc/topics/locking.md. Next to nothing where stress is
     * small against @f$\mu@f$, as in soil.
     */
    double
    mean_part(const unsigned int point, const LameConstants &C) const;

    /** The nodes of the cells that have a part in mean_of_cell(), sorted. */
    void
    nodes_of_mean(const unsigned int         active_cell_index,
                  std::vector<unsigned int> &nodes) const;

    /** The end of the run of points of one body that starts at @p begin of a
     * block. Nearly always that is all of them. */
    unsigned int
    end_of_body(const StencilBlock<dim> &block, const unsigned int begin) const;

    /** The ties of nodes in cut cells; a null pointer if they are free. */
    const Aggregates<dim> *
    aggregates() const
    {
      return cell_aggregates ? &*cell_aggregates : nullptr;
    }

    /** The same if tied nodes have exactly what their roots have. */
    const Aggregates<dim> *
    strict_aggregates() const
    {
      return ties_give_way ? nullptr : aggregates();
    }

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

    StrainMeasure
    strain_measure() const
    {
      return measure;
    }

    const StateFields<dim> &
    fields() const
    {
      return state_fields;
    }

    /** @f$J_n = \det F_n@f$ of a point; 1 at small strain. */
    double
    volume_ratio(const unsigned int p) const;

    /** The volume by which the density gives the mass of a point. */
    double
    initial_volume(const unsigned int p) const
    {
      return measure == StrainMeasure::finite ?
               state_fields.v_0(points.values(p)) :
               points.volume(p);
    }

    double
    mass(const unsigned int p) const
    {
      return densities[points.body(p)] * initial_volume(p);
    }

    /**
     * The part of the stress of a point that strains recovered by other
     * functions than its own (Basis::strain_basis()) have added in steps with
     * inertia: stress less what its own functions would have made of them. Zero
     * without such functions and at finite strain.
     */
    dealii::SymmetricTensor<2, 3>
    stress_of_recovery(const unsigned int p) const
    {
      return recovery_field.exists() ? recovery_field(points.values(p)) :
                                       dealii::SymmetricTensor<2, 3>();
    }

    /** Where a point was when its displacement was zero. */
    dealii::Point<dim>
    original_position(const unsigned int p) const
    {
      const dealii::Point<dim> &x = points.position(p);
      return after_step == MeshAfterStep::keep ?
               x :
               x - points.displacement_field()(points.values(p));
    }

    /** The volume over which the stress of a point is integrated: its own, or
     * what weights fitted to the cell make of it. */
    double
    integration_volume(const unsigned int p) const
    {
      return factors.empty() ? points.volume(p) : factors[p] * points.volume(p);
    }

    /** The volume of the i-th point of a block in the mesh as it is: with it a
     * point counts in the mean over its cell, and a uniform pressure has no
     * force inside of a body. */
    double
    volume_in_cell(const StencilBlock<dim> &block, const unsigned int i) const;

    /** Whether the tangent is that of the elastic stiffness everywhere. */
    bool
    is_linear() const;

    /** Whether the tangents of all materials are symmetric. */
    bool
    has_symmetric_tangents() const
    {
      return symmetric_tangents;
    }

    /** Whether a material dissipates energy: whether it yields. */
    bool
    dissipates() const;

  private:
    /** Tie the nodes of cut cells; @p active are the cells of this rank. */
    bool
    tie_nodes(std::vector<unsigned char>                 active,
              const typename Aggregates<dim>::AskOfCell &holds_mean_in);

    /** Write what the i-th trial point, @p p, carries at the end of the step.
     */
    void
    commit(const TrialPoints<dim> &trial_points,
           const unsigned int      i,
           const unsigned int      p);

    /** Of a point whose own functions would make it stress times volume @p own;
     * without that, none. Before commit(). */
    void
    commit_recovery(const TrialPoints<dim>              &trial_points,
                    const unsigned int                   i,
                    const unsigned int                   p,
                    const dealii::SymmetricTensor<2, 3> *own);

    /** What accept() works on. */
    struct Acceptance;

    /** A block of @p of and the increments of its nodes. */
    void
    gather(const Basis<dim>  &of,
           const unsigned int batch,
           Acceptance        &work) const;

    /** Stress times volume by the functions of the block. */
    void
    find_own_stresses(Acceptance &work) const;

    /** commit() the points of the block. */
    void
    commit_block(Acceptance &work, StepEnergies *energies);

    /** Increments of the points of the block, added to their displacement. */
    void
    displace(Acceptance &work);

    GridSpace<dim>                                    &space;
    PointSet<dim>                                     &points;
    Basis<dim>                                        &basis;
    const std::vector<std::shared_ptr<const Material>> materials;
    const MeshAfterStep                                after_step;
    const StrainMeasure                                measure;
    const bool                                         keeps_parts; ///< a < 1
    const bool                                         symmetric_tangents;
    std::vector<double>                                densities; ///< of bodies
    const std::optional<FittedWeights<dim>>            fitted_weights;
    std::optional<CellMeans<dim>>                      cell_means;
    std::optional<Aggregates<dim>>                     cell_aggregates;
    const StateFields<dim>                             state_fields;
    const PointField<dim, dealii::SymmetricTensor<2, 3>> recovery_field;
    StepTime                                             times;
    bool                                                 first_step    = true;
    bool                                                 ties_give_way = false;
    /** Of fitted_weights; empty without them. */
    std::vector<double>                 factors;
    std::vector<dealii::Tensor<1, dim>> trial;
  };


  /** The elastic stiffness of point @p p. */
  template <int dim>
  inline LameConstants
  elastic_stiffness(const State<dim> &state, const unsigned int p)
  {
    const PointSet<dim> &points   = state.material_points();
    const unsigned int   body     = points.body(p);
    const Material      &material = state.material(body);
    if (material.has_uniform_stiffness())
      return material.elastic_stiffness();
    const auto internal = state.fields().internal_of(body, points.values(p));
    return material.elastic_stiffness_at(internal.data());
  }
} // namespace moraine

#endif
