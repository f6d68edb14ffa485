// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Forces, moments, work and depths of implicit boundaries.

#include <moraine/assembly/boundary_piece.h>
#include <moraine/assembly/boundary_term.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  BoundaryTerm<dim>::note_start(const StepContext<dim> &context)
  {
    if (context.share_of_step() < 1.)
      return;
    std::vector<ConstraintState<dim>> states;
    evaluate(context, forces_at_start, states);
    for (unsigned int q = 0; q < forces_at_start.size(); ++q)
      forces_at_start[q] *= boundary.points()[q].JxW;
    for (unsigned int k = 0; k < boundary.slopes().size(); ++k)
      forces_at_start.push_back(boundary.slopes()[k].JxW *
                                slope_state(context, k, 1.).traction);
  }



  template <int dim>
  double
  BoundaryTerm<dim>::work_of_motion(const unsigned int    k,
                                    const Tensor<1, dim> &force,
                                    const Tensor<1, dim> &prescribed) const
  {
    if (forces_at_start.empty())
      return force * prescribed;
    return 0.5 * (forces_at_start[k] + force) * prescribed;
  }



  template <int dim>
  double
  BoundaryTerm<dim>::work_of_step(const StepContext<dim> &context,
                                  const double            of_force) const
  {
    const auto                       &points   = boundary.points();
    const double                      of_start = this->share_of_start(context);
    std::vector<Tensor<1, dim>>       tractions;
    std::vector<ConstraintState<dim>> states;
    evaluate(context, tractions, states);
    BoundaryPiece<dim> piece;
    double             work = of_force;
    for (unsigned int q = 0; q < points.size();)
      for (piece.reinit(boundary, context, q, context.share_of_push());
           q < piece.end();
           ++q)
        {
          const BoundaryPoint<dim> &point  = points[q];
          const Tensor<1, dim>     &normal = states[q].normal;
          Tensor<1, dim>            mean   = normal + point.normal;
          mean /= mean.norm();
          const double force =
            point.JxW * (tractions[q] * normal +
                         of_start * (point.multiplier_at_start * point.normal));
          work += force * (mean - piece.constraint(q).push) *
                  piece.increment(q).value;
        }
    return context.motion->integrator().divisor() * work;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  BoundaryTerm<dim>::prepare_slopes(
    const StepContext<dim>                  &context,
    const std::vector<ConstraintState<dim>> &states)
  {
    const double                share = context.share_of_step();
    std::vector<Tensor<1, dim>> tractions;
    for (unsigned int k = 0; k < boundary.slopes().size(); ++k)
      {
        const BoundarySlope<dim> &slope = boundary.slopes()[k];
        const Point<dim>         &place = states[slope.point].place;
        // Where it moved to, if the place did.
        Tensor<1, dim> arm = slope.offset;
        if (context.balances_at_end())
          arm += share * slope_state(context, k, share).du;
        tractions.push_back(slope_state(context, k, 1.).traction);
        const Tensor<1, dim> force =
          slope.JxW * slope_state(context, k, share).traction;
        prepared.work_of_motion +=
          work_of_motion(states.size() + k, force, slope.prescribed);
        prepared.moment +=
          moment(context, place + arm, force) - moment(context, place, force);
      }
    return tractions;
  }



  template <int dim>
  double
  BoundaryTerm<dim>::deepest_point(
    const StepContext<dim>            &context,
    const std::vector<Tensor<1, dim>> &moves) const
  {
    const PointSet<dim> &points  = context.state.material_points();
    const double         range   = 2 * context.state.grid().mesh().cell_size();
    const auto          &surface = boundary.surface_at_end();
    const auto           place   = [&](const unsigned int p) {
      return moves.empty() ? points.position(p) : points.position(p) + moves[p];
    };
    double deepest = 0;
    for (const auto &in_cell : points.cells())
      {
        const Point<dim> centre = place(in_cell.first);
        double           radius = range;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          radius = std::max(radius, range + centre.distance(place(p)));
        // The level of an expression is an estimate, hence a factor.
        if (std::abs(surface.level(centre)) <= 2 * radius)
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            {
              const double depth = -surface.level(place(p));
              if (depth > deepest && depth < range &&
                  surface.in_extent(place(p)))
                deepest = depth;
            }
      }
    return Utilities::MPI::max(deepest, context.state.grid().communicator());
  }



  template <int dim>
  void
  BoundaryTerm<dim>::prepare(const StepContext<dim> &context,
                             const LA::Vector &)
  {
    const MPI_Comm communicator = context.state.grid().communicator();
    std::vector<Tensor<1, dim>>       tractions, violations;
    std::vector<ConstraintState<dim>> states;
    evaluate(context, tractions, states);
    for (unsigned int q = 0; !context.balances_at_end() && q < states.size();
         ++q)
      states[q].place = boundary.points()[q].x;
    prepared = {boundary.name(), {}, 0., 0., 0., 0.};
    holding_points.clear();
    for (unsigned int q = 0; q < tractions.size(); ++q)
      {
        const auto          &point = boundary.points()[q];
        const Tensor<1, dim> force = point.JxW * tractions[q];
        prepared.reaction += force;
        prepared.work_of_motion += work_of_motion(q, force, point.prescribed);
        prepared.moment += moment(context, states[q].place, force);
        prepared.violation =
          std::max(prepared.violation, states[q].violation.norm());
        violations.push_back(states[q].violation);
        holding_points.push_back({point.cell,
                                  q,
                                  states[q].place,
                                  force,
                                  states[q].normal,
                                  states[q].M,
                                  point.body_area});
      }
    prepared.force_magnitude =
      force_magnitude(context.state.grid(), holding_points);
    holding_points.erase(
      std::remove_if(holding_points.begin(),
                     holding_points.end(),
                     [this](const HoldingPoint &place) {
                       return !boundary.points()[place.number].holds;
                     }),
      holding_points.end());
    const auto of_slopes = prepare_slopes(context, states);
    sum_over_ranks(prepared, communicator);
    prepared.violation = Utilities::MPI::max(prepared.violation, communicator);
    boundary.prepare(tractions, violations, of_slopes);
  }



  template <int dim>
  double
  BoundaryTerm<dim>::moment(const StepContext<dim> &context,
                            const Point<dim>       &x,
                            const Tensor<1, dim>   &force) const
  {
    const RigidMotion<dim> &motion = boundary.rigid_motion();
    return motion.moment(x,
                         force,
                         context.balances_at_end() ?
                           motion.pose(context.t_end) :
                           boundary.surface_at_start().pose());
  }



  template <int dim>
  void
  BoundaryTerm<dim>::report(const StepContext<dim>           &context,
                            std::vector<BoundaryReport<dim>> &reports) const
  {
    reports.push_back(prepared);
    reports.back().penetration = deepest_point(context, {});
  }



  template <int dim>
  double
  BoundaryTerm<dim>::force_magnitude(
    const GridSpace<dim>            &space,
    const std::vector<HoldingPoint> &places) const
  {
    // Further apart normals are those of two sides of a body.
    constexpr double cosine_of_one_side = 0.87;

    const unsigned int n            = space.nodes_per_cell();
    const auto         sum_at_nodes = [&](const auto &value) {
      std::vector<Tensor<1, dim>> sums(space.n_nodes());
      for (const HoldingPoint &place : places)
        for (unsigned int a = 0; a < n; ++a)
          {
            const unsigned int node = space.cell_nodes(place.cell)[a];
            sums[node] += functions(place)[a] * value(place, node);
          }
      space.sum_over_ranks(sums);
      return sums;
    };
    const auto normals =
      sum_at_nodes([&](const HoldingPoint &place, const unsigned int) {
        return boundary.points()[place.number].JxW * place.normal;
      });
    const auto is_apart = [&](const HoldingPoint &place,
                              const unsigned int  node) {
      return normals[node] * place.normal <=
             cosine_of_one_side * normals[node].norm();
    };
    const auto forces =
      sum_at_nodes([&](const HoldingPoint &place, const unsigned int node) {
        return is_apart(place, node) ?
                 Tensor<1, dim>() :
                 turned<dim>(place.force,
                             place.normal,
                             normals[node] / normals[node].norm());
      });
    double magnitude = 0;
    for (unsigned int node = 0; node < forces.size(); ++node)
      if (space.locally_owned().is_element(space.node_dof(node)))
        magnitude += forces[node].norm();
    for (const HoldingPoint &place : places)
      for (unsigned int a = 0; a < n; ++a)
        if (is_apart(place, space.cell_nodes(place.cell)[a]))
          magnitude += std::abs(functions(place)[a]) * place.force.norm();
    return magnitude;
  }



#define INSTANTIATE(dim)                                                        \
  template void   BoundaryTerm<dim>::note_start(const StepContext<dim> &);      \
  template double BoundaryTerm<dim>::work_of_step(const StepContext<dim> &,     \
                                                  const double) const;          \
  template void   BoundaryTerm<dim>::prepare(const StepContext<dim> &,          \
                                           const LA::Vector &);               \
  template double BoundaryTerm<dim>::moment(const StepContext<dim> &,           \
                                            const Point<dim> &,                 \
                                            const Tensor<1, dim> &) const;      \
  template void   BoundaryTerm<dim>::report(const StepContext<dim> &,           \
                                          std::vector<BoundaryReport<dim>> &) \
    const;                                                                      \
  template double BoundaryTerm<dim>::deepest_point(                             \
    const StepContext<dim> &, const std::vector<Tensor<1, dim>> &) const;       \
  template double BoundaryTerm<dim>::force_magnitude(                           \
    const GridSpace<dim> &, const std::vector<HoldingPoint> &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
