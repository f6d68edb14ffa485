// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/boundary_term.h>

#include <moraine/assembly/boundary_force.h>
#include <moraine/assembly/boundary_piece.h>
#include <moraine/points/body_cover.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * With means of cells a flux has one change of volume in each,
     * @f$\theta@f$, which works against the mean of what is missed along the
     * normal; a penalty of @f$\lambda@f$ at every place would ask for more than
     * cells can follow, and lock. In dynamics it bounds flutter. The symmetric
     * form, @f$\lambda V (\theta - A \bar v / V)^2 - \lambda A^2 \bar v^2 /
     * V@f$, needs one of the mean @f$\bar v@f$.
     */
    template <int dim>
    bool
    has_lambda_in_means(const Enforcement &how, const StepContext<dim> &context)
    {
      return context.state.averages_volume() && !context.motion &&
             how.is_nitsche();
    }



    /** What the symmetric form needs over the depth of the material to be
     * definite at any cut: linear displacements need 1. */
    constexpr double least_factor = 4;



    /** @f$V_g/A_g@f$ of the group of a cell; of k groups of which it has a k-th
     * each, the inverse of the mean @f$A_g/V_g@f$, as the square of each
     * @f$A_g \bar v_g@f$ is bounded by itself.
     * @param sums of cells: volumes, then areas
     * @param without what to take if no group has an area */
    template <int dim>
    double
    depth_of_groups(const std::vector<typename CellMeans<dim>::Part> &parts,
                    const std::vector<double>                        &sums,
                    const double                                      without)
    {
      double       inverse  = 0;
      unsigned int n_groups = 0;
      for (auto part = parts.begin(); part != parts.end(); ++n_groups)
        {
          double volume = 0, area = 0;
          for (; part != parts.end() && part->group == n_groups; ++part)
            {
              volume += part->share * sums[part->cell];
              area += part->share * sums[sums.size() / 2 + part->cell];
            }
          if (area > 0)
            inverse += area / volume;
        }
      return inverse > 0 ? n_groups / inverse : without;
    }



    /** Whether points go far enough to come through cells. */
    template <int dim>
    bool
    points_pass_cells(const State<dim> &state)
    {
      return state.mesh_after_step() == MeshAfterStep::reset &&
             state.strain_measure() == StrainMeasure::finite;
    }



    /** Of the step, along the normal that turns: which the multiplier follows.
     */
    template <int dim>
    double
    turning_force(const BoundaryPoint<dim> &point, const double of_start)
    {
      Tensor<1, dim> multiplier = point.multiplier;
      if (of_start > 0)
        multiplier =
          (multiplier + of_start * point.multiplier_at_start) / (1. + of_start);
      return point.JxW * (multiplier * point.normal);
    }



    /** Of a place without functions, see evaluate_shapes(). */
    template <int dim>
    std::string
    why_no_place(const std::string &boundary, const Point<dim> &x)
    {
      std::ostringstream text;
      text << "boundary '" << boundary << "': the cell at (" << x
           << ") has folded there; where too little of it is filled to hold "
              "its nodes, a larger 'Aggregate below' in section 'Method' ties "
              "them";
      return text.str();
    }



    /** Of the points of this rank, by active_cell_index(). */
    template <int dim>
    std::vector<double>
    volumes_in_cells(const State<dim> &state)
    {
      std::vector<double> volumes(
        state.grid().mesh().triangulation().n_active_cells(), 0.);
      for (const auto &in_cell : state.material_points().cells())
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          volumes[in_cell.cell->active_cell_index()] +=
            state.integration_volume(p);
      return volumes;
    }
  } // namespace



  template <int dim>
  BoundaryTerm<dim>::BoundaryTerm(ImplicitBoundary<dim>     &boundary,
                                  const ShapesOfBodies<dim> &shapes)
    : boundary(boundary)
    , shapes(shapes)
  {}



  template <int dim>
  std::vector<Effect>
  BoundaryTerm<dim>::effects(const StepContext<dim> &context) const
  {
    const std::string &name = boundary.name();
    const std::string &how  = boundary.enforcement().name;
    return {{"implicit boundary " + name + " (" + how + ")",
             "boundary",
             name + ", " + boundary.constraint().name() + ", " + how + ", " +
               std::to_string(
                 boundary.n_points(context.state.grid().communicator())) +
               " quadrature points"}};
  }



  template <int dim>
  bool
  holds_mean_in(const StepContext<dim>                      &context,
                ImplicitBoundary<dim>                       &boundary,
                const typename GridSpace<dim>::CellIterator &cell)
  {
    return points_pass_cells(context.state) &&
           boundary.holds_mean_in(context.state.grid(), cell, context.t_start);
  }



  template <int dim>
  bool
  BoundaryTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    const bool moves_points =
      context.state.mesh_after_step() != MeshAfterStep::keep;
    typename BodyBehind<dim>::Covers covers;
    if (!shapes.empty())
      covers =
        BodyCover<dim>(context.state.material_points(), shapes, moves_points);
    boundary.begin_step(context.state.grid(),
                        context.t_start,
                        context.search_tolerance,
                        moves_points,
                        context.state.strain_measure(),
                        context.cells_moved,
                        context.motion != nullptr &&
                          context.motion->integrator().start_forces() == 0,
                        covers,
                        points_pass_cells(context.state));
    // A form that is not definite feeds what one step leaves to the next: in
    // vibrations, and as points move. Elsewhere the larger factor costs
    // accuracy for nothing; there it is what is needed.
    const Enforcement &how       = boundary.enforcement();
    const bool         symmetric = how.is_nitsche() && how.adjoint_sign > 0;
    const bool finite = context.state.strain_measure() == StrainMeasure::finite;
    depths_of_means.clear();
    forces_at_start.clear();
    if (!symmetric && !(how.is_nitsche() && context.motion))
      return false;
    const std::vector<double> volumes = volumes_in_cells(context.state);
    boundary.set_depths(volumes,
                        context.motion || finite ?
                          1. :
                          how.stiffness_factor / least_factor);
    if (symmetric && has_lambda_in_means(how, context))
      find_depths_of_means(context, volumes);
    return false;
  }



  template <int dim>
  void
  BoundaryTerm<dim>::find_depths_of_means(const StepContext<dim>    &context,
                                          const std::vector<double> &volumes)
  {
    const auto lambda = [&context](const unsigned int cell) {
      return context.cell_materials.elastic_stiffness(cell).lambda;
    };
    const unsigned int  n = volumes.size();
    std::vector<double> sums(2 * n, 0.);
    for (unsigned int cell = 0; cell < n; ++cell)
      sums[cell] = lambda(cell) * volumes[cell];
    for (const auto &point : boundary.points())
      sums[n + point.cell] += lambda(point.cell) * point.JxW;
    Utilities::MPI::sum(sums, context.state.grid().communicator(), sums);

    std::vector<typename CellMeans<dim>::Part> parts;
    depths_of_means.assign(n, 0.);
    for (const auto &point : boundary.points())
      if (depths_of_means[point.cell] == 0)
        {
          context.state.mean_of_cell(point.cell, parts);
          depths_of_means[point.cell] =
            std::max(depth_of_groups<dim>(parts, sums, point.h),
                     ImplicitBoundary<dim>::smallest_depth * point.h);
        }
  }



  template <int dim>
  void
  BoundaryTerm<dim>::check_values(const StepContext<dim> &context)
  {
    boundary.check_value(context.t_end);
  }



  template <int dim>
  void
  BoundaryTerm<dim>::begin_trial(const StepContext<dim> &context)
  {
    boundary.set_target(context.t_end);
  }



  template <int dim>
  void
  BoundaryTerm<dim>::move_trial(const StepContext<dim> &context)
  {
    boundary.move_target(context.t_end);
  }



  template <int dim>
  bool
  BoundaryTerm<dim>::symmetric(const StepContext<dim> &context) const
  {
    // At finite strain a flux and its adjoint refer to different places.
    const Enforcement &how = boundary.enforcement();
    return !acts_over_step(context) &&
           (how.w_free == 0 ||
            (context.state.strain_measure() == StrainMeasure::small &&
             how.adjoint_sign > 0));
  }



  template <int dim>
  void
  BoundaryTerm<dim>::adapt_to_cell(const StepContext<dim> &context,
                                   const unsigned int      cell,
                                   Enforcement            &how) const
  {
    if (!has_lambda_in_means(how, context))
      return;
    how.lambda_share = 0;
    if (!depths_of_means.empty())
      how.mean_factor =
        context.cell_materials.elastic_stiffness(cell).lambda > 0 ?
          std::max(how.stiffness_factor, least_factor) / depths_of_means[cell] :
          0.;
  }



  template <int dim>
  void
  BoundaryTerm<dim>::add(const StepContext<dim> &context,
                         const bool              tangent,
                         GlobalSystem<dim>      &system) const
  {
    LocalSystem<dim>            local;
    BoundaryPiece<dim>          piece;
    std::vector<Tensor<1, dim>> fluxes;
    const auto                 &points   = boundary.points();
    Enforcement                 how      = boundary.enforcement();
    const double                of_start = this->share_of_start(context);
    for (unsigned int q = 0; q < points.size();)
      {
        piece.reinit(boundary, context, q, context.share_of_push());
        const LameConstants &C =
          context.cell_materials.elastic_stiffness(piece.cell());
        adapt_to_cell(context, piece.cell(), how);
        local.reinit(context.state,
                     piece.nodes().data(),
                     piece.nodes().size(),
                     tangent);
        for (; q < piece.end(); ++q)
          {
            piece.set_place(q);
            if (!std::isfinite(piece.N[0]) && local.failure.empty())
              local.failure = why_no_place(boundary.name(), points[q].x);
            add_boundary_point(piece,
                               q,
                               of_start,
                               how,
                               C,
                               context.state.strain_measure(),
                               tangent,
                               fluxes,
                               local);
            // A multiplier turns with the normal of a curved wall. Of the
            // penalty that is left out: before a step has found its way it is
            // large.
            if (tangent && boundary.follows_curve() && points[q].holds &&
                points[q].multiplier.norm_square() > 0.)
              local.add_stiffness(piece.N.data(),
                                  -turning_force(points[q], of_start) *
                                    boundary.surface_at_end().normal_gradient(
                                      points[q].x + piece.increment(q).value,
                                      points[q].h));
          }
        if (tangent && how.mean_factor > 0)
          add_mean_penalty(piece, how, C, local);
        system.add(local, tangent);
      }
    add_slopes(context, tangent, system);
  }



  template <int dim>
  void
  BoundaryTerm<dim>::evaluate(const StepContext<dim>            &context,
                              std::vector<Tensor<1, dim>>       &tractions,
                              std::vector<ConstraintState<dim>> &states) const
  {
    const auto        &points = boundary.points();
    BoundaryPiece<dim> piece;
    Enforcement        how = boundary.enforcement();
    tractions.resize(points.size());
    states.resize(points.size());
    for (unsigned int q = 0; q < points.size();)
      {
        piece.reinit(boundary, context, q, context.share_of_step());
        adapt_to_cell(context, piece.cell(), how);
        for (; q < piece.end(); ++q)
          {
            states[q] = piece.constraint(q);
            tractions[q] =
              boundary_traction(piece,
                                q,
                                how,
                                context.cell_materials.elastic_stiffness(
                                  piece.cell()),
                                context.state.strain_measure());
          }
      }
  }



  template <int dim>
  double
  BoundaryTerm<dim>::violation(const StepContext<dim> &context) const
  {
    if (!boundary.enforcement().augments)
      return 0.;
    std::vector<Tensor<1, dim>>       tractions;
    std::vector<ConstraintState<dim>> states;
    evaluate(context, tractions, states);
    double largest = 0;
    for (const auto &state : states)
      largest = std::max(largest, state.violation.norm());
    return largest;
  }



  template <int dim>
  void
  BoundaryTerm<dim>::augment(const StepContext<dim> &context)
  {
    if (!boundary.enforcement().augments)
      return;
    std::vector<Tensor<1, dim>>       multipliers;
    std::vector<ConstraintState<dim>> states;
    evaluate(context, multipliers, states);
    // Along the normal of the start, as multipliers are.
    for (unsigned int q = 0; q < boundary.points().size(); ++q)
      {
        const BoundaryPoint<dim> &point = boundary.points()[q];
        multipliers[q]                  = point.multiplier;
        if (point.holds)
          multipliers[q] -=
            penalty(boundary.enforcement(),
                    point.depth,
                    point.normal,
                    boundary.constraint().projection(point.normal),
                    context.cell_materials.elastic_stiffness(point.cell)) *
            states[q].violation;
      }
    boundary.set_multipliers(multipliers);
  }



  template <int dim>
  void
  BoundaryTerm<dim>::add_slopes(const StepContext<dim> &context,
                                const bool              tangent,
                                GlobalSystem<dim>      &system) const
  {
    const GridSpace<dim> &space = context.state.grid();
    LocalSystem<dim>      local;
    for (unsigned int k = 0; k < boundary.slopes().size(); ++k)
      {
        const auto      &slope = boundary.slopes()[k];
        const SlopeState now = slope_state(context, k, context.share_of_step());
        local.reinit(context.state,
                     space.cell_nodes(slope.cell),
                     space.nodes_per_cell(),
                     tangent);
        local.add_force(boundary.slope_of_N(k), slope.JxW * now.traction);
        if (tangent)
          local.add_stiffness(
            boundary.slope_of_N(k),
            slope.JxW *
              penalty(now.how,
                      slope.depth,
                      slope.normal,
                      now.constraint.M,
                      context.cell_materials.elastic_stiffness(slope.cell)));
        system.add(local, tangent);
      }
  }



  template <int dim>
  typename BoundaryTerm<dim>::SlopeState
  BoundaryTerm<dim>::slope_state(const StepContext<dim> &context,
                                 const unsigned int      k,
                                 const double            share) const
  {
    const GridSpace<dim> &space = context.state.grid();
    const auto           &slope = boundary.slopes()[k];
    Tensor<1, dim>        du;
    for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
      du += boundary.slope_of_N(k)[a] *
            context.increments()[space.cell_nodes(slope.cell)[a]];
    SlopeState state{boundary.constraint_state(slope, du, 1.),
                     boundary.enforcement().of_slopes(share),
                     du,
                     {}};
    state.traction =
      boundary_traction(slope,
                        state.constraint,
                        state.how,
                        context.cell_materials.elastic_stiffness(slope.cell),
                        context.state.strain_measure(),
                        Tensor<2, dim>(),
                        Tensor<2, dim>());
    return state;
  }



  template <int dim>
  std::string
  BoundaryTerm<dim>::failure(const StepContext<dim>            &context,
                             const std::vector<Tensor<1, dim>> &moves) const
  {
    return boundary.penetration_limit() > 0 &&
               deepest_point(context, moves) >
                 boundary.penetration_limit() *
                   context.state.grid().mesh().cell_size() ?
             "a point would end behind a boundary" :
             "";
  }



  template <int dim>
  void
  BoundaryTerm<dim>::keep() noexcept
  {
    boundary.keep();
  }



#define INSTANTIATE(dim)                                    \
  template decltype(holds_mean_in<dim>) holds_mean_in<dim>; \
  template class BoundaryTerm<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
