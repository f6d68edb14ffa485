// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_motion_h
#define moraine_state_motion_h

#include <moraine/core/linear_algebra.h>
#include <moraine/state/state.h>
#include <moraine/time/time_integrator.h>

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace moraine
{
  /** How velocity goes between nodes and points. */
  struct VelocityTransfer
  {
    enum class Scheme
    {
      /** Not at all: nodes stay with the material and keep theirs. */
      none,
      /** FLIP, PIC or a blend of both. */
      flip_and_pic,
      /** Affine: with the gradient of the velocity. */
      apic,
      /** Nodal velocities by an approximate inverse of the full mass matrix. */
      fmpm
    };

    Scheme       scheme     = Scheme::none;
    double       flip_share = 1; ///< 1: FLIP, 0: PIC
    unsigned int fmpm_order = 1;

    VelocityTransfer() = default;

    /** Of points that move through the mesh. */
    explicit VelocityTransfer(const IntegratorParameters &parameters);
  };

  /** To what the work of a force is counted. */
  enum class WorkKind : unsigned char
  {
    internal,
    external,
    boundaries,
    absorbed,
    damping,
    none
  };

  /** Of all steps so far [force length]. */
  struct Works
  {
    static constexpr unsigned int n_kinds = 5;
    /** By WorkKind, positive where forces push the material along. */
    double of_forces[n_kinds] = {0, 0, 0, 0, 0};
    /** Of those of boundaries: by nodes that follow a prescribed motion. */
    double of_prescribed = 0;
    /** Energy that went as velocities went from nodes to points and back, with
     * accelerations that are out of balance after that, and as the weights of
     * points changed. */
    double lost_in_transfer = 0;
    double lost_stored      = 0; ///< of that: stored energy
    double kinetic_at_start = 0;
    double kinetic          = 0; ///< of the nodes at the end of the last step
    double stored_at_start  = 0;
    double stored           = 0; ///< in elastic strain, at the end of the last
    double dissipated       = 0; ///< by plastic strain
    bool   begun            = false;

    /** What the works of all forces are more than the change of kinetic energy:
     * the integrator took it, or made it if negative. Zero for average
     * acceleration and the rule of energy and momentum. */
    double
    numerical_damping() const;

    /** What internal forces took is more than what was stored and dissipated:
     * the error of the work of finite steps. */
    double
    out_of_balance() const
    {
      return stored_at_start - stored - lost_stored - dissipated -
             of_forces[unsigned(WorkKind::internal)];
    }

    /** The largest part of the sum. */
    double
    largest() const;
  };



  /** Sums over all points. */
  template <int dim>
  struct MotionSums
  {
    double                 mass = 0;
    dealii::Tensor<1, dim> momentum;
    /** About the origin; in 2D the z-component alone. */
    dealii::Tensor<1, dim == 2 ? 1 : 3> angular_momentum;
    double                              kinetic_energy = 0;
  };



  /**
   * Velocity and acceleration of the nodes, at the start of a step and in the
   * trial state. Where nodes stay with the material (finite elements) they keep
   * them. Where points move through the mesh, points carry them, and at the
   * start of a step nodes get the means @f$v = S^+ V@f$,
   *
   * @f[ (S^+ V)_a = \frac{\sum_p N_a m_p V_p}{\sum_p N_a m_p} , @f]
   *
   * and accelerations alike. At its end points get @f$A_p = \sum_a N_a
   * a_a^{n+1}@f$ and, by the scheme,
   *
   * - a share of FLIP, @f$V_p + \sum_a N_a (v_a^{n+1} - v_a^n)@f$, and the rest
   *   of PIC, @f$\sum_a N_a v_a^{n+1}@f$;
   * - APIC: as PIC, and the gradient @f$G_p = \sum_a v_a^{n+1} \otimes \nabla
   *   N_a@f$, with which @f$V_p + G_p (x_a - \sum_b N_b x_b)@f$ goes to the
   * nodes in place of @f$V_p@f$. (With @f$G_p@f$ from the gradients of the
   * functions, it is the Taylor variant, TPIC, and holds for hat functions as
   * well.)
   * - FMPM of order k (Hammerquist and Nairn 2017; Nairn 2021): as PIC, with
   *   the nodes' @f$v_{(1)} = S^+ V@f$, @f$v_{(j)} = v_{(j-1)} + S^+ (V - S
   *   v_{(j-1)})@f$, and accelerations alike.
   */
  template <int dim>
  class Motion : public StatePart
  {
  public:
    using NodeValues = std::vector<dealii::Tensor<1, dim>>;

    /** Ask for what points carry with @p transfer; velocity and acceleration
     * to be seen even if nodes keep theirs. @p looks_back: some integrator asks
     * for accelerations of the step before. */
    static void
    request_fields(const VelocityTransfer &transfer,
                   PointFields            &fields,
                   const bool              looks_back = false);

    /** Of the material of @p state at rest. Points have the fields of
     * @p transfer. */
    Motion(const State<dim>       &state,
           PointSet<dim>          &points,
           const TimeIntegrator   &integrator,
           const VelocityTransfer &transfer,
           const bool              lumped_mass);

    /** Stop nodes and points. */
    void
    rest();

    /** Give nodes and points @p velocity of a body at a place and no
     * acceleration, and count works anew. */
    void
    start(
      const std::function<dealii::Tensor<1, dim>(const unsigned int        body,
                                                 const dealii::Point<dim> &x)>
        &velocity);

    /** After read(), where bodies have come: if nodes keep their velocities,
     * those that points of bodies @p come see get the mean of what they had and
     * of bodies at rest, so that these bring no momentum. Collective. */
    void
    slow_down(const std::vector<bool> &come);

    /** Get what nodes have at the start of a step, after State::begin_step().
     * Collective. */
    void
    begin_step();

    /** Fills the constrained entries of an increment with the part prescribed
     * up to this share of the step, or with none. */
    using Constrain =
      std::function<void(const std::optional<double> share, LA::Vector &)>;

    /**
     * Aim at the end of a step of @p size. Nodes that conditions move have the
     * accelerations of a cubic in time through where they are at both ends and
     * thirds of the step, and the velocity by which the rule gives them; with
     * forces in the middle of the step the mean acceleration, by where they are
     * in the middle. Those that are tied follow. @p constrain is empty if there
     * are no conditions; @p moves: some prescribe a motion that is not none in
     * the step. Collective.
     */
    void
    set_target(const double     size,
               const Constrain &constrain,
               const bool       moves = false);

    /** Aim at the start of the step itself, where inertia is that of
     * accelerations(). */
    void
    set_target_at_start();

    /** @f$(1-\alpha_m) a_{n+1} + \alpha_m a_n@f$ over @f$1-\alpha_f@f$;
     * @f$a_n@f$ after set_target_at_start(), none in another step of size 0. */
    dealii::Tensor<1, dim>
    inertial_acceleration(const unsigned int            node,
                          const dealii::Tensor<1, dim> &du) const
    {
      const dealii::Tensor<1, dim> result =
        by_increment * (du - step_size * v[node]) + by_start * a[node];
      return by_before == 0 ? result : result + by_before * a_before[node];
    }

    /** Its derivative by @f$\Delta u@f$; 1 in a step of size 0. */
    double
    inertial_acceleration_by_increment() const
    {
      if (!(step_size > 0))
        return 1.;
      return rule.end_inertia() * rule.acceleration_by_increment(step_size);
    }

    /** The velocity where the integrator asks for forces: @f$v_{n+1}@f$ of the
     * trial state or that in the middle of the step, @f$\Delta u/\Delta t@f$;
     * @f$v_n@f$ in a step of size 0. */
    dealii::Tensor<1, dim>
    velocity(const unsigned int node, const dealii::Tensor<1, dim> &du) const
    {
      if (!(step_size > 0))
        return v[node];
      if (rule.forces_in_the_middle())
        return du / step_size;
      return end_of_step(node, du).first;
    }

    /** Its derivative by @f$\Delta u@f$. */
    double
    velocity_by_increment() const
    {
      if (!(step_size > 0))
        return 0.;
      return rule.forces_in_the_middle() ?
               1 / step_size :
               rule.velocity_by_increment(step_size);
    }

    /** Whether a rule of Newmark's that comes next balances the means of both
     * ends, see TimeIntegrator::with_means(). */
    void
    balance_means(const bool yes)
    {
      balances_means = yes;
    }

    /** Go on by another one. */
    void
    set_integrator(const TimeIntegrator &integrator)
    {
      rule = balances_means ? integrator.with_means() : integrator;
    }

    const TimeIntegrator &
    integrator() const
    {
      return rule;
    }

    /** At the start of the step, or of an accepted one at its end. */
    const NodeValues &
    velocities() const
    {
      return v;
    }

    const NodeValues &
    accelerations() const
    {
      return a;
    }

    struct Nodal
    {
      NodeValues v, a;
      NodeValues a_before; ///< empty if no integrator looks back
    };

    /** Of the trial state at the end of the step. */
    Nodal
    at_end() const;

    /** Take accelerations at the start of a step; nodes without mass follow
     * their points. Collective. */
    void
    set_accelerations(const LA::Vector &values);

    /** Estimated error of the trial increment, in the mean over the mass; see
     * TimeIntegrator::error_of_increment(). [length] Collective. */
    double
    error_of_increment() const;

    /** Whether all points that see a node lie where its functions are zero, but
     * for round-off: on the opposite face of a cell. It has stiffness, but no
     * mass. */
    bool
    is_massless(const unsigned int node) const
    {
      return !massless.empty() && massless[node];
    }

    /** Whether points carry the motion from step to step, not nodes. */
    bool
    points_carry() const
    {
      return transfer.scheme != VelocityTransfer::Scheme::none;
    }

    bool
    lumped_mass() const
    {
      return lumped;
    }

    /** The group "motion": works, and what nodes keep. */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

    /** Scalar products of forces at both ends of a step, by WorkKind. */
    struct StepWorks
    {
      std::array<double, Works::n_kinds> at_start{}, at_end{};
      /** Of all with the prescribed part of the increment alone. */
      double on_prescribed_at_start = 0, on_prescribed_at_end = 0;

      /** If each rank has its share. Collective. */
      void
      sum_over_ranks(const MPI_Comm &communicator);
    };

    /** The prescribed part of the increments; empty if no condition moves
     * anything in this step. */
    const NodeValues &
    prescribed_increments() const
    {
      return prescribed;
    }

    /** Count the @p energies of this rank in the step that was accepted.
     * Collective. */
    void
    count(const StepEnergies &energies);

    const Works &
    works() const
    {
      return done;
    }

    /** Of the committed motion. Collective. */
    MotionSums<dim>
    sums() const;

    /**
     * Commit the motion of the trial state and count the work of the step, the
     * mean of both ends. What holds the prescribed motion does work as a
     * boundary; what forces are missing at free nodes at the start of the step
     * is counted as lost in transfer. Collective.
     */
    void
    accept(const StepWorks &step);

  private:
    void
    set_step_size(const double size);

    /** Velocity and acceleration. */
    std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>
    end_of_step(const unsigned int node, const dealii::Tensor<1, dim> &du) const
    {
      const dealii::Tensor<1, dim> before =
        rule.looks_back() ? a_before[node] : dealii::Tensor<1, dim>();
      const dealii::Tensor<1, dim> end =
        rule.acceleration(step_size, du, v[node], a[node], before);
      return {rule.velocity(step_size, v[node], a[node], before, end), end};
    }

    /** @f$S^+@f$ of what points carry, less what they get from @p known.
     * Collective. */
    Nodal
    map_to_nodes(const Nodal *known = nullptr);

    /** What the p-th point of a block carries in @p field, less what it gets
     * from a @p member of what is @p known of nodes, if anything is. */
    dealii::Tensor<1, dim>
    unknown_part(const PointField<dim, dealii::Tensor<1, dim>> &field,
                 const Nodal                                   *known,
                 NodeValues Nodal::*const member,
                 const StencilBlock<dim> &block,
                 const unsigned int       p) const;

    /** Add what points of this rank carry, times mass. @p masses are those of
     * nodes, and as component 1 of all points that see each. */
    void
    add_momenta(const Nodal *known, NodeValues &masses, Nodal &sums) const;

    /** Give massless nodes the motion of their points. Collective. */
    void
    extend_motion(const Nodal *known, Nodal &values) const;

    /** @f$u^T M w@f$ of the motion in the step. */
    struct KineticProducts
    {
      double v_v = 0, a_du = 0, v_v_end = 0;
    };

    /** Give points what they carry. Collective. */
    KineticProducts
    map_to_points(const Nodal &end);

    /** Of the kinetic energy at the start of the step, what conditions gave to
     * nodes that had the velocities @p before; none if that is empty.
     * Collective. */
    void
    count_kinetic_change(const NodeValues &before);

    /** Count a step. Collective. */
    void
    count(const StepWorks       &step,
          const KineticProducts &products,
          const Nodal           &end);

    /** Of a node that points of several bodies see, the mean of @p velocity of
     * these there, weighted with the mass that they give it, so that the
     * momentum is that of the bodies. Collective. */
    NodeValues
    mean_of_bodies(
      const std::function<dealii::Tensor<1, dim>(const unsigned int body,
                                                 const unsigned int node)>
        &velocity);

    /** The masses of add_momenta(), of all ranks. Collective. */
    NodeValues
    node_masses() const;

    /** Find those by @p masses. Collective. */
    void
    find_massless(const NodeValues &masses);

    /** Give massless nodes the mean of value(block, p, k), of the p-th point
     * at the k-th node of a block, weighted by gradients: to what a mean by
     * functions tends as points come close to the face. Collective. */
    template <class Value>
    void
    extend(const Value &value, NodeValues &values) const;

    /** Give points the @p field that nodes have. */
    void
    interpolate(const NodeValues                              &values,
                const PointField<dim, dealii::Tensor<1, dim>> &field);

    using Pair = std::pair<const NodeValues *, const NodeValues *>;

    /** @f$u^T M w@f$ of pairs u, w. Collective. */
    template <std::size_t n>
    std::array<double, n>
    mass_products(const std::array<Pair, n> &pairs) const;

    const State<dim>                       &state;
    PointSet<dim>                          &points;
    TimeIntegrator                          rule;
    const VelocityTransfer                  transfer;
    const bool                              lumped;
    PointField<dim, dealii::Tensor<1, dim>> v_field, a_field, before_field;
    PointField<dim, dealii::Tensor<2, dim>> gradient_field;
    NodeValues                              v, a;
    NodeValues a_before;   ///< if some integrator looks back
    NodeValues prescribed; ///< increments, if any
    /** Of nodes; empty if no rank has one. */
    std::vector<bool> massless;
    bool              massless_found  = false; ///< where nodes keep the motion
    double            step_size       = 0;
    bool              balances_means  = false;
    double            from_conditions = 0; ///< see count_kinetic_change()
    /** Of inertial_acceleration(), by @f$\Delta u - \Delta t\, v_n@f$,
     * @f$a_n@f$ and @f$a_{n-1}@f$. */
    double by_increment = 0, by_start = 0, by_before = 0;
    Works  done;
  };
} // namespace moraine

#endif
