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



    /** The functions at a place of a boundary: those of the cell, and of the
     * cells with which it has a mean. */
    template <int dim>
    class PlaceFunctions
    {
    public:
      /** For places in a cell. */
      void
      reinit(const State<dim> &state, const unsigned int cell);

      /** Take the functions of the cell at a place. */
      void
      set(const double *N_of_cell, const Tensor<1, dim> *grad_N_of_cell);

      /** @p nodal has the increments of all nodes. */
      Increment<dim>
      increment(const std::vector<Tensor<1, dim>> &nodal) const;

      std::vector<unsigned int>   nodes; ///< those of the cell first
      std::vector<double>         N;
      std::vector<Tensor<1, dim>> grad_N;
      /** The mean, or @p grad_N if there is none. */
      std::vector<Tensor<1, dim>> mean_grad_N;

    private:
      unsigned int                               n_of_cell = 0;
      std::vector<typename CellMeans<dim>::Part> parts; ///< of the mean
    };



    template <int dim>
    void
    PlaceFunctions<dim>::reinit(const State<dim>  &state,
                                const unsigned int cell)
    {
      const GridSpace<dim> &space = state.grid();
      n_of_cell                   = space.nodes_per_cell();
      const unsigned int *first   = space.cell_nodes(cell);
      nodes.assign(first, first + n_of_cell);
      mean_grad_N.assign(n_of_cell, Tensor<1, dim>());
      state.mean_of_cell(cell, parts);
      for (const auto &part : parts)
        for (unsigned int a = 0; a < n_of_cell; ++a)
          {
            const unsigned int node = space.cell_nodes(part.cell)[a];
            const auto found = std::find(nodes.begin(), nodes.end(), node);
            const auto place = found - nodes.begin();
            if (found == nodes.end())
              {
                nodes.push_back(node);
                mean_grad_N.emplace_back();
              }
            mean_grad_N[place] += part.weight * part.gradients[a];
          }
      N.assign(nodes.size(), 0.);
      grad_N.assign(nodes.size(), Tensor<1, dim>());
    }



    template <int dim>
    void
    PlaceFunctions<dim>::set(const double         *N_of_cell,
                             const Tensor<1, dim> *grad_N_of_cell)
    {
      std::copy_n(N_of_cell, n_of_cell, N.begin());
      std::copy_n(grad_N_of_cell, n_of_cell, grad_N.begin());
      if (parts.empty())
        std::copy_n(grad_N_of_cell, n_of_cell, mean_grad_N.begin());
    }



    template <int dim>
    Increment<dim>
    PlaceFunctions<dim>::increment(
      const std::vector<Tensor<1, dim>> &nodal) const
    {
      Increment<dim> du;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          const Tensor<1, dim> &u = nodal[nodes[a]];
          du.value += N[a] * u;
          du.gradient += outer_product(u, grad_N[a]);
          du.mean_gradient += outer_product(u, mean_grad_N[a]);
        }
      return du;
    }



    /**
     * With means of cells a flux has one change of volume in each, which works
     * against the mean of what is missed along the normal. The skew form needs
     * no more of @f$\lambda@f$; a penalty of it at every place would ask for
     * more than cells can follow, and lock. In dynamics it bounds flutter.
     */
    template <int dim>
    Enforcement
    enforcement_of(const ImplicitBoundary<dim> &boundary,
                   const StepContext<dim>      &context)
    {
      Enforcement how = boundary.enforcement();
      if (context.state.averages_volume() && !context.motion &&
          how.w_constrained > 0 && how.adjoint_sign < 0)
        how.lambda_share = 0;
      return how;
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
    // A form that is not definite feeds what one step leaves to the next: in
    // vibrations, and as points move. Elsewhere the larger factor costs
    // accuracy for nothing.
    const Enforcement &how     = boundary.enforcement();
    const bool         nitsche = how.carries_multiplier && !how.augments;
    const bool finite = context.state.strain_measure() == StrainMeasure::finite;
    if (nitsche && (context.motion || (finite && how.adjoint_sign > 0)))
      boundary.set_depths(volumes_in_cells(context.state));
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
    const Enforcement           how = enforcement_of(boundary, context);
    LocalSystem<dim>            local;
    PlaceFunctions<dim>         at;
    std::vector<Tensor<1, dim>> fluxes;
    const bool                  in_the_middle = forces_in_the_middle(context);
    const auto                 &points        = boundary.points();
    for (unsigned int begin = 0, end = 0; begin < points.size(); begin = end)
      {
        const unsigned int cell = points[begin].cell;
        at.reinit(context.state, cell);
        local.reinit(context.state, at.nodes.data(), at.nodes.size(), tangent);
        for (; end < points.size() && points[end].cell == cell; ++end)
          {
            at.set(boundary.N(end), boundary.grad_N(end));
            const auto du = at.increment(context.increments());
            add_boundary_point(points[end],
                               boundary.constraint_state(points[end],
                                                         du.value,
                                                         in_the_middle),
                               how,
                               context.cell_materials.elastic_stiffness(cell),
                               context.state.strain_measure(),
                               at.N.data(),
                               at.grad_N.data(),
                               at.mean_grad_N.data(),
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
    const Enforcement   how           = enforcement_of(boundary, context);
    const bool          in_the_middle = forces_in_the_middle(context);
    const auto         &points        = boundary.points();
    PlaceFunctions<dim> at;
    tractions.resize(points.size());
    violations.resize(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const unsigned int cell = points[q].cell;
        if (q == 0 || cell != points[q - 1].cell)
          at.reinit(context.state, cell);
        at.set(boundary.N(q), boundary.grad_N(q));
        const auto du = at.increment(context.increments());
        const auto constraint =
          boundary.constraint_state(points[q], du.value, in_the_middle);
        violations[q] = constraint.violation;
        tractions[q] =
          boundary_traction(points[q],
                            constraint,
                            how,
                            context.cell_materials.elastic_stiffness(cell),
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
        prepared.work_of_motion += force * point.prescribed;
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
