// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of MechanicsSystem that knows implicit boundaries.

#include <moraine/assembly/mechanics_system.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Value and gradient of the trial increment at a place of a boundary. */
    template <int dim>
    std::pair<Tensor<1, dim>, Tensor<2, dim>>
    increment_at(const std::vector<Tensor<1, dim>> &nodal,
                 const unsigned int                *nodes,
                 const unsigned int                 n_nodes,
                 const double                      *N,
                 const Tensor<1, dim>              *grad_N)
    {
      Tensor<1, dim> du;
      Tensor<2, dim> grad_du;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const Tensor<1, dim> &u = nodal[nodes ? nodes[a] : a];
          du += N[a] * u;
          grad_du += outer_product(u, grad_N[a]);
        }
      return {du, grad_du};
    }
  } // namespace



  template <int dim>
  void
  MechanicsSystem<dim>::assemble_boundaries(const bool tangent)
  {
    LocalSystem<dim>      local;
    const GridSpace<dim> &space = state.grid();
    const unsigned int    n     = space.nodes_per_cell();
    for (const auto &boundary : boundaries)
      {
        const auto &points = boundary.points();
        for (unsigned int begin = 0, end = 0; begin < points.size();
             begin = end)
          {
            const unsigned int  cell  = points[begin].cell;
            const unsigned int *nodes = space.cell_nodes(cell);
            local.reinit(state, nodes, n, tangent);
            for (; end < points.size() && points[end].cell == cell; ++end)
              {
                const auto [du, grad_du] =
                  increment_at<dim>(local.nodal_increments,
                                    nullptr,
                                    n,
                                    boundary.N(end),
                                    boundary.grad_N(end));
                add_boundary_point(
                  points[end],
                  boundary.constraint_state(points[end], du),
                  boundary.enforcement(),
                  state.material(body_of_cell[cell]).elastic_stiffness(),
                  state.strain_measure(),
                  boundary.N(end),
                  boundary.grad_N(end),
                  grad_du,
                  tangent,
                  local);
              }
            add_to_system(local, tangent);
          }
      }
  }



  template <int dim>
  void
  MechanicsSystem<dim>::boundary_state(
    const ImplicitBoundary<dim> &boundary,
    std::vector<Tensor<1, dim>> &tractions,
    std::vector<Tensor<1, dim>> &violations) const
  {
    const GridSpace<dim> &space  = state.grid();
    const auto           &points = boundary.points();
    tractions.resize(points.size());
    violations.resize(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const auto [du, grad_du] =
          increment_at<dim>(state.nodal_increments(),
                            space.cell_nodes(points[q].cell),
                            space.nodes_per_cell(),
                            boundary.N(q),
                            boundary.grad_N(q));
        const auto constraint = boundary.constraint_state(points[q], du);
        violations[q]         = constraint.violation;
        tractions[q]          = boundary_traction(
          points[q],
          constraint,
          boundary.enforcement(),
          state.material(body_of_cell[points[q].cell]).elastic_stiffness(),
          state.strain_measure(),
          grad_du);
      }
  }



  template <int dim>
  bool
  MechanicsSystem<dim>::augment(const LA::Vector &x)
  {
    const MPI_Comm communicator = state.grid().communicator();
    state.set_trial(x);
    double violation = 0, motion = 0;
    for (const auto &u : state.nodal_increments())
      motion = std::max(motion, u.norm());

    std::vector<Tensor<1, dim>> tractions, violations;
    for (auto &boundary : boundaries)
      if (boundary.enforcement().augments)
        {
          boundary_state(boundary, tractions, violations);
          for (const auto &v : violations)
            violation = std::max(violation, v.norm());
        }
    violation = Utilities::MPI::max(violation, communicator);
    motion    = Utilities::MPI::max(motion, communicator);
    // Stop when the constraint holds to round-off or gets no better.
    if (violation <= 1e-14 * motion || violation > 0.5 * last_violation)
      return false;
    last_violation = violation;

    for (auto &boundary : boundaries)
      if (boundary.enforcement().augments)
        {
          boundary_state(boundary, tractions, violations);
          Enforcement no_flux   = boundary.enforcement();
          no_flux.w_constrained = no_flux.w_free = 0;
          for (unsigned int q = 0; q < boundary.points().size(); ++q)
            {
              auto                &point = boundary.points()[q];
              ConstraintState<dim> constraint;
              constraint.normal    = point.normal;
              constraint.violation = violations[q];
              constraint.M         = boundary.projection(point.normal);
              point.reaction       = boundary_traction(
                point,
                constraint,
                no_flux,
                state.material(body_of_cell[point.cell]).elastic_stiffness(),
                state.strain_measure(),
                Tensor<2, dim>());
            }
        }
    return true;
  }



  template <int dim>
  std::vector<unsigned int>
  MechanicsSystem<dim>::n_boundary_points() const
  {
    std::vector<unsigned int> n;
    for (const auto &boundary : boundaries)
      n.push_back(
        Utilities::MPI::sum<unsigned int>(boundary.points().size(),
                                          state.grid().communicator()));
    return n;
  }



  template <int dim>
  double
  MechanicsSystem<dim>::deepest_point(
    const ImplicitBoundary<dim>       &boundary,
    const std::vector<Tensor<1, dim>> &moves) const
  {
    const PointSet<dim> &points = state.material_points();
    const double         range  = 2 * state.grid().mesh().cell_size();
    const auto           place  = [&](const unsigned int p) {
      return moves.empty() ? points.position(p) : points.position(p) + moves[p];
    };
    double deepest = 0;
    for (const auto &in_cell : points.cells())
      {
        const Point<dim> centre = place(in_cell.first);
        double           radius = range;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          radius = std::max(radius, range + centre.distance(place(p)));
        if (!boundary.is_far(centre, radius))
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            deepest = std::max(deepest, boundary.penetration(place(p), range));
      }
    return deepest;
  }



  template <int dim>
  double
  MechanicsSystem<dim>::worst_penetration_over_limit(const LA::Vector &x)
  {
    double worst = 0;
    if (std::none_of(boundaries.begin(), boundaries.end(), [](const auto &b) {
          return b.penetration_limit() > 0;
        }))
      return worst;
    state.set_trial(x);
    const double h          = state.grid().mesh().cell_size();
    const auto   increments = state.point_increments();
    for (const auto &boundary : boundaries)
      if (boundary.penetration_limit() > 0)
        worst = std::max(worst,
                         deepest_point(boundary, increments) /
                           (boundary.penetration_limit() * h));
    return Utilities::MPI::max(worst, state.grid().communicator());
  }



  template <int dim>
  std::vector<BoundaryReport<dim>>
  MechanicsSystem<dim>::report_boundaries()
  {
    std::vector<BoundaryReport<dim>> reports;
    std::vector<Tensor<1, dim>>      tractions, violations;
    for (auto &boundary : boundaries)
      {
        boundary_state(boundary, tractions, violations);
        BoundaryReport<dim> report{boundary.name(), {}, 0., 0., 0., 0.};
        for (unsigned int q = 0; q < tractions.size(); ++q)
          {
            const auto          &point = boundary.points()[q];
            const Tensor<1, dim> force = point.JxW * tractions[q];
            report.reaction += force;
            report.force_magnitude += force.norm();
            report.moment +=
              boundary.rigid_motion().moment(point.x + point.prescribed,
                                             force,
                                             t_target);
            report.violation = std::max(report.violation, violations[q].norm());
          }
        sum_over_ranks(report, state.grid().communicator());
        report.violation =
          Utilities::MPI::max(report.violation, state.grid().communicator());
        boundary.accept(tractions, violations);
        reports.push_back(report);
      }
    return reports;
  }



#define INSTANTIATE(dim)                                                       \
  template void MechanicsSystem<dim>::assemble_boundaries(const bool);         \
  template bool MechanicsSystem<dim>::augment(const LA::Vector &);             \
  template std::vector<unsigned int> MechanicsSystem<dim>::n_boundary_points() \
    const;                                                                     \
  template double MechanicsSystem<dim>::deepest_point(                         \
    const ImplicitBoundary<dim> &, const std::vector<Tensor<1, dim>> &) const; \
  template double MechanicsSystem<dim>::worst_penetration_over_limit(          \
    const LA::Vector &);                                                       \
  template std::vector<BoundaryReport<dim>>                                    \
  MechanicsSystem<dim>::report_boundaries();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
