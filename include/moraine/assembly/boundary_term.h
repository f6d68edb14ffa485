// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_boundary_term_h
#define moraine_assembly_boundary_term_h

#include <moraine/assembly/term.h>
#include <moraine/boundary/implicit_boundary.h>
#include <moraine/points/bodies.h>

#include <memory>
#include <vector>

namespace moraine
{
  /** Of an implicit boundary, see Term::holds_mean_in(). */
  template <int dim>
  bool
  holds_mean_in(const StepContext<dim>                      &context,
                ImplicitBoundary<dim>                       &boundary,
                const typename GridSpace<dim>::CellIterator &cell);

  /** What an implicit boundary adds to the weak form; see Enforcement. */
  template <int dim>
  class BoundaryTerm : public ConstraintTerm<dim>
  {
  public:
    /** A force that held a place at the end of the last step. */
    struct HoldingPoint
    {
      unsigned int                    cell;   ///< active_cell_index()
      unsigned int                    number; ///< of the boundary's points
      dealii::Point<dim>              x;      ///< where the force has a moment
      dealii::Tensor<1, dim>          force;
      dealii::Tensor<1, dim>          normal;
      dealii::SymmetricTensor<2, dim> M;
      double                          area; ///< that a body is at
    };

    /** @p shapes of the bodies, null where the points are given: the boundary
     * ends where they do. Without any it holds all of its cells. */
    explicit BoundaryTerm(ImplicitBoundary<dim>     &boundary,
                          const ShapesOfBodies<dim> &shapes = {});

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind      = WorkKind::boundaries;
      is.timer          = "boundary pieces";
      is.watches_points = boundary.penetration_limit() > 0;
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    holds_mean_in(const StepContext<dim>                      &context,
                  const typename GridSpace<dim>::CellIterator &cell) override
    {
      return moraine::holds_mean_in(context, boundary, cell);
    }

    bool
    begin_step(const StepContext<dim> &context) override;

    void
    check_values(const StepContext<dim> &context) override;

    void
    begin_trial(const StepContext<dim> &context) override;

    void
    move_trial(const StepContext<dim> &context) override;

    void
    note_start(const StepContext<dim> &context) override;

    /** On a curved roller the force of the start would push along another
     * normal than that of the end: places that change hands would make of the
     * difference of both a moment about the centre of a circle. */
    bool
    acts_over_step(const StepContext<dim> &context) const override
    {
      return boundary.follows_curve() && context.motion &&
             context.motion->integrator().start_forces() > 0;
    }

    /** Along the mean of the normals at both ends, so that a wall at rest does
     * no work on what slides. */
    double
    work_of_step(const StepContext<dim> &context,
                 const double            of_force) const override;

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

    void
    add_constraint_forces(const StepContext<dim> &context,
                          const std::string      &name,
                          const LA::Vector &,
                          GlobalSystem<dim> &system) const override
    {
      if (name == boundary.name())
        add(context, false, system);
    }

    bool
    symmetric(const StepContext<dim> &context) const override;

    double
    rounded_length() const override
    {
      return boundary.rounded_length();
    }

    double
    violation(const StepContext<dim> &context) const override;

    void
    augment(const StepContext<dim> &context) override;

    std::string
    failure(const StepContext<dim>                    &context,
            const std::vector<dealii::Tensor<1, dim>> &moves) const override;

    void
    prepare(const StepContext<dim> &context,
            const LA::Vector       &unbalanced) override;

    void
    keep() noexcept override;

    void
    report(const StepContext<dim>           &context,
           std::vector<BoundaryReport<dim>> &reports) const override;

    const std::string &
    name() const
    {
      return boundary.name();
    }

    /** See BoundaryReport::moment. */
    double
    moment(const StepContext<dim>       &context,
           const dealii::Point<dim>     &x,
           const dealii::Tensor<1, dim> &force) const;

    /** Of this rank, cell by cell; places that let go are not among them. */
    const std::vector<HoldingPoint> &
    held() const
    {
      return holding_points;
    }

    /**
     * @f$\int |t|\,d\Gamma@f$ of forces of this boundary at places, without
     * what alternates between pieces, as multipliers do: @f$\sum_a |\sum_q N_a
     * f_q|@f$, the forces turned with their normals to the mean one at the
     * node; this rank's part. Collective.
     */
    double
    force_magnitude(const GridSpace<dim>            &space,
                    const std::vector<HoldingPoint> &places) const;

    /** Of the nodes of the cell, at such a place. */
    const double *
    functions(const HoldingPoint &place) const
    {
      return boundary.N(place.number);
    }

  private:
    /** Add what BoundarySlope says. */
    void
    add_slopes(const StepContext<dim> &context,
               const bool              tangent,
               GlobalSystem<dim>      &system) const;

    /** A slope in the trial state. */
    struct SlopeState
    {
      ConstraintState<dim>   constraint;
      Enforcement            how;
      dealii::Tensor<1, dim> du;       ///< what the trial increment has of it
      dealii::Tensor<1, dim> traction; ///< on the body
    };
    /** Of slope @p k; with @p share of what the step adds, so that in the
     * middle of it the slope keeps energy as a spring does. */
    SlopeState
    slope_state(const StepContext<dim> &context,
                const unsigned int      k,
                const double            share) const;

    /** Count moments and work of slopes among what is prepared.
     * @return the tractions */
    std::vector<dealii::Tensor<1, dim>>
    prepare_slopes(const StepContext<dim>                  &context,
                   const std::vector<ConstraintState<dim>> &states);

    /** Of the end of a step, or of the mean of both ends, as Motion counts
     * work: of point @p k, or after them, of a slope. */
    double
    work_of_motion(const unsigned int            k,
                   const dealii::Tensor<1, dim> &force,
                   const dealii::Tensor<1, dim> &prescribed) const;

    /** Let @p how, that of the boundary, be that in a cell. */
    void
    adapt_to_cell(const StepContext<dim> &context,
                  const unsigned int      cell,
                  Enforcement            &how) const;

    /** See depths_of_means; @p volumes are those of the points of this rank.
     * Collective. */
    void
    find_depths_of_means(const StepContext<dim>    &context,
                         const std::vector<double> &volumes);

    /** Tension and constraint of each point in the trial state. */
    void
    evaluate(const StepContext<dim>              &context,
             std::vector<dealii::Tensor<1, dim>> &tractions,
             std::vector<ConstraintState<dim>>   &states) const;

    /**
     * The largest depth of a point of this rank behind the boundary; with
     * @p moves of the points added to their positions unless it is empty.
     */
    double
    deepest_point(const StepContext<dim>                    &context,
                  const std::vector<dealii::Tensor<1, dim>> &moves) const;

    ImplicitBoundary<dim>    &boundary;
    ShapesOfBodies<dim>       shapes;
    BoundaryReport<dim>       prepared;
    std::vector<HoldingPoint> holding_points;
    /** Of points, then of slopes; none if the work of a step has none of them.
     */
    std::vector<dealii::Tensor<1, dim>> forces_at_start;
    /** By active_cell_index(), of the cells g with one mean:
     * @f$\sum_g \lambda V / \sum_g \lambda A@f$ with the volume V of points
     * and the area A of the boundary. Empty where means are not penalised. */
    std::vector<double> depths_of_means;
  };

  /** An implicit boundary that held and now absorbs: it holds nothing, but
   * cells count as filled as they did, so that forces in balance stay so. */
  template <int dim>
  class ReleasedBoundaryTerm : public Term<dim>
  {
  public:
    explicit ReleasedBoundaryTerm(ImplicitBoundary<dim> &boundary)
      : boundary(boundary)
    {}

    std::vector<Effect>
    effects(const StepContext<dim> &) const override
    {
      return {};
    }

    bool
    holds_mean_in(const StepContext<dim>                      &context,
                  const typename GridSpace<dim>::CellIterator &cell) override
    {
      return moraine::holds_mean_in(context, boundary, cell);
    }

  private:
    ImplicitBoundary<dim> &boundary;
  };
} // namespace moraine

#endif
