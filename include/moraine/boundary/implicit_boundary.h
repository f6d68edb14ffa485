// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_implicit_boundary_h
#define moraine_boundary_implicit_boundary_h

#include <moraine/boundary/carried_tractions.h>
#include <moraine/boundary/conflicting_pieces.h>
#include <moraine/boundary/constraint.h>
#include <moraine/boundary/enforcement.h>
#include <moraine/boundary/surface_cut.h>
#include <moraine/core/simulation_state.h>
#include <moraine/geometry/placement.h>
#include <moraine/material/material.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** A place of a cut surface in a step: what it is to do and what acts. The
   * values and gradients of the functions stand beside it in the boundary's
   * arrays. */
  template <int dim>
  struct BoundaryPoint : CutPoint<dim>
  {
    /** Where the place ends on a curve: the level it has at the start, zero but
     * for means. */
    double                 level = 0;
    double                 depth = 0;           ///< h, or see set_depths()
    dealii::Tensor<1, dim> prescribed;          ///< @f$\Delta g@f$ of the step
    dealii::Tensor<1, dim> multiplier;          ///< @f$t@f$ of the trial state
    dealii::Tensor<1, dim> multiplier_at_start; ///< of the step
    /** @f$\sum M(u - g)@f$ of the steps before. */
    dealii::Tensor<1, dim> accumulated_violation;
    /** Whether it constrains anything; the multiplier stays if it does not. */
    bool holds = true;
  };

  /**
   * How displacements and tractions vary along the piece of a surface that is
   * held by its mean, as the function @f$\psi = s^{-1}\, e \cdot (x - \bar
   * x)@f$ with @f$\int_{\Gamma_c} \psi^2 = |\Gamma_c|@f$; e is a principal
   * axis of the piece and s the root of the mean square of distances along it.
   * Of a field f it is @f$|\Gamma_c|^{-1} \int_{\Gamma_c} \psi f@f$. It is held
   * as a place is.
   */
  template <int dim>
  struct BoundarySlope : BoundaryPoint<dim>
  {
    unsigned int           point;  ///< whose mean is held
    dealii::Tensor<1, dim> offset; ///< @f$s\, e@f$ at the start of the step
  };

  /**
   * A surface with a constraint that need not follow the mesh. Each step its
   * pieces in the active cells of this rank are found again if anything moved,
   * and what a place of the surface carries is handed over to the same place:
   * a roller's multiplier with its normal, any other as the vector it is. At
   * finite strain a fixed surface turns the body beside it, and thus its
   * multiplier, by the rotation of the step.
   *
   * What it carries is written by keep() alone; points and their values are
   * derived from that by begin_step() and set_target().
   *
   * A mean does not resist rotation of the piece about it. Where points cross
   * cells, such rotations accumulate; slopes() resists them by a penalty,
   * except for rollers on curves and around bends.
   *
   * Its parts: SurfaceCut finds the places, Constraint is the law,
   * CarriedTractions keeps the state from step to step.
   *
   * A roller on a curved wall asks that the surface points end on the wall,
   * @f$\phi_{n+1}(x + \Delta u) = \phi_n(x)@f$, if the points move at all;
   * linear otherwise. The mean of places, which is at the chord, may thus go
   * around with the body without being pushed.
   */
  template <int dim>
  class ImplicitBoundary : public StatePart
  {
  public:
    /** Prescribed displacement relative to the surface's motion, of (x, t). */
    using Displacement =
      std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                           const double)>;

    /** Of the material behind the surface in a cell, in cell sizes: cells
     * filled less follow their neighbours by default, and what lies in a cell
     * without a point would be nothing. */
    static constexpr double smallest_depth = 0.1;

    ImplicitBoundary(const std::string                  &name,
                     std::shared_ptr<const Surface<dim>> surface,
                     const RigidMotion<dim>             &motion,
                     const Displacement                 &displacement,
                     const Constraint<dim>              &constraint,
                     const Enforcement                  &enforcement,
                     const double                        penetration_limit);

    /**
     * Place the surface at time @p t and find its pieces. Those outside active
     * cells count up to a distance @p search_tolerance. If the points do not
     * move (@p moves_points is false, small displacement), the surface stays
     * where it was at first and its motion is prescribed there. @p
     * cells_changed says that pieces must be found again even if the surface
     * stands still.
     *
     * @p in_motion says that it is dynamics by forces of this step alone; see
     * Enforcement::holds_means(). @p through_cells says that points move
     * through the cells.
     *
     * Where @p covers finds no body behind a part of the surface in a cell,
     * that part is left out.
     */
    void
    begin_step(const GridSpace<dim>                   &space,
               const double                            t,
               const double                            search_tolerance,
               const bool                              moves_points,
               const StrainMeasure                     measure,
               const bool                              cells_changed,
               const bool                              in_motion     = false,
               const typename BodyBehind<dim>::Covers &covers        = {},
               const bool                              through_cells = false);

    /** Whether means over pieces are held by multipliers in @p cell at time
     * @p t, where the surface is by then; or were before dynamics began. */
    bool
    holds_mean_in(const GridSpace<dim>                        &space,
                  const typename GridSpace<dim>::CellIterator &cell,
                  const double                                 t);

    /**
     * Let the factor of Nitsche's method act over @p share of the depth of the
     * material behind the surface in the cell of each point,
     * @f$|\Omega \cap c| / |\Gamma \cap c|@f$ or h/10 if that is more, instead
     * of h, but never over more than h: by this depth the energy of linear
     * displacements bounds their flux, @f$\int_{\Gamma \cap c} f\, Q^{-1} f
     * \leq |\Gamma \cap c| /
     * |\Omega \cap c| \int_{\Omega \cap c} \sigma : \varepsilon@f$.
     * Until the next begin_step().
     * @param volumes @f$|\Omega \cap c|@f$ by active_cell_index()
     * @param share > 0
     */
    void
    set_depths(const std::vector<double> &volumes, const double share);

    /** Set the prescribed increments of a step to @p t_end, and multipliers as
     * they are at its start; an enforcement without them has them only where
     * @p t_end is the start. */
    void
    set_target(const double t_end);

    /** Set the prescribed increments alone. */
    void
    move_target(const double t_end);

    /** Ask for what it prescribes at @p t, at one place.
     * @throws InputError if that is not a number */
    void
    check_value(const double t) const;

    /** The constraint at a point or slope for the trial increment @p du there;
     * @p share of the step is where a roller pushes. */
    ConstraintState<dim>
    constraint_state(const BoundaryPoint<dim>     &point,
                     const dealii::Tensor<1, dim> &du,
                     const double                  share) const;

    /** The increments it prescribes from each of some @p times to the next one,
     * for the pose it has now. */
    PrescribedIncrements<dim>
    increments_between(const std::vector<double> &times) const;

    /** Of an active_cell_index(). */
    using AnswerForCell = std::function<bool(const unsigned int)>;

    /** Let the points in each cell hold or not, and the slopes of those that
     * hold, until pieces are found again. */
    void
    hold_in_cells(const AnswerForCell &points_hold,
                  const AnswerForCell &slopes_hold);

    /** Take these multipliers until the next set_target(). */
    void
    set_multipliers(const std::vector<dealii::Tensor<1, dim>> &multipliers);

    /** Find what the surface will carry with the tractions and violations of
     * the trial state, and the tractions of slopes(). */
    void
    prepare(const std::vector<dealii::Tensor<1, dim>> &tractions,
            const std::vector<dealii::Tensor<1, dim>> &violations,
            const std::vector<dealii::Tensor<1, dim>> &of_slopes = {});

    /** Carry what was prepared. */
    void
    keep() noexcept
    {
      carried.keep();
      kept_at_points = true;
    }

    /** Carry nothing: it begins to act, maybe anew. */
    void
    forget() noexcept
    {
      carried.forget();
      found = kept_at_points = false;
    }

    /** What it carries, in the group "boundaries/" and its name. */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

    void
    undo() override
    {
      carried.undo();
    }

    const std::string &
    name() const
    {
      return boundary_name;
    }

    const MovedSurface<dim> &
    surface_at_start() const
    {
      return at_start;
    }

    const MovedSurface<dim> &
    surface_at_end() const
    {
      return at_end;
    }

    const RigidMotion<dim> &
    rigid_motion() const
    {
      return motion;
    }

    const Constraint<dim> &
    constraint() const
    {
      return law;
    }

    const Enforcement &
    enforcement() const
    {
      return how;
    }

    /** Largest depth a point may end behind the surface, in cell sizes. */
    double
    penetration_limit() const
    {
      return limit;
    }

    /** Whether points end on a curve, so that normals depend on where they come
     * to. */
    bool
    follows_curve() const
    {
      return kind.projects;
    }

    /** Whether the normal changes with the place of what slides. */
    bool
    is_curved_roller() const
    {
      return at_start.curved() && law.kind == Constraint<dim>::roller;
    }

    /** The largest coordinate of a place that is to end on a curve: violations
     * are sums of these. Else zero. */
    double
    rounded_length() const
    {
      return kind.projects ? largest_coordinate : 0.;
    }

    const std::vector<BoundaryPoint<dim>> &
    points() const
    {
      return boundary_points;
    }

    /** Those that are held: of pieces with means that multipliers hold where
     * points move through cells. */
    const std::vector<BoundarySlope<dim>> &
    slopes() const
    {
      return boundary_slopes;
    }

    /** Number of points over all ranks. Collective. */
    unsigned int
    n_points(const MPI_Comm &communicator) const;

    /** How often pieces were found so far; the points are new each time. The
     * same on all ranks. */
    unsigned int
    n_searches() const
    {
      return searches;
    }

    /** Values of the functions of the nodes of its cell at a point. */
    const double *
    N(const unsigned int q) const
    {
      return &cut.functions.values[q * cut.functions.n_nodes];
    }

    const dealii::Tensor<1, dim> *
    grad_N(const unsigned int q) const
    {
      return &cut.functions.gradients[q * cut.functions.n_nodes];
    }

    /** The slopes of these functions along the piece of slope @p k. */
    const double *
    slope_of_N(const unsigned int k) const
    {
      return &cut.slopes_of_N[k * cut.functions.n_nodes];
    }

  private:
    /** What a step makes of the surface; see begin_step(). */
    struct Kind
    {
      bool moves_with_points = true;
      bool projects          = false; ///< points onto a curved roller
      bool turns_multiplier  = false;
      bool holds_means       = false; ///< of the pieces in cells
      bool holds_slopes      = false; ///< of them too, but around bends
    };

    Kind
    kind_of_step(const unsigned int  degree,
                 const bool          moves_points,
                 const StrainMeasure measure,
                 const bool          in_motion,
                 const bool          through_cells) const;

    /** Be where the surface is at @p t. */
    void
    place_at(const double t)
    {
      placed_at = t;
      at_start.set_pose(motion.pose(t));
    }

    /** Take the points and slopes of the present cut. Collective. */
    void
    take_points(const MPI_Comm &communicator);

    /** The increment it prescribes at @p x from @p t_0 to @p t_1, when it has
     * these poses. */
    dealii::Tensor<1, dim>
    increment_at(const dealii::Point<dim> &x,
                 const double              t_0,
                 const Placement<dim>     &pose_0,
                 const double              t_1,
                 const Placement<dim>     &pose_1) const;

    /** The rotation of what is carried into the frame of the space: a roller's
     * multiplier goes with its surface. */
    dealii::Tensor<2, dim>
    from_frame() const;

    /** Give each point and its slopes what @p places say. */
    void
    take_over(const std::vector<CarriedPlace<dim>> &places);

    /** Where the points of this rank are, in the surface's own frame. */
    std::vector<CarriedPlace<dim>>
    places_of_points() const;

    const std::string      boundary_name;
    MovedSurface<dim>      at_start;
    MovedSurface<dim>      at_end;
    const RigidMotion<dim> motion;
    const Displacement     displacement;
    const Constraint<dim>  law;
    const Enforcement      how;
    const double           limit;
    double                 t_start = 0;
    std::optional<double>  placed_at;        ///< a time; none before the first
    bool                   found    = false; ///< the cut
    unsigned int           searches = 0;
    Kind                   kind;
    double                 largest_coordinate = 0; ///< of points
    BodyBehind<dim>        body;
    CarriedTractions<dim>  carried;
    bool                   kept_at_points = false;
    SurfaceCut<dim>        cut;
    std::vector<BoundaryPoint<dim>> boundary_points;
    std::vector<BoundarySlope<dim>> boundary_slopes;
  };
} // namespace moraine

#endif
