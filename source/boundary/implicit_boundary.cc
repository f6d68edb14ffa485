// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/implicit_boundary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  SymmetricTensor<2, dim>
  Constraint<dim>::projection(const Tensor<1, dim> &normal) const
  {
    SymmetricTensor<2, dim> M;
    if (kind == roller)
      M = symmetrize(outer_product(normal, normal));
    else
      for (unsigned int d = 0; d < dim; ++d)
        M[d][d] = (kind == fixed || component[d]) ? 1. : 0.;
    return M;
  }



  template <int dim>
  ImplicitBoundary<dim>::ImplicitBoundary(
    const std::string                  &name,
    std::shared_ptr<const Surface<dim>> surface,
    const RigidMotion<dim>             &motion,
    const Displacement                 &displacement,
    const Constraint<dim>              &constraint,
    const Enforcement                  &enforcement,
    const double                        penetration_limit)
    : boundary_name(name)
    , at_start(surface)
    , at_end(surface)
    , motion(motion)
    , displacement(displacement)
    , constraint(constraint)
    , how(enforcement)
    , limit(penetration_limit)
  {}



  template <int dim>
  void
  ImplicitBoundary<dim>::begin_step(
    const GridSpace<dim>                   &space,
    const double                            t,
    const double                            search_tolerance,
    const bool                              moves_points,
    const StrainMeasure                     measure,
    const bool                              cells_changed,
    const bool                              in_motion,
    const typename BodyBehind<dim>::Covers &covers,
    const bool                              through_cells)
  {
    t_start = t;
    at_start.see_over(space.mesh().cell_size());
    at_end.see_over(space.mesh().cell_size());
    const bool curved_roller = is_curved_roller();
    const Kind before        = kind;
    kind                     = {moves_points,
                                moves_points && curved_roller,
                                moves_points && measure == StrainMeasure::finite &&
                                  constraint.kind == Constraint<dim>::fixed,
                                how.holds_means(space.degree(), curved_roller, in_motion),
                                false};
    kind.holds_slopes        = kind.holds_means && through_cells &&
                        how.slope_factor > 0 && !curved_roller;
    const bool changes = kind.holds_means != before.holds_means ||
                         kind.holds_slopes != before.holds_slopes;
    const bool moves      = moves_points && motion.moves();
    const auto body_moved = [&]() {
      return moves_points &&
             Utilities::MPI::logical_or(!body.is_still_so(covers),
                                        space.communicator());
    };
    if (search.done && !cells_changed && !moves && !changes && !body_moved())
      {
        for (auto &point : boundary_points)
          point.depth = point.h;
        if (kept_at_points)
          take_over(carried);
        return;
      }
    if (!placed_at || moves)
      place_at(t);
    boundary_points.clear();
    held_slopes = {};
    body.ask(covers);
    find_pieces(space, search_tolerance);
    body.stop_asking();
    // Away from all bodies it holds what its cells have of them.
    if (n_points(space.communicator()) == 0)
      find_pieces(space, search_tolerance);
    evaluate_shapes(space);
    if (kind.holds_means)
      take_means(space);
    number_points();
    if (kind.projects)
      find_levels(space.communicator());
    take_over_nearest(space.communicator());
    kept_at_points = false;
    search.done    = true;
    ++search.number;
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::find_levels(const MPI_Comm &communicator)
  {
    largest_coordinate = 0;
    for (auto &point : boundary_points)
      {
        point.level = at_start.level(point.x);
        largest_coordinate =
          std::max(largest_coordinate, coordinate_magnitude(point.x));
      }
    largest_coordinate = Utilities::MPI::max(largest_coordinate, communicator);
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::set_depths(const std::vector<double> &volumes,
                                    const double               share)
  {
    for (unsigned int begin = 0, end = 0; begin < boundary_points.size();
         begin = end)
      {
        const unsigned int cell = boundary_points[begin].cell;
        double             area = 0;
        for (;
             end < boundary_points.size() && boundary_points[end].cell == cell;
             ++end)
          area += boundary_points[end].JxW;
        const double h     = boundary_points[begin].h;
        const double depth = std::max(volumes[cell] / area, smallest_depth * h);
        for (unsigned int q = begin; q < end; ++q)
          boundary_points[q].depth = std::min(share * depth, h);
      }
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::set_target(const double t_end)
  {
    move_target(t_end);
    const Tensor<2, dim> turn  = kind.turns_multiplier ?
                                   motion.pose(t_end).rotation() *
                                    transpose(motion.pose(t_start).rotation()) :
                                   Tensor<2, dim>(unit_symmetric_tensor<dim>());
    const bool           takes = how.carries_multiplier || t_end == t_start;
    for (auto &point : boundary_points)
      point.multiplier =
        takes ? turn * point.multiplier_at_start : Tensor<1, dim>();
    for (auto &slope : held_slopes.all)
      slope.traction = turn * slope.traction_at_start;
  }



  template <int dim>
  Tensor<1, dim>
  ImplicitBoundary<dim>::increment_at(const Point<dim>     &x,
                                      const double          t_0,
                                      const Placement<dim> &pose_0,
                                      const double          t_1,
                                      const Placement<dim> &pose_1) const
  {
    const Point<dim> X = at_start.pose().inverse(x);
    return (pose_1.map(X) - pose_0.map(X)) + displacement(x, t_1) -
           displacement(x, t_0);
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::check_value(const double t) const
  {
    const Placement<dim> pose = motion.pose(t);
    if (!boundary_points.empty())
      increment_at(
        boundary_points.front().x, t_start, motion.pose(t_start), t, pose);
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::move_target(const double t_end)
  {
    const Placement<dim> start = motion.pose(t_start), end = motion.pose(t_end);
    at_end.set_pose(kind.moves_with_points ? end : at_start.pose());
    for (auto &point : boundary_points)
      point.prescribed = increment_at(point.x, t_start, start, t_end, end);
    for (auto &slope : held_slopes.all)
      {
        const Point<dim> &x = boundary_points[slope.point].x;
        slope.prescribed =
          0.5 * (increment_at(x + slope.offset, t_start, start, t_end, end) -
                 increment_at(x - slope.offset, t_start, start, t_end, end));
      }
  }



  template <int dim>
  ConstraintState<dim>
  ImplicitBoundary<dim>::constraint_state(const BoundaryPoint<dim> &point,
                                          const Tensor<1, dim>     &du,
                                          const double              share) const
  {
    ConstraintState<dim> state;
    state.place =
      point.x + (kind.moves_with_points ? share * du : point.prescribed);
    if (!point.holds)
      {
        state.normal = state.push = point.normal;
        return state;
      }
    if (kind.projects)
      {
        const Point<dim> x_end = point.x + du;
        state.normal           = at_end.normal(x_end);
        const Tensor<1, dim> relative =
          point.prescribed -
          (at_end.pose().map(at_start.pose().inverse(point.x)) - point.x);
        state.violation =
          (point.level - at_end.level(x_end) - relative * state.normal) *
          state.normal;
        state.M = constraint.projection(state.normal);
      }
    else
      {
        state.normal    = point.normal;
        state.M         = constraint.projection(point.normal);
        state.violation = state.M * (du - point.prescribed);
      }
    state.push = state.normal;
    if (kind.projects && share < 1.)
      {
        state.push = share * state.normal + (1. - share) * point.normal;
        state.push /= state.push.norm();
      }
    return state;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  ImplicitBoundary<dim>::normal_gradient(const BoundaryPoint<dim> &point,
                                         const Tensor<1, dim>     &du) const
  {
    if (!kind.projects || !point.holds)
      return {};
    const double   step = 1e-4 * point.h;
    Tensor<2, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> ahead = step * Point<dim>::unit_vector(d);
        gradient[d]                = (at_end.normal(point.x + du + ahead) -
                       at_end.normal(point.x + du - ahead)) /
                      (2 * step);
      }
    constexpr double corner = 4;
    return gradient.norm() * point.h < corner ? symmetrize(gradient) :
                                                SymmetricTensor<2, dim>();
  }



  template <int dim>
  PrescribedIncrements<dim>
  ImplicitBoundary<dim>::increments_between(
    const std::vector<double> &times) const
  {
    std::vector<Placement<dim>> poses;
    for (const double t : times)
      poses.push_back(motion.pose(t));
    return [this, times, poses](const Point<dim> &x) {
      std::vector<Tensor<1, dim>> increments;
      for (unsigned int k = 1; k < times.size(); ++k)
        increments.push_back(
          increment_at(x, times[k - 1], poses[k - 1], times[k], poses[k]));
      return increments;
    };
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::set_multipliers(
    const std::vector<Tensor<1, dim>> &multipliers)
  {
    AssertDimension(multipliers.size(), boundary_points.size());
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      boundary_points[q].multiplier = multipliers[q];
  }



  template <int dim>
  unsigned int
  ImplicitBoundary<dim>::n_points(const MPI_Comm &communicator) const
  {
    return Utilities::MPI::sum<unsigned int>(boundary_points.size(),
                                             communicator);
  }



  template <int dim>
  std::string
  ImplicitBoundary<dim>::constraint_name() const
  {
    if (constraint.kind != Constraint<dim>::components)
      return constraint.kind == Constraint<dim>::fixed ? "fixed" : "roller";
    std::string components;
    for (unsigned int d = 0; d < dim; ++d)
      if (constraint.component[d])
        components +=
          (components.empty() ? "" : ", ") + std::string(1, "xyz"[d]);
    return components;
  }



  template struct Constraint<2>;
  template struct Constraint<3>;
  template class ImplicitBoundary<2>;
  template class ImplicitBoundary<3>;
} // namespace moraine
