// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_mechanics_system_h
#define moraine_assembly_mechanics_system_h

#include <moraine/assembly/term.h>
#include <moraine/boundary/grid_condition.h>
#include <moraine/boundary/implicit_boundary.h>
#include <moraine/boundary/mesh_motion.h>
#include <moraine/load/load.h>
#include <moraine/solver/nonlinear_system.h>
#include <moraine/state/state.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /** Reaction force and worst violation of a boundary in an accepted step. */
  template <int dim>
  struct BoundaryReport
  {
    std::string            name;
    dealii::Tensor<1, dim> reaction;    ///< force on the body
    double                 violation;   ///< largest |M(u - g)| of the step
    double                 penetration; ///< largest depth of a point behind it
    /** Moment on the body about the axis its motion turns about, else about the
     * origin; in 3D the component along the axis. */
    double moment;
    /** @f$\int |t|\,d\Gamma@f$ or @f$\sum_a |f_a|@f$, without cancellation.
     */
    double force_magnitude;
  };

  /** Add up what the ranks know of the forces of a boundary. */
  template <int dim>
  void
  sum_over_ranks(BoundaryReport<dim> &report, const MPI_Comm &communicator)
  {
    namespace MPI          = dealii::Utilities::MPI;
    report.reaction        = MPI::sum(report.reaction, communicator);
    report.moment          = MPI::sum(report.moment, communicator);
    report.force_magnitude = MPI::sum(report.force_magnitude, communicator);
  }

  /**
   * Quasi-static equilibrium of one step, in the increment @f$\Delta u@f$:
   *
   * @f[ r(\Delta u) = f_{ext}(t_{n+1}) - \sum_p B_p^T \sigma_p(\Delta u) v_p
   *     + \text{boundaries} @f]
   *
   * (Cortis et al. 2017, eqs. 6-12). It is a sum of terms that see stencils and
   * know no method. Unknowns on grid conditions are condensed.
   */
  template <int dim>
  class MechanicsSystem : public NonlinearSystem
  {
  public:
    /**
     * The equations of @p state. @p empty_stiffness is the stiffness of the
     * empty part of active cells over that of the material in them. It resists
     * the increment of each step and then is forgotten (a finite cell method,
     * Parvizian et al. 2007), so that nodes touched by too few points are held.
     * 0: none. @p timer, if there is one, gets the times of the parts.
     */
    MechanicsSystem(State<dim>                            &state,
                    std::vector<ImplicitBoundary<dim>>    &boundaries,
                    const std::vector<GridCondition<dim>> &conditions,
                    Loads<dim>                            &loads,
                    const std::vector<std::string>        &body_names,
                    const double                           empty_stiffness = 0.,
                    dealii::TimerOutput                   *timer = nullptr);

    /** Let @p mesh, which the points move through, move after each step. */
    void
    move_mesh_by(const MeshMotion<dim> &motion, BackgroundMesh<dim> &mesh);

    /**
     * Start a step at @p t: bring cells, unknowns, sparsity pattern and pieces
     * of boundaries up to date. @p before_new_tangent is called before memory
     * is taken for a new pattern: whoever holds the old tangent may let it go.
     */
    void
    begin_step(const double                 t,
               const std::function<void()> &before_new_tangent = {});

    /** Aim at @p t_end from the committed state; undoes an earlier trial. */
    void
    set_target(const double t_end);

    /** Commit the trial increment @p x. Reports are collective. */
    std::vector<BoundaryReport<dim>>
    accept(const LA::Vector &x);

    /**
     * Depth of points behind each boundary if the trial increment @p x were
     * accepted, over the boundary's limit; the largest of all boundaries that
     * have a limit, or 0. At most 1 is fine.
     */
    double
    worst_penetration_over_limit(const LA::Vector &x);

    /**
     * Throws if a connected part of the material can move as a rigid body,
     * naming it and the motion. Needs an assembled tangent.
     */
    void
    check_that_it_is_held(const bool first_step) const;

    void
    start_over() override;

    bool
    linearised() const override
    {
      return predicting;
    }

    std::string
    fault() const override;

    /** Why domains of points forbid to accept the trial state of the State, or
     * "". Collective. */
    std::string
    fault_of_domains() const;

    void
    initial_guess(LA::Vector &x) const override;

    void
    assemble(const LA::Vector &x, const bool tangent) override;

    std::shared_ptr<const LA::SparseMatrix>
    tangent() const override
    {
      return matrix;
    }

    const LA::Vector &
    residual() const override
    {
      return residual_vector;
    }

    double
    force_scale() const override
    {
      return scale;
    }

    bool
    symmetric() const override;

    const std::vector<LA::Vector> &
    near_null_space() const override
    {
      return rigid_modes;
    }

    void
    apply_constraints(LA::Vector &dx) const override;

    bool
    augment(const LA::Vector &x) override;

    /**
     * Give what points leave empty this fraction of the material's stiffness
     * from this step on, after begin_step(). Collective.
     * @return whether any part is empty.
     */
    bool
    stiffen_empty_parts(const double fraction);

    /**
     * Norm of the forces of empty parts, as assembled last, over that of all
     * forces, then or at the start of the step. Collective.
     */
    double
    share_of_empty_parts() const;

    /** Whether cells or couplings changed at the last begin_step(). */
    bool
    coupling_changed() const
    {
      return changed;
    }

    /** Number of surface points of each boundary, over all ranks. */
    std::vector<unsigned int>
    n_boundary_points() const;

    /** Number of nodes that each grid condition holds, over all ranks. */
    std::vector<unsigned int>
    n_prescribed_nodes() const;

    /**
     * Ask every grid condition for its value at @p t, at one of its nodes.
     * @throws InputError, perhaps on one rank alone, if that is not a number.
     */
    void
    check_prescribed_values(const double t) const;

  private:
    void
    set_up_unknowns();

    void
    make_rigid_modes();

    void
    make_constraints();

    void
    assemble_external_forces();

    void
    assemble_points(const bool tangent);

    void
    assemble_boundaries(const bool tangent);

    void
    find_empty_parts();

    void
    assemble_empty_parts(const bool tangent);

    /** Add to node_forces and, if asked, to the matrix. */
    void
    add_to_system(const LocalSystem<dim> &local, const bool tangent);

    std::vector<BoundaryReport<dim>>
    report_boundaries();

    std::vector<BoundaryReport<dim>>
    report_grid_conditions(const LA::Vector &x);

    /** Tension and violation of each point of a boundary in the trial state. */
    void
    boundary_state(const ImplicitBoundary<dim>         &boundary,
                   std::vector<dealii::Tensor<1, dim>> &tractions,
                   std::vector<dealii::Tensor<1, dim>> &violations) const;

    [[noreturn]] void
    report_free_part(const std::vector<unsigned int>           &part,
                     const unsigned int                         k,
                     const std::vector<dealii::Vector<double>> &free_motions,
                     const bool first_step) const;

    /**
     * The largest depth of a point of this rank behind a boundary; with
     * @p moves of the points added to their positions unless it is empty.
     */
    double
    deepest_point(const ImplicitBoundary<dim>               &boundary,
                  const std::vector<dealii::Tensor<1, dim>> &moves) const;

    /** Typical size of the largest point. */
    double
    point_size() const;

    State<dim>                            &state;
    std::vector<ImplicitBoundary<dim>>    &boundaries;
    const std::vector<GridCondition<dim>> &conditions;
    Loads<dim>                            &loads;
    const std::vector<std::string>         body_names;
    dealii::TimerOutput                    unused_timer;
    dealii::TimerOutput                   &timer;
    double                                 empty_stiffness;
    /** Cells of this rank that points do not fill, and what is left of them. */
    std::vector<std::pair<typename GridSpace<dim>::CellIterator, double>>
                                                 empty_volume;
    std::vector<std::unique_ptr<PointTerm<dim>>> point_terms;
    std::vector<unsigned int>                    body_of_cell;
    PrescribedNodes<dim>                         prescribed;
    dealii::AffineConstraints<double>            constraints;
    std::shared_ptr<LA::SparseMatrix>            matrix;
    LA::Vector                                   residual_vector;
    LA::Vector                                   external;
    /** The residual with the forces that grid conditions take. */
    LA::Vector unbalanced;
    /** Where residual and unbalanced forces were assembled last, if at all. */
    LA::Vector                          assembled_at;
    bool                                assembled = false;
    std::vector<dealii::Tensor<1, dim>> node_forces;
    /** Prescribed increments, while assemble() linearises about their start. */
    std::vector<dealii::Tensor<1, dim>> predicted;
    /** Whether any rank has prescribed nodes, whose increments matter. */
    bool                    any_prescribed = false;
    bool                    predicting     = false;
    MeshMotion<dim>         mesh_motion;
    BackgroundMesh<dim>    *moving_mesh = nullptr;
    std::string             local_fault;
    std::vector<LA::Vector> rigid_modes;
    double                  scale          = 0;
    double                  scale_at_start = 0;
    double                  external_scale = 0;
    double                  local_scale    = 0;
    double                  empty_scale    = 0;
    double                  t_start        = 0;
    double                  t_target       = 0;
    double                  reach          = 0;
    double                  last_violation = 0;
    bool                    changed        = true;
  };
} // namespace moraine

#endif
