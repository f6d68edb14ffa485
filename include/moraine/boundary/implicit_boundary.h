// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_implicit_boundary_h
#define moraine_boundary_implicit_boundary_h

#include <moraine/boundary/body_behind.h>
#include <moraine/boundary/enforcement.h>
#include <moraine/boundary/conflicting_pieces.h>
#include <moraine/core/simulation_state.h>
#include <moraine/geometry/placement.h>
#include <moraine/geometry/shape.h>
#include <moraine/material/spectral.h>
#include <moraine/mesh/grid_space.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** What a surface constrains. */
  template <int dim>
  struct Constraint
  {
    enum Kind
    {
      fixed,     ///< @f$M = 1@f$
      roller,    ///< @f$M = n \otimes n@f$
      components ///< @f$M = \sum e_i \otimes e_i@f$
    };
    Kind                  kind = fixed;
    std::array<bool, dim> component{};

    dealii::SymmetricTensor<2, dim>
    projection(const dealii::Tensor<1, dim> &normal) const;
  };

  /** A place of a cut surface in a step. The values and gradients of the shape
   * functions stand beside it in the boundary's arrays. */
  template <int dim>
  struct BoundaryPoint
  {
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> normal; ///< outward, at the start of the step
    /** Where the place ends on a curve: the level it has at the start, zero but
     * for means. */
    double                 level = 0;
    double                 JxW;        ///< length or area
    double                 body_area;  ///< the part of it that a body is at
    unsigned int           cell;       ///< active_cell_index()
    unsigned int           number;     ///< among the points of the cell
    double                 h;          ///< size of that cell
    double                 depth;      ///< h, or see set_depths()
    dealii::Tensor<1, dim> prescribed; ///< @f$\Delta g@f$ of the step
    dealii::Tensor<1, dim> multiplier; ///< @f$t@f$ of the trial state
    dealii::Tensor<1, dim> multiplier_at_start; ///< of the step
    /** @f$\sum M(u - g)@f$ of the steps before. */
    dealii::Tensor<1, dim> accumulated_violation;
    /** Whether it constrains anything; the multiplier stays if it does not. */
    bool holds = true;
  };

  /** A point's constraint in the trial state: projection, violation of the step
   * and the normal they refer to. */
  template <int dim>
  struct ConstraintState
  {
    dealii::Tensor<1, dim>          normal;
    dealii::SymmetricTensor<2, dim> M;
    dealii::Tensor<1, dim>          violation; ///< @f$M(\Delta u - \Delta g)@f$
    /** Along the normal, its mean over the piece of the surface in the cell,
     * where that is penalised. */
    double mean_violation = 0;
    /** Where a roller pushes: along the normal, or along the mean of both ends
     * of the step, in which a curved wall does no work and has no moment. */
    dealii::Tensor<1, dim> push;
    /** Where the force on the point acts: at the end of the step, or in the
     * middle of it as the push. */
    dealii::Point<dim> place;
  };

  /**
   * How displacements and tractions vary along the piece of a surface that is
   * held by its mean, as the function @f$\psi = s^{-1}\, e \cdot (x - \bar
   * x)@f$ with @f$\int_{\Gamma_c} \psi^2 = |\Gamma_c|@f$; e is a principal
   * axis of the piece and s the root of the mean square of distances along it.
   * Of a field f it is @f$|\Gamma_c|^{-1} \int_{\Gamma_c} \psi f@f$.
   */
  template <int dim>
  struct BoundarySlope
  {
    unsigned int point; ///< whose mean is held
    /** Or it keeps its traction, as where another boundary is in the way. */
    bool                   holds = true;
    dealii::Tensor<1, dim> offset;     ///< @f$s\, e@f$ at the start of the step
    dealii::Tensor<1, dim> prescribed; ///< of @f$\Delta g@f$
    dealii::Tensor<1, dim> traction;   ///< carried, in the trial state
    dealii::Tensor<1, dim> traction_at_start; ///< of the step
  };

  /** What a place of a surface carries from step to step. */
  template <int dim>
  struct CarriedPlace
  {
    dealii::Tensor<1, dim> place; ///< in the surface's own frame
    /** Multiplier and accumulated violation; a roller's in that frame too. */
    dealii::Tensor<1, dim> multiplier;
    dealii::Tensor<1, dim> violation;
    /** How the traction of the piece varies along it [stress/length]: a row for
     * each of its components, columns in the surface's own frame. */
    dealii::Tensor<2, dim> slope;
    double                 area = 0; ///< of the surface that it stands for
    /** Outward, in the surface's own frame. */
    dealii::Tensor<1, dim> normal;
    double                 h = 0; ///< size of the cell it was in
    /** Cell and number of the point it was: names that ranks share. */
    std::array<unsigned int, 2> id;

    template <class BoostArchive>
    void
    serialize(BoostArchive &archive, const unsigned int)
    {
      archive &place &multiplier &violation &slope &area &normal &h &id;
    }
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
   * What turns in a cell about a mean is not held by it. Where material comes
   * through the cells, that adds up; there slopes() are held too, by a penalty,
   * but for rollers on curves and around bends.
   *
   * A piece in a cell without unknowns that lies within @p search_tolerance of
   * an active cell belongs to the nearest one and sees its functions continued
   * over the edge, because the material represented by points close to the edge
   * reaches over it.
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

    /** Ask for what it prescribes at @p t, at one place.
     * @throws InputError if that is not a number */
    void
    check_value(const double t) const;

    /** Set the prescribed increments alone. */
    void
    move_target(const double t_end);

    /** The constraint at a point for the trial increment @p du there; @p
     * share of the step is where a roller pushes. */
    ConstraintState<dim>
    constraint_state(const BoundaryPoint<dim>     &point,
                     const dealii::Tensor<1, dim> &du,
                     const double                  share) const;

    /** @f$M@f$ for a normal. */
    dealii::SymmetricTensor<2, dim>
    projection(const dealii::Tensor<1, dim> &normal) const
    {
      return constraint.projection(normal);
    }

    /** The increments it prescribes from each of some @p times to the next one,
     * for the pose it has now. */
    PrescribedIncrements<dim>
    increments_between(const std::vector<double> &times) const;

    /** Of an active_cell_index(). */
    using AnswerForCell = std::function<bool(const unsigned int)>;

    /** Let the points in each cell hold or not, until pieces are found again.
     */
    void
    hold_in_cells(const AnswerForCell &holds)
    {
      for (auto &point : boundary_points)
        point.holds = holds(point.cell);
    }

    /** The same for slopes, which do not hold where the points do not. */
    void
    hold_slopes_in_cells(const AnswerForCell &holds)
    {
      for (auto &slope : held_slopes.all)
        slope.holds = holds(boundary_points[slope.point].cell);
    }

    /** Those that are held: of pieces with means that multipliers hold where
     * points move through cells. */
    const std::vector<BoundarySlope<dim>> &
    slopes() const
    {
      return held_slopes.all;
    }

    /** Of the functions of the nodes of its cell, what slope @p k has. */
    const double *
    slope_of_N(const unsigned int k) const
    {
      return &held_slopes.values[k * shapes.n_nodes];
    }

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
      std::swap(carried, prepared);
      kept_at_points = true;
    }

    /** Carry nothing: it begins to act, maybe anew. */
    void
    forget() noexcept
    {
      carried.clear();
      search.done = kept_at_points = false;
    }

    /** What it carries, in the group "boundaries/" and its name. */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

    void
    undo() override
    {
      prepared.clear();
    }

    /** Distance behind the surface at the end of the step; 0 if in front. */
    double
    penetration(const dealii::Point<dim> &x, const double range) const
    {
      const double level = at_end.level(x);
      return (level < 0 && level > -range && at_end.in_extent(x)) ? -level : 0.;
    }

    /**
     * Whether nothing within @p radius of @p x is near the surface at the end
     * of the step. The level of an expression is an estimate, hence a factor.
     */
    bool
    is_far(const dealii::Point<dim> &x, const double radius) const
    {
      return std::abs(at_end.level(x)) > 2 * radius;
    }

    /** Whether normals depend on where points come to. */
    bool
    follows_curve() const
    {
      return kind.projects;
    }

    /**
     * How the normal at the end of the step changes with the place, there where
     * @p point comes to by @p du; zero if it is not asked for there
     * (@f$\nabla n@f$, 1 over the radii of curvature along the surface), by
     * central differences. At a corner there is none.
     */
    dealii::SymmetricTensor<2, dim>
    normal_gradient(const BoundaryPoint<dim>     &point,
                    const dealii::Tensor<1, dim> &du) const;

    /** What is nearest to @p x on the surface at the start of the step. */
    NearestPoint<dim>
    nearest_at_start(const dealii::Point<dim> &x) const
    {
      return at_start.nearest(x);
    }

    /** The same at its end. */
    NearestPoint<dim>
    nearest_at_end(const dealii::Point<dim> &x) const
    {
      return at_end.nearest(x);
    }

    const std::string &
    name() const
    {
      return boundary_name;
    }

    /** The middle of the box around the surface at the start; of a surface
     * without ends, the point nearest to @p near. */
    dealii::Point<dim>
    middle(const dealii::Point<dim> &near) const
    {
      const auto box = at_start.bounding_box();
      if (is_finite(box))
        return box.center();
      const NearestPoint<dim> nearest = at_start.nearest(near);
      return near + nearest.level * nearest.normal; // positive in the body
    }

    const RigidMotion<dim> &
    rigid_motion() const
    {
      return motion;
    }

    /** Of the surface, at the start of the step. */
    const Placement<dim> &
    pose_at_start() const
    {
      return at_start.pose();
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

    /** The largest coordinate of a place that is to end on a curve: violations
     * are sums of these. Else zero. */
    double
    rounded_length() const
    {
      return kind.projects ? largest_coordinate : 0.;
    }

    /** Number of points over all ranks. Collective. */
    unsigned int
    n_points(const MPI_Comm &communicator) const;

    /** Whether material may slide along it. */
    bool
    is_roller() const
    {
      return constraint.kind == Constraint<dim>::roller;
    }

    /** Whether its normal changes with the place of what slides. */
    bool
    is_curved_roller() const
    {
      return at_start.curved() && is_roller();
    }

    /** What it constrains, in words. */
    std::string
    constraint_name() const;

    const std::vector<BoundaryPoint<dim>> &
    points() const
    {
      return boundary_points;
    }

    /** How often pieces were found so far; the points are new each time. The
     * same on all ranks. */
    unsigned int
    n_searches() const
    {
      return search.number;
    }

    /** Values of the shape functions at a point. */
    const double *
    N(const unsigned int q) const
    {
      return &shapes.values[q * shapes.n_nodes];
    }

    const dealii::Tensor<1, dim> *
    grad_N(const unsigned int q) const
    {
      return &shapes.gradients[q * shapes.n_nodes];
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

    /** Whether there are pieces, and how often they were found. */
    struct Search
    {
      bool         done   = false;
      unsigned int number = 0;
    };

    /** Functions of the nodes of each point's cell, point by point. */
    struct Shapes
    {
      unsigned int                        n_nodes = 0; ///< of a cell
      std::vector<double>                 values;
      std::vector<dealii::Tensor<1, dim>> gradients;
    };

    struct Slopes
    {
      std::vector<BoundarySlope<dim>> all;
      std::vector<double>             values; ///< of functions, as of Shapes
    };

    /** Be where the surface is at @p t. */
    void
    place_at(const double t)
    {
      placed_at = t;
      at_start.set_pose(motion.pose(t));
    }

    /** The increment it prescribes at @p x from @p t_0 to @p t_1, when it has
     * these poses. */
    dealii::Tensor<1, dim>
    increment_at(const dealii::Point<dim> &x,
                 const double              t_0,
                 const Placement<dim>     &pose_0,
                 const double              t_1,
                 const Placement<dim>     &pose_1) const;

    void
    find_pieces(const GridSpace<dim> &space, const double search_tolerance);

    using CellIterator = typename GridSpace<dim>::CellIterator;
    /** The active cell whose functions hold a place of a cell, or none. */
    using Owner = std::function<CellIterator(const CellIterator &,
                                             const dealii::Point<dim> &)>;

    /** The cells of this rank that own places of the surface in @p cell. */
    std::vector<CellIterator>
    owners_in(const CellIterator &cell, const Owner &owner_of) const;

    /**
     * Points on the surface inside of @p vertices, @p cell or a layer at it,
     * that are places of @p owner, and have a body. It alone decides, for its
     * rank knows nothing of the bodies at other owners.
     */
    void
    add_pieces(const CellIterator      &cell,
               const CellVertices<dim> &vertices,
               const CellIterator      &owner,
               const Owner             &owner_of);

    /** Whether a piece in a cell with these @p vertices holds also where no
     * body is: one that is pushed through material would else lose hold of it.
     */
    bool
    holds_beyond_bodies(const CellVertices<dim>      &vertices,
                        const dealii::Tensor<1, dim> &normal) const;

    /** The parts of the areas of @p pieces, all in a cell with these @p
     * vertices, that a body is at, by what @p is_at_body says of places; or
     * behind as @p is_near_body says, if none is at any of them. Never quite
     * zero, so that what such places alone hold has a place. */
    std::vector<double>
    areas_at_bodies(
      const CellVertices<dim>                              &vertices,
      const unsigned int                                    n_gauss,
      const std::vector<SurfacePoint<dim>>                 &pieces,
      const std::function<bool(const SurfacePoint<dim> &)> &is_own,
      const std::function<bool(const SurfacePoint<dim> &)> &is_at_body,
      const std::function<bool(const SurfacePoint<dim> &)> &is_near_body) const;

    /** Let the points of a cell be one, with the means of their functions; on
     * each side of a corner one. Those of a piece parallel to faces of the cell
     * stay, as functions can vanish there and keep their gradient. */
    void
    take_means(const GridSpace<dim> &space);

    /** Find the slopes of @p means, of which the present point q is part of
     * mean @p mean_of[q]. */
    void
    find_slopes(const std::vector<BoundaryPoint<dim>> &means,
                const std::vector<unsigned int>       &mean_of);

    void
    number_points();

    /** Evaluate the functions of active cell @p cell_index at every point. */
    void
    evaluate_shapes(const GridSpace<dim> &space);

    /** Of points that are to end on a curve. Collective. */
    void
    find_levels(const MPI_Comm &communicator);

    /** Give each point and its slopes what @p carried says. */
    void
    take_over(const std::vector<CarriedPlace<dim>> &carried);

    /** Where the points of this rank are, in the surface's own frame. */
    std::vector<CarriedPlace<dim>>
    places_of_points() const;

    /**
     * Give every point what the nearest carried place of all ranks has, if one
     * is near and faces the same way: the next side of a corner and places of
     * another body are no place of it. A point that stands for a piece of a
     * cell gets the mean, by area, of the places that it is the nearest point
     * to, if there are any: where it takes the place of several, the force
     * stays the same.
     */
    void
    take_over_nearest(const MPI_Comm &communicator);

    const std::string              boundary_name;
    MovedSurface<dim>              at_start;
    MovedSurface<dim>              at_end;
    const RigidMotion<dim>         motion;
    const Displacement             displacement;
    const Constraint<dim>          constraint;
    const Enforcement              how;
    const double                   limit;
    double                         t_start = 0;
    std::optional<double>          placed_at; ///< a time; none before the first
    Search                         search;
    Kind                           kind;
    double                         largest_coordinate = 0; ///< of points
    BodyBehind<dim>                body;
    std::vector<CarriedPlace<dim>> carried;
    std::vector<CarriedPlace<dim>> prepared;
    bool                           kept_at_points = false;
    std::vector<BoundaryPoint<dim>> boundary_points;
    Shapes                          shapes;
    Slopes                          held_slopes;
  };
} // namespace moraine

#endif
