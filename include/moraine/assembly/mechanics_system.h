// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_mechanics_system_h
#define moraine_assembly_mechanics_system_h

#include <moraine/assembly/bodies_of_nodes.h>
#include <moraine/assembly/constraint_table.h>
#include <moraine/assembly/make_terms.h>
#include <moraine/boundary/mesh_motion.h>
#include <moraine/solver/path_following.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Quasi-static equilibrium of one step, in the increment @f$\Delta u@f$:
   *
   * @f[ r(\Delta u) = f_{ext}(t_{n+1}) - \sum_p B_p^T \sigma_p(\Delta u) v_p
   *     + \text{boundaries} @f]
   *
   * (Cortis et al. 2017, eqs. 6-12). It is a sum of terms, of which it knows
   * none by name, under the constraints they ask for. Constrained unknowns are
   * condensed.
   */
  template <int dim>
  class MechanicsSystem : public PathSystem
  {
  public:
    /**
     * The equations of @p state. @p timer, if there is one, gets the times of
     * the parts.
     */
    MechanicsSystem(State<dim>                     &state,
                    Terms<dim>                      terms,
                    const std::vector<std::string> &body_names,
                    dealii::TimerOutput            *timer = nullptr);

    /** Let @p mesh, which the points move through, move after each step. */
    void
    move_mesh_by(const MeshMotion<dim> &motion, BackgroundMesh<dim> &mesh);

    /** Let material have velocities and accelerations, @p motion; none if it
     * is null. */
    void
    set_motion(Motion<dim> *motion)
    {
      context.motion = motion;
      sums.count_work(motion != nullptr);
    }

    /** From the next begin_step() on, other terms. */
    void
    set_terms(Terms<dim> terms);

    /** Let the next begin_step() find all couplings, as the first does. */
    void
    forget_couplings()
    {
      sums.clear();
    }

    /** The forces by which the constraint @p name holds the nodes, moved by
     * @p x from the committed state, in a step that has begun and aims at its
     * own start. Collective. */
    LA::Vector
    constraint_forces(const std::string &name, const LA::Vector &x);

    /** Let the absorbing surface @p name hold @p forces of nodes; see
     * AbsorbingTerm::hold(). @return what it cannot hold, as a fraction.
     * Collective. */
    double
    hold(const std::string &name, const LA::Vector &forces);

    struct Imbalance
    {
      LA::Vector forces; ///< without those that strong conditions take
      /** Over the largest of those of stresses, of loads and of boundaries:
       * norms of all nodal forces. */
      double share;
    };

    /** The forces that nothing balances at the start of the step that has
     * begun. Collective. */
    Imbalance
    imbalance_at_start();

    double
    unbalanced_share()
    {
      return imbalance_at_start().share;
    }

    /**
     * The forces at the start of the step that has begun, with the velocities
     * that conditions prescribe in it, and the mass alone as tangent(), for
     * the accelerations at the start:
     * @f[ M \delta a = f(t_n, u_n, v_n) - M a_n . @f]
     * The step must have a target, which has given held nodes their
     * @f$v_n@f$ and @f$a_n@f$; it needs a new one after that.
     * @return the right-hand side, condensed. Collective.
     */
    LA::Vector
    forces_and_mass();

    /** Add a term within a step that has begun; Term::begin_step() was called
     * and had nothing new. */
    void
    add(std::unique_ptr<Term<dim>> term);

    /** Call @p function with each term of a class. */
    template <typename TermType, typename Function>
    void
    each(const Function &function) const
    {
      for (const auto &term : terms)
        if (auto *const one = dynamic_cast<TermType *>(term.get()))
          function(*one);
    }

    /** What terms are told of the step. */
    const StepContext<dim> &
    step_context() const
    {
      return context;
    }

    /** What is simulated and what it touches, in the order of the terms.
     * Collective. */
    std::vector<Effect>
    effects() const;

    /**
     * Start a step at @p t: bring cells, unknowns, sparsity pattern and terms
     * up to date. @p before_new_tangent is called before memory is taken for a
     * new pattern: whoever holds the old tangent may let it go.
     */
    void
    begin_step(const double                 t,
               const std::function<void()> &before_new_tangent = {});

    /**
     * Ask every term for its values at @p t.
     * @throws InputError, perhaps on one rank alone, if one is not a number.
     */
    void
    check_values(const double t);

    /** Aim at @p t_end from the committed state; undoes an earlier trial. */
    void
    set_target(const double t_end);

    /** Why the trial increment @p x, a solution, cannot be accepted; "" if it
     * can. Collective. */
    std::string
    reason_to_reject(const LA::Vector &x);

    /**
     * Commit the trial increment @p x: what can fail comes first, then points,
     * then what terms carry. Reports are collective.
     */
    std::vector<BoundaryReport<dim>>
    accept(const LA::Vector &x);

    /**
     * Throws if a connected part of the material can move as a rigid body,
     * naming it and the motion. Needs an assembled tangent.
     */
    void
    check_that_it_is_held(const bool first_step) const;

    /** The same of a tangent whose couplings are new, for the solver. */
    std::string
    why_not_held() const override;

    using Which = std::function<bool(const Term<dim> &)>;

    /** What some terms are of all, as assembled last. */
    struct Share
    {
      /** Norm of their forces over that of all, then or at the start of the
       * step. */
      double of_forces = 0;
      /** Their work over the largest of other terms that are not dead, or the
       * kinetic energy, if a term stabilises or in dynamics. */
      double of_work = 0;
    };

    /** Of the terms that are asked for. Collective. */
    Share
    share(const Which &which) const;

    /** Whether cells or couplings changed at the last begin_step(). */
    bool
    coupling_changed() const
    {
      return context.couplings_changed;
    }

    void
    start_over() override;

    bool
    acts_otherwise() const override;

    bool
    linearised() const override
    {
      return predicting;
    }

    std::string
    failure() const override;

    std::string
    place_of(const dealii::types::global_dof_index unknown) const override;

    void
    initial_guess(LA::Vector &x) const override;

    void
    assemble(const LA::Vector &x, const bool tangent) override;

    std::shared_ptr<const LA::SparseMatrix>
    tangent() const override
    {
      return sums.matrix();
    }

    const LA::Vector &
    residual() const override
    {
      return residual_vector;
    }

    std::vector<double>
    force_scales() const override
    {
      return scale.of_bodies;
    }

    const std::vector<unsigned int> &
    part_of_unknown() const override
    {
      return bodies.of_unknown;
    }

    double
    displacement_scale() const override;

    bool
    symmetric() const override;

    const std::vector<LA::Vector> &
    near_null_space() const override
    {
      return rigid_modes;
    }

    void
    apply_constraints(LA::Vector &dx) const override;

    /** Give forces of tied unknowns to those they are tied to, and take away
     * those of constrained ones. Collective. */
    void
    condense(LA::Vector &force) const
    {
      constraints.condense(force);
    }

    bool
    augment(const LA::Vector &x, const double tolerance) override;

    /** The time at which the step ends. */
    void
    set_parameter(const double t) override;

    /**
     * The share of each unknown's node in the volume,
     * @f$m_a = \sum_p N_a v_p / \sum_p v_p@f$: the norm is the root mean
     * square of the displacement.
     */
    LA::Vector
    path_weights() const override;

  private:
    /** Find the forces of all terms but inertia in the committed state, by
     * kind. */
    void
    find_forces_at_start();

    /** Find the share of them that the time integrator asks for, without those
     * of terms that act over the step. */
    void
    weigh_forces_at_start();

    /** Let @p works have the work of such terms. */
    void
    count_work_over_step(typename Motion<dim>::StepWorks &works) const;

    /** Those of point terms, in one pass over the stencils. */
    void
    add_point_forces_by_kind();

    /** Velocities and accelerations of what is constrained. */
    void
    set_target_of_motion();

    /** Find those of loads where the integrator asks for them. */
    void
    find_dead_forces();

    /** Let every term begin a step and learn whether couplings are new. */
    void
    begin_terms();

    void
    set_up_unknowns();

    /** The lines of all terms. */
    ConstraintTable::AddLines
    lines_of_terms() const;


    /** Add the terms that are asked for. */
    void
    add_terms(const Which &which, const bool tangent);

    /** One pass over the stencils for the terms that need it. */
    void
    add_point_terms(const Which &which, const bool tangent);

    /** Of the i-th term in the trial state. */
    void
    count_work(const unsigned int i, const double work);

    /** Norms of forces without cancellation. */
    struct ForceScale
    {
      std::vector<double> of_bodies;
      double              now      = 0; ///< of all bodies
      double              at_start = 0; ///< of the step
      std::vector<double> dead_squares; ///< of bodies, of all ranks
      /** Of terms that stabilise and of this rank. */
      std::vector<double> stabilising_squares;
    };

    using NodeValues = std::vector<dealii::Tensor<1, dim>>;

    /** Of a step, beside those of the trial state. */
    struct StepForces
    {
      LA::Vector dead; ///< of loads at the end of the step
      /** The share that the time integrator gives those at its start. */
      LA::Vector at_start;
      /** In dynamics, of this rank: those at the start by WorkKind, and the
       * work of those of the trial state that are not dead. */
      std::array<NodeValues, Works::n_kinds> by_kind;
      std::array<double, Works::n_kinds>     works{};
      /** The same by term, if any stabilises too. */
      std::vector<double> works_of_terms;
      /** Those at the start of terms that act over the step, of this rank. */
      NodeValues over_step;
    };

    /** The sum of those at the start. Collective. */
    LA::Vector
    sum_of_kinds() const;

    bool
    forces_in_the_middle() const
    {
      return context.motion &&
             context.motion->integrator().forces_in_the_middle();
    }

    /** The work of the step to the trial state @p x, at which forces were
     * assembled last. */
    typename Motion<dim>::StepWorks
    works_of_step(const LA::Vector &x);

    /** The work of the forces at the end of the step in the prescribed motion
     * of nodes, on this rank. */
    double
    work_on_prescribed();

    /** Assemble the forces at @p x unless that is where they were assembled
     * last. */
    void
    assemble_forces_at(const LA::Vector &x);

    State<dim>                    &state;
    Terms<dim>                     terms;
    const std::vector<std::string> body_names;
    dealii::TimerOutput            unused_timer;
    dealii::TimerOutput           &timer;
    StepContext<dim>               context;
    ConstraintTable                constraints;
    BodiesOfNodes                  bodies;
    GlobalSystem<dim>              sums;
    LA::Vector                     residual_vector;
    StepForces                     forces;
    /** The residual with the forces that strong conditions take. */
    LA::Vector unbalanced;
    /** Where residual and unbalanced forces were assembled last, if at all. */
    LA::Vector              assembled_at;
    bool                    assembled  = false;
    bool                    predicting = false;
    std::function<void()>   move_mesh; ///< if it moves
    std::vector<LA::Vector> rigid_modes;
    ForceScale              scale;
    double                  last_violation = 0;
  };
} // namespace moraine

#endif
