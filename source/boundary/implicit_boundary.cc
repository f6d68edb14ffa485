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
    , law(constraint)
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
    const Kind before = kind;
    kind              = kind_of_step(
      space.degree(), moves_points, measure, in_motion, through_cells);
    const bool changes = kind.holds_means != before.holds_means ||
                         kind.holds_slopes != before.holds_slopes;
    const bool moves      = moves_points && motion.moves();
    const auto body_moved = [&]() {
      return moves_points &&
             Utilities::MPI::logical_or(!body.is_still_so(covers),
                                        space.communicator());
    };
    if (found && !cells_changed && !moves && !changes && !body_moved())
      {
        for (auto &point : boundary_points)
          point.depth = point.h;
        if (kept_at_points)
          take_over(carried.places());
        return;
      }
    if (!placed_at || moves)
      place_at(t);
    body.ask(covers);
    cut          = SurfaceCut<dim>(space,
                          at_start,
                          search_tolerance,
                          body,
                          how.w_free == 0. && motion.moves(),
                          kind.holds_means);
    using Slopes = typename SurfaceCut<dim>::Slopes;
    if (kind.holds_means)
      cut.take_means(space,
                     !kind.holds_slopes                  ? Slopes::none :
                     law.kind == Constraint<dim>::roller ? Slopes::straight :
                                                           Slopes::all);
    take_points(space.communicator());
    kept_at_points = false;
    found          = true;
    ++searches;
  }



  template <int dim>
  typename ImplicitBoundary<dim>::Kind
  ImplicitBoundary<dim>::kind_of_step(const unsigned int  degree,
                                      const bool          moves_points,
                                      const StrainMeasure measure,
                                      const bool          in_motion,
                                      const bool          through_cells) const
  {
    const bool curved_roller = is_curved_roller();
    Kind       result;
    result.moves_with_points = moves_points;
    result.projects          = moves_points && curved_roller;
    result.turns_multiplier  = moves_points &&
                              measure == StrainMeasure::finite &&
                              law.kind == Constraint<dim>::fixed;
    result.holds_means  = how.holds_means(degree, curved_roller, in_motion);
    result.holds_slopes = result.holds_means && through_cells &&
                          how.slope_factor > 0 && !curved_roller;
    return result;
  }



  template <int dim>
  bool
  ImplicitBoundary<dim>::holds_mean_in(
    const GridSpace<dim>                        &space,
    const typename GridSpace<dim>::CellIterator &cell,
    const double                                 t)
  {
    if (!how.augments ||
        !how.holds_means(space.degree(), is_curved_roller(), false))
      return false;
    if (!placed_at || (motion.moves() && *placed_at != t))
      place_at(t);
    return cuts_across<dim>(at_start, cell);
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::take_points(const MPI_Comm &communicator)
  {
    largest_coordinate = 0;
    boundary_points.assign(cut.points.size(), {});
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        BoundaryPoint<dim> &point           = boundary_points[q];
        static_cast<CutPoint<dim> &>(point) = cut.points[q];
        point.depth                         = point.h;
        if (kind.projects)
          {
            point.level = at_start.level(point.x);
            largest_coordinate =
              std::max(largest_coordinate, coordinate_magnitude(point.x));
          }
      }
    if (kind.projects)
      largest_coordinate =
        Utilities::MPI::max(largest_coordinate, communicator);
    boundary_slopes.assign(cut.slopes.size(), {});
    for (unsigned int k = 0; k < boundary_slopes.size(); ++k)
      {
        BoundarySlope<dim>  &slope               = boundary_slopes[k];
        const CutSlope<dim> &of                  = cut.slopes[k];
        static_cast<BoundaryPoint<dim> &>(slope) = boundary_points[of.point];
        slope.point                              = of.point;
        slope.offset                             = of.offset;
      }
    const auto places =
      carried.handed_over(places_of_points(), kind.holds_means, communicator);
    if (!places.empty())
      take_over(places);
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
    for (auto &slope : boundary_slopes)
      slope.multiplier = turn * slope.multiplier_at_start;
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
    for (auto &slope : boundary_slopes)
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
        state.M = law.projection(state.normal);
      }
    else
      {
        state.normal    = point.normal;
        state.M         = law.projection(point.normal);
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
  void
  ImplicitBoundary<dim>::hold_in_cells(const AnswerForCell &points_hold,
                                       const AnswerForCell &slopes_hold)
  {
    for (auto &point : boundary_points)
      point.holds = points_hold(point.cell);
    for (auto &slope : boundary_slopes)
      slope.holds = points_hold(slope.cell) && slopes_hold(slope.cell);
  }



  template <int dim>
  Tensor<2, dim>
  ImplicitBoundary<dim>::from_frame() const
  {
    return law.kind == Constraint<dim>::roller ?
             at_start.pose().rotation() :
             Tensor<2, dim>(unit_symmetric_tensor<dim>());
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::take_over(const std::vector<CarriedPlace<dim>> &places)
  {
    const Tensor<2, dim> R         = from_frame();
    const Tensor<2, dim> into_pose = transpose(at_start.pose().rotation());
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        BoundaryPoint<dim> &point   = boundary_points[q];
        point.multiplier_at_start   = R * places[q].multiplier;
        point.accumulated_violation = R * places[q].violation;
        // It may come from a segment with another normal, and nothing but the
        // normal component is ever corrected.
        if (law.kind == Constraint<dim>::roller && !kind.projects)
          point.multiplier_at_start =
            law.projection(point.normal) * point.multiplier_at_start;
      }
    for (BoundarySlope<dim> &slope : boundary_slopes)
      slope.multiplier_at_start =
        R * places[slope.point].slope * (into_pose * slope.offset);
  }



  template <int dim>
  std::vector<CarriedPlace<dim>>
  ImplicitBoundary<dim>::places_of_points() const
  {
    const Placement<dim>          &pose       = at_start.pose();
    const Tensor<2, dim>           into_frame = transpose(pose.rotation());
    std::vector<CarriedPlace<dim>> places;
    for (const auto &point : boundary_points)
      places.push_back({Tensor<1, dim>(pose.inverse(point.x)),
                        {},
                        {},
                        {},
                        point.JxW,
                        into_frame * point.normal,
                        point.h,
                        {{point.cell, point.number}}});
    return places;
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::prepare(const std::vector<Tensor<1, dim>> &tractions,
                                 const std::vector<Tensor<1, dim>> &violations,
                                 const std::vector<Tensor<1, dim>> &of_slopes)
  {
    const Tensor<2, dim> into_frame = transpose(from_frame());
    const Tensor<2, dim> into_pose  = transpose(at_start.pose().rotation());
    auto                 places     = places_of_points();
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        const auto    &point      = boundary_points[q];
        Tensor<1, dim> multiplier = tractions[q];
        // In the next step a roller pushes other material at the same place.
        if (kind.projects)
          multiplier =
            std::copysign(multiplier.norm(), multiplier * point.normal) *
            point.normal;
        places[q].multiplier = into_frame * multiplier;
        if (how.carries_multiplier)
          places[q].violation =
            into_frame * (point.accumulated_violation + violations[q]);
      }
    for (unsigned int k = 0; k < of_slopes.size(); ++k)
      {
        const BoundarySlope<dim> &slope = boundary_slopes[k];
        places[slope.point].slope +=
          outer_product(into_frame * of_slopes[k], into_pose * slope.offset) /
          slope.offset.norm_square();
      }
    carried.prepare(std::move(places));
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::write(Archive &archive) const
  {
    const std::string group = "boundaries/" + boundary_name;
    archive.write(group + "/is_placed", placed_at ? 1u : 0u);
    archive.write(group + "/t_placed", placed_at.value_or(0.), "time");
    carried.write(archive, group);
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::read(const Archive &archive)
  {
    const std::string group = "boundaries/" + boundary_name;
    placed_at.reset();
    if (archive.integer(group + "/is_placed") != 0)
      place_at(archive.number(group + "/t_placed"));
    carried.read(archive, group);
    // The points are derived from that by the next begin_step().
    found = kept_at_points = false;
  }



  template class ImplicitBoundary<2>;
  template class ImplicitBoundary<3>;
} // namespace moraine
