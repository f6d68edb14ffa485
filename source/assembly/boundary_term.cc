// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/boundary_term.h>

#include <moraine/assembly/boundary_force.h>
#include <moraine/state/motion.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The trial increment at a place of a boundary. */
    template <int dim>
    struct Increment
    {
      Tensor<1, dim> value;
      Tensor<2, dim> gradient;
      /** By which the volume changes. */
      Tensor<2, dim> mean_gradient;
    };



    template <int dim>
    Increment<dim>
    increment_at(const std::vector<Tensor<1, dim>> &nodal,
                 const unsigned int                *nodes,
                 const unsigned int                 n_nodes,
                 const double                      *N,
                 const Tensor<1, dim>              *grad_N,
                 const Tensor<1, dim>              *mean_grad_N)
    {
      Increment<dim> du;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const Tensor<1, dim> &u = nodal[nodes ? nodes[a] : a];
          du.value += N[a] * u;
          du.gradient += outer_product(u, grad_N[a]);
          du.mean_gradient += outer_product(u, mean_grad_N[a]);
        }
      return du;
    }



    /** The mean over the cell, or @p grad_N if there is none. */
    template <int dim>
    const Tensor<1, dim> *
    mean_gradients(const State<dim>     &state,
                   const unsigned int    cell,
                   const Tensor<1, dim> *grad_N)
    {
      const Tensor<1, dim> *mean = state.mean_gradients(cell);
      return mean ? mean : grad_N;
    }



    template <int dim>
    bool
    forces_in_the_middle(const StepContext<dim> &context)
    {
      return context.motion &&
             context.motion->integrator().forces_in_the_middle();
    }
  } // namespace



  template <int dim>
  BoundaryTerm<dim>::BoundaryTerm(ImplicitBoundary<dim> &boundary)
    : boundary(boundary)
  {}



  template <int dim>
  std::vector<Effect>
  BoundaryTerm<dim>::effects(const StepContext<dim> &context) const
  {
    const std::string &name = boundary.name();
    const std::string &how  = boundary.enforcement().name;
    return {{"implicit boundary " + name + " (" + how + ")",
             "boundary",
             name + ", " + boundary.constraint_name() + ", " + how + ", " +
               std::to_string(
                 boundary.n_points(context.state.grid().communicator())) +
               " quadrature points"}};
  }



  template <int dim>
  bool
  BoundaryTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    boundary.begin_step(context.state.grid(),
                        context.t_start,
                        context.search_tolerance,
                        context.state.mesh_after_step() != MeshAfterStep::keep,
                        context.state.strain_measure(),
                        context.cells_moved);
    return false;
  }



  template <int dim>
  void
  BoundaryTerm<dim>::check_values(const StepContext<dim> &context)
  {
    boundary.set_target(context.t_end);
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
    return how.w_free == 0 ||
           (context.state.strain_measure() == StrainMeasure::small &&
            how.adjoint_sign > 0);
  }



  template <int dim>
  void
  BoundaryTerm<dim>::add(const StepContext<dim> &context,
                         const bool              tangent,
                         GlobalSystem<dim>      &system) const
  {
    LocalSystem<dim>            local;
    std::vector<Tensor<1, dim>> fluxes;
    const bool                  in_the_middle = forces_in_the_middle(context);
    const GridSpace<dim>       &space         = context.state.grid();
    const unsigned int          n             = space.nodes_per_cell();
    const auto                 &points        = boundary.points();
    for (unsigned int begin = 0, end = 0; begin < points.size(); begin = end)
      {
        const unsigned int cell = points[begin].cell;
        local.reinit(context.state, space.cell_nodes(cell), n, tangent);
        for (; end < points.size() && points[end].cell == cell; ++end)
          {
            const Tensor<1, dim> *mean_grad_N =
              mean_gradients(context.state, cell, boundary.grad_N(end));
            const auto du = increment_at<dim>(local.nodal_increments,
                                              nullptr,
                                              n,
                                              boundary.N(end),
                                              boundary.grad_N(end),
                                              mean_grad_N);
            add_boundary_point(points[end],
                               boundary.constraint_state(points[end],
                                                         du.value,
                                                         in_the_middle),
                               boundary.enforcement(),
                               context.cell_materials.elastic_stiffness(cell),
                               context.state.strain_measure(),
                               boundary.N(end),
                               boundary.grad_N(end),
                               mean_grad_N,
                               du.gradient,
                               du.mean_gradient,
                               tangent,
                               fluxes,
                               local);
          }
        system.add(local, tangent);
      }
  }



  template <int dim>
  void
  BoundaryTerm<dim>::evaluate(const StepContext<dim>      &context,
                              std::vector<Tensor<1, dim>> &tractions,
                              std::vector<Tensor<1, dim>> &violations) const
  {
    const bool            in_the_middle = forces_in_the_middle(context);
    const GridSpace<dim> &space         = context.state.grid();
    const auto           &points        = boundary.points();
    tractions.resize(points.size());
    violations.resize(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const auto du = increment_at<dim>(context.increments(),
                                          space.cell_nodes(points[q].cell),
                                          space.nodes_per_cell(),
                                          boundary.N(q),
                                          boundary.grad_N(q),
                                          mean_gradients(context.state,
                                                         points[q].cell,
                                                         boundary.grad_N(q)));
        const auto constraint =
          boundary.constraint_state(points[q], du.value, in_the_middle);
        violations[q] = constraint.violation;
        tractions[q] =
          boundary_traction(points[q],
                            constraint,
                            boundary.enforcement(),
                            context.cell_materials.elastic_stiffness(
                              points[q].cell),
                            context.state.strain_measure(),
                            du.gradient,
                            du.mean_gradient);
      }
  }



  template <int dim>
  double
  BoundaryTerm<dim>::violation(const StepContext<dim> &context) const
  {
    if (!boundary.enforcement().augments)
      return 0.;
    std::vector<Tensor<1, dim>> tractions, violations;
    evaluate(context, tractions, violations);
    double largest = 0;
    for (const auto &v : violations)
      largest = std::max(largest, v.norm());
    return largest;
  }



  template <int dim>
  void
  BoundaryTerm<dim>::augment(const StepContext<dim> &context)
  {
    if (!boundary.enforcement().augments)
      return;
    std::vector<Tensor<1, dim>> multipliers, violations;
    evaluate(context, multipliers, violations);
    Enforcement no_flux   = boundary.enforcement();
    no_flux.w_constrained = no_flux.w_free = 0;
    for (unsigned int q = 0; q < boundary.points().size(); ++q)
      {
        const auto          &point = boundary.points()[q];
        ConstraintState<dim> constraint;
        constraint.normal    = point.normal;
        constraint.push      = point.normal;
        constraint.violation = violations[q];
        constraint.M         = boundary.projection(point.normal);
        multipliers[q] =
          boundary_traction(point,
                            constraint,
                            no_flux,
                            context.cell_materials.elastic_stiffness(
                              point.cell),
                            context.state.strain_measure(),
                            Tensor<2, dim>(),
                            Tensor<2, dim>());
      }
    boundary.set_multipliers(multipliers);
  }



  template <int dim>
  double
  BoundaryTerm<dim>::deepest_point(
    const StepContext<dim>            &context,
    const std::vector<Tensor<1, dim>> &moves) const
  {
    const PointSet<dim> &points = context.state.material_points();
    const double         range  = 2 * context.state.grid().mesh().cell_size();
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
    return Utilities::MPI::max(deepest, context.state.grid().communicator());
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
  BoundaryTerm<dim>::prepare(const StepContext<dim> &context,
                             const LA::Vector &)
  {
    const MPI_Comm communicator = context.state.grid().communicator();
    std::vector<Tensor<1, dim>> tractions, violations;
    evaluate(context, tractions, violations);
    prepared = {boundary.name(), {}, 0., 0., 0., 0.};
    for (unsigned int q = 0; q < tractions.size(); ++q)
      {
        const auto          &point = boundary.points()[q];
        const Tensor<1, dim> force = point.JxW * tractions[q];
        prepared.reaction += force;
        prepared.force_magnitude += force.norm();
        prepared.moment +=
          boundary.rigid_motion().moment(point.x + point.prescribed,
                                         force,
                                         context.t_end);
        prepared.violation = std::max(prepared.violation, violations[q].norm());
      }
    sum_over_ranks(prepared, communicator);
    prepared.violation = Utilities::MPI::max(prepared.violation, communicator);
    boundary.prepare(tractions, violations);
  }



  template <int dim>
  void
  BoundaryTerm<dim>::keep() noexcept
  {
    boundary.keep();
  }



  template <int dim>
  void
  BoundaryTerm<dim>::report(const StepContext<dim>           &context,
                            std::vector<BoundaryReport<dim>> &reports) const
  {
    reports.push_back(prepared);
    reports.back().penetration = deepest_point(context, {});
  }



  template class BoundaryTerm<2>;
  template class BoundaryTerm<3>;
} // namespace moraine
