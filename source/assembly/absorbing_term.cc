// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/absorbing_term.h>

#include <moraine/mesh/active_search.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Translations, then rotations about @p c, at @p x. */
    template <int dim>
    std::vector<Tensor<1, dim>>
    rigid_fields(const Point<dim> &x, const Point<dim> &c)
    {
      std::vector<Tensor<1, dim>> fields;
      for (unsigned int i = 0; i < dim; ++i)
        fields.push_back(Point<dim>::unit_vector(i));
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i + 1; j < dim; ++j)
          fields.push_back((x[i] - c[i]) * fields[j] -
                           (x[j] - c[j]) * fields[i]);
      return fields;
    }
  } // namespace



  template <int dim>
  AbsorbingTerm<dim>::AbsorbingTerm(AbsorbingBoundary<dim> &boundary,
                                    const bool              acts)
    : boundary(boundary)
    , acts(acts)
  {}



  template <int dim>
  std::vector<Effect>
  AbsorbingTerm<dim>::effects(const StepContext<dim> &context) const
  {
    if (!acts)
      return {};
    const std::string &name = boundary.name();
    const unsigned int n =
      Utilities::MPI::sum<unsigned int>(local_places.size(),
                                        context.state.grid().communicator());
    return {
      {"absorbing boundary " + name,
       "boundary",
       name + ", absorbing, " + std::to_string(n) + " quadrature points"}};
  }



  template <int dim>
  bool
  AbsorbingTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    const bool moves_through_mesh =
      context.state.mesh_after_step() == MeshAfterStep::reset;
    if (context.couplings_changed || moves_through_mesh ||
        !boundary.has_cells())
      boundary.find_cells(context.state.grid(),
                          context.search_tolerance,
                          context.t_start);
    if (acts && (context.cells_moved || moves_through_mesh))
      find_local_places(context);
    return false;
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::find_local_places(const StepContext<dim> &context)
  {
    const auto &places = boundary.places();
    local_places.clear();
    for (unsigned int k = 0; k < places.size(); ++k)
      if (places[k].active_cell_index != GridSpace<dim>::no_cell)
        {
          const unsigned int cell         = places[k].active_cell_index;
          const auto         coefficients = boundary.law().coefficients(
            context.cell_materials.elastic_stiffness(cell),
            context.cell_materials.density(cell));
          local_places.push_back(
            {k,
             cell,
             coefficients.dashpots.template matrix<dim>(places[k].normal),
             coefficients.springs.template matrix<dim>(places[k].normal)});
        }
    std::stable_sort(local_places.begin(),
                     local_places.end(),
                     [](const auto &a, const auto &b) {
                       return a.cell < b.cell;
                     });
    const unsigned int  n = context.state.grid().nodes_per_cell();
    std::vector<Vector> gradients(n);
    shapes.resize(n * local_places.size());
    for (unsigned int q = 0; q < local_places.size(); ++q)
      evaluate_shapes(context.state.grid(),
                      local_places[q].cell,
                      places[local_places[q].number].x,
                      &shapes[n * q],
                      gradients.data());
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::check_values(const StepContext<dim> &context)
  {
    if (!local_places.empty())
      boundary.incident_velocity(local_places[0].number, context.t_end);
  }



  template <int dim>
  Tensor<1, dim>
  AbsorbingTerm<dim>::traction(const StepContext<dim>    &context,
                               const unsigned int         q,
                               const std::vector<Vector> &increments) const
  {
    const LocalPlace   &place = local_places[q];
    const unsigned int *nodes = context.state.grid().cell_nodes(place.cell);
    const double       *N     = &shapes[increments.size() * q];
    const double        share = context.share_of_step();
    const double        t     = context.t_start + share * context.step_size();
    Vector              v;
    if (context.motion)
      v = -2. * boundary.incident_velocity(place.number, t);
    Vector u = boundary.extension(place.number) -
               boundary.incident_increment(place.number, context.t_start, t);
    for (unsigned int a = 0; a < increments.size(); ++a)
      {
        u += share * N[a] * increments[a];
        if (context.motion)
          v += N[a] * context.motion->velocity(nodes[a], increments[a]);
      }
    return boundary.held_traction(place.number) - place.dashpots * v -
           place.springs * u;
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::add(const StepContext<dim> &context,
                          const bool              tangent,
                          GlobalSystem<dim>      &system) const
  {
    LocalSystem<dim>      local;
    const GridSpace<dim> &space = context.state.grid();
    const unsigned int    n     = space.nodes_per_cell();
    const double          share = context.share_of_step();
    const double          dv_du =
      context.motion ? context.motion->velocity_by_increment() : 0.;
    for (unsigned int begin = 0, end = 0; begin < local_places.size();
         begin = end)
      {
        const unsigned int cell = local_places[begin].cell;
        local.reinit(context.state, space.cell_nodes(cell), n, tangent);
        for (; end < local_places.size() && local_places[end].cell == cell;
             ++end)
          {
            const LocalPlace &place = local_places[end];
            const double     *N     = &shapes[n * end];
            const double      area  = boundary.places()[place.number].weight;
            const Vector      force =
              area * traction(context, end, local.nodal_increments);
            local.add_force(N, force);
            if (tangent)
              local.add_stiffness(N,
                                  area * (dv_du * place.dashpots +
                                          share * place.springs));
          }
        system.add(local, tangent);
      }
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::prepare(const StepContext<dim> &context,
                              const LA::Vector &)
  {
    const State<dim>     &state = context.state;
    const GridSpace<dim> &space = state.grid();
    std::vector<Vector>   increments(space.nodes_per_cell());
    prepared = {boundary.name(), {}, 0., 0., 0., 0.};
    for (unsigned int q = 0; q < local_places.size(); ++q)
      {
        const unsigned int *nodes = space.cell_nodes(local_places[q].cell);
        for (unsigned int a = 0; a < increments.size(); ++a)
          increments[a] = context.increments()[nodes[a]];
        const Vector force = boundary.places()[local_places[q].number].weight *
                             traction(context, q, increments);
        prepared.reaction += force;
        prepared.force_magnitude += force.norm();
      }
    sum_over_ranks(prepared, space.communicator());
    const bool through_mesh = state.mesh_after_step() == MeshAfterStep::reset;
    boundary.prepare(space,
                     context.increments(),
                     context.t_start,
                     context.t_end,
                     {state.mesh_after_step() ==
                          MeshAfterStep::follow_material ||
                        (through_mesh && !boundary.is_on_side()),
                      through_mesh,
                      state.strain_measure() == StrainMeasure::finite,
                      acts});
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::keep() noexcept
  {
    boundary.keep();
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::report(const StepContext<dim> &,
                             std::vector<BoundaryReport<dim>> &reports) const
  {
    if (acts)
      reports.push_back(prepared);
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  AbsorbingTerm<dim>::interpolate(const GridSpace<dim>      &space,
                                  const std::vector<Vector> &nodal) const
  {
    const unsigned int  n = space.nodes_per_cell();
    std::vector<Vector> values(local_places.size());
    for (unsigned int q = 0; q < local_places.size(); ++q)
      for (unsigned int a = 0; a < n; ++a)
        values[q] +=
          shapes[n * q + a] * nodal[space.cell_nodes(local_places[q].cell)[a]];
    return values;
  }



  template <int dim>
  LA::Vector
  AbsorbingTerm<dim>::integrate(const GridSpace<dim>      &space,
                                const std::vector<Vector> &tractions) const
  {
    const unsigned int  n = space.nodes_per_cell();
    std::vector<Vector> sums(space.n_nodes());
    for (unsigned int q = 0; q < local_places.size(); ++q)
      for (unsigned int a = 0; a < n; ++a)
        sums[space.cell_nodes(local_places[q].cell)[a]] +=
          shapes[n * q + a] * boundary.places()[local_places[q].number].weight *
          tractions[q];
    LA::Vector forces = space.vector();
    space.sum_node_values(sums, forces);
    return forces;
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::add_rigid_field(const GridSpace<dim> &space,
                                      const LA::Vector     &missing,
                                      std::vector<Vector>  &tractions) const
  {
    Vector sum;
    double area = 0;
    for (const LocalPlace &local : local_places)
      {
        const auto &place = boundary.places()[local.number];
        sum += place.weight * place.x;
        area += place.weight;
      }
    sum  = Utilities::MPI::sum(sum, space.communicator());
    area = Utilities::MPI::sum(area, space.communicator());
    if (area == 0)
      return;
    const Point<dim> centre(sum / area);

    constexpr unsigned int           n = dim * (dim + 1) / 2;
    FullMatrix<double>               products(n, n);
    std::vector<double>              sums(n, 0.), factors(n, 0.);
    std::vector<std::vector<Vector>> fields_of_places;
    for (const LocalPlace &local : local_places)
      {
        const auto &place = boundary.places()[local.number];
        fields_of_places.push_back(rigid_fields(place.x, centre));
        const auto &fields = fields_of_places.back();
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            products(i, j) += place.weight * (fields[i] * fields[j]);
      }
    std::vector<Vector> forces;
    space.node_values(missing, forces);
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      if (space.locally_owned().is_element(space.node_dof(node)))
        {
          const auto fields = rigid_fields(space.node_position(node), centre);
          for (unsigned int i = 0; i < n; ++i)
            sums[i] += fields[i] * forces[node];
        }
    Utilities::MPI::sum(products, space.communicator(), products);
    Utilities::MPI::sum(sums, space.communicator(), sums);
    products.gauss_jordan();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        factors[i] += products(i, j) * sums[j];
    for (unsigned int q = 0; q < tractions.size(); ++q)
      for (unsigned int i = 0; i < n; ++i)
        tractions[q] += factors[i] * fields_of_places[q][i];
  }



  template <int dim>
  std::optional<double>
  AbsorbingTerm<dim>::hold(const StepContext<dim> &context,
                           const std::string      &name,
                           const LA::Vector       &forces)
  {
    if (name != boundary.name())
      return {};
    const GridSpace<dim> &space = context.state.grid();
    std::vector<Vector>   nodal;
    const auto            traction_of = [&](const LA::Vector &x) {
      space.node_values(x, nodal);
      return interpolate(space, nodal);
    };
    const auto mass_times = [&](const LA::Vector &x) {
      return integrate(space, traction_of(x));
    };
    // Conjugate gradients for least squares: sums of functions that vanish on
    // the surface, and forces that it cannot give, do no harm.
    LA::Vector   lambda = space.vector(), rest = forces;
    LA::Vector   gradient = mass_times(rest), direction = gradient;
    const double first = gradient.l2_norm();
    double       now   = first;
    for (unsigned int k = 0; k < 1000 && now > 1e-15 * first; ++k)
      {
        const LA::Vector image = mass_times(direction);
        const double length = Utilities::fixed_power<2>(now) / (image * image);
        lambda.add(length, direction);
        rest.add(-length, image);
        gradient            = mass_times(rest);
        const double before = now;
        now                 = gradient.l2_norm();
        direction.sadd(Utilities::fixed_power<2>(now / before), gradient);
      }

    std::vector<Vector> of_this_rank = traction_of(lambda);
    add_rigid_field(space, rest, of_this_rank);
    std::vector<double> all(dim * boundary.places().size(), 0.);
    for (unsigned int q = 0; q < local_places.size(); ++q)
      for (unsigned int d = 0; d < dim; ++d)
        all[dim * local_places[q].number + d] = of_this_rank[q][d];
    Utilities::MPI::sum(all, space.communicator(), all);
    std::vector<Vector> tractions(boundary.places().size());
    for (unsigned int k = 0; k < tractions.size(); ++k)
      for (unsigned int d = 0; d < dim; ++d)
        tractions[k][d] = all[dim * k + d];
    boundary.hold(std::move(tractions));
    const double norm = forces.l2_norm();
    return norm > 0 ? rest.l2_norm() / norm : 0.;
  }



  template class AbsorbingTerm<2>;
  template class AbsorbingTerm<3>;
} // namespace moraine
