// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/aggregation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of what acts on tied nodes. Collective. */
    template <int dim>
    Effect
    effect_on_cuts(const State<dim>  &state,
                   const std::string &name,
                   const std::string &what_tied_nodes_do)
    {
      const GridSpace<dim> &space      = state.grid();
      const auto           &aggregates = *state.aggregates();
      unsigned int          n[]        = {0, 0};
      for (const auto &tie : aggregates.ties())
        n[0] += space.locally_owned().is_element(space.node_dof(tie.node));
      n[1] = aggregates.nodes_without_root().size();
      Utilities::MPI::sum(n, space.communicator(), n);
      std::string text = std::to_string(n[0]) + " nodes " + what_tied_nodes_do;
      if (n[1] > 0)
        text += ", " + std::to_string(n[1]) + " have none near";
      return {name, n[0] + n[1] > 0 ? "cuts" : "", text};
    }



    /** The mean shear modulus of the tangent of a point that is loaded on. */
    template <int dim>
    double
    tangent_shear_modulus(const State<dim> &state, const unsigned int p)
    {
      constexpr double loaded_on    = 1 + 1e-6; ///< so that it yields if it did
      constexpr double least        = 0.01;     ///< of the elastic one
      const PointSet<dim> &points   = state.material_points();
      const unsigned int   body     = points.body(p);
      const double        *values   = points.values(p);
      const Material      &material = state.material(body);
      const LameConstants  C        = elastic_stiffness(state, p);
      if (material.is_linear() || !material.is_isotropic())
        return C.mu;
      auto           internal = state.fields().internal_of(body, values);
      PrincipalState at;
      if (state.strain_measure() == StrainMeasure::small)
        at.strain = spectrum<dim>(
                      material.elastic_strain_of(points.stress_field()(values),
                                                 internal.data()))
                      .values;
      else
        {
          at.strain = spectrum<dim>(state.fields().b(values)).values;
          for (unsigned int A = 0; A < 3; ++A)
            at.strain[A] = 0.5 * std::log(at.strain[A]);
        }
      at.strain *= loaded_on;
      at.internal = internal.data();
      material.respond(state.step_time(), ArrayView<PrincipalState>(&at, 1));
      // D : (I - 1 x 1 / 3) in the principal directions.
      double modulus = trace(at.tangent);
      for (unsigned int A = 0; A < 3; ++A)
        for (unsigned int B = 0; B < 3; ++B)
          modulus -= at.tangent[A][B] / 3;
      modulus /= 4;
      return modulus > least * C.mu ? modulus : least * C.mu;
    }
  } // namespace



  template <int dim>
  std::vector<Effect>
  Aggregation<dim>::effects(const StepContext<dim> &context) const
  {
    return {
      effect_on_cuts(context.state, "aggregation", "follow filled cells")};
  }



  template <int dim>
  void
  Aggregation<dim>::constrain(const StepContext<dim>    &context,
                              AffineConstraints<double> &lines) const
  {
    constexpr double      round_off = 1e-12;
    const GridSpace<dim> &space     = context.state.grid();
    for (const auto &tie : context.state.aggregates()->ties())
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto dof = space.node_dof(tie.node) + c;
          if (lines.is_constrained(dof))
            continue;
          lines.add_line(dof);
          for (unsigned int a = 0; a < tie.weights.size(); ++a)
            if (std::abs(tie.weights[a]) > round_off)
              lines.add_entry(dof,
                              space.node_dof(tie.nodes[a]) + c,
                              tie.weights[a]);
        }
  }



  template <int dim>
  GhostTerm<dim>::GhostTerm(const double factor)
    : factor(factor)
  {
    Assert(factor > 0, ExcInternalError());
  }



  template <int dim>
  bool
  GhostTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    const GridSpace<dim>   &space = context.state.grid();
    const std::vector<Tie> &ties  = context.state.aggregates()->ties();
    held.clear();
    for (unsigned int i = 0; i < ties.size(); ++i)
      if (space.locally_owned().is_element(space.node_dof(ties[i].node)))
        held.push_back({i, 0.});
    if (!Utilities::MPI::logical_or(!held.empty(), space.communicator()))
      return false;
    const std::vector<double> scales = scales_of_roots(context);
    for (Held &one : held)
      {
        const std::vector<unsigned int> &roots = ties[one.tie].roots;
        one.scale                              = 0;
        for (const unsigned int root : roots)
          one.scale += factor * scales[root] / roots.size();
      }
    // New ties are told of by the state.
    return false;
  }



  template <int dim>
  std::vector<double>
  GhostTerm<dim>::scales_of_roots(const StepContext<dim> &context) const
  {
    const State<dim>         &state     = context.state;
    const PointSet<dim>      &points    = state.material_points();
    const MPI_Comm            all_ranks = state.grid().communicator();
    const Triangulation<dim> &tria      = state.grid().mesh().triangulation();
    // Points of a root may be on another rank than the node.
    std::vector<double> is_root(tria.n_active_cells(), 0.);
    for (const Held &one : held)
      for (const unsigned int root : state.aggregates()->ties()[one.tie].roots)
        is_root[root] = 1;
    Utilities::MPI::max(is_root, all_ranks, is_root);
    std::vector<double> scales(is_root.size(), 0.);
    for (const auto &in_cell : points.cells())
      {
        const unsigned int c = in_cell.cell->active_cell_index();
        if (is_root[c] == 0)
          continue;
        double sum = 0, volume = 0;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          {
            sum += points.volume(p) * of_point(state, p);
            volume += points.volume(p);
          }
        scales[c] = sum / volume * of_volume(volume_of_cell(in_cell.cell));
      }
    Utilities::MPI::sum(scales, all_ranks, scales);
    return scales;
  }



  template <int dim>
  void
  GhostTerm<dim>::couple(const StepContext<dim>           &context,
                         const typename Term<dim>::Couple &couple_nodes) const
  {
    std::vector<unsigned int> nodes;
    for (const Held &one : held)
      {
        const Tie &tie = context.state.aggregates()->ties()[one.tie];
        nodes.assign(1, tie.node);
        nodes.insert(nodes.end(), tie.nodes.begin(), tie.nodes.end());
        couple_nodes(nodes.data(), nodes.size());
      }
  }



  template <int dim>
  void
  GhostTerm<dim>::add(const StepContext<dim> &context,
                      const bool              tangent,
                      GlobalSystem<dim>      &system) const
  {
    const double              rate = value_by_increment(context);
    std::vector<unsigned int> nodes;
    std::vector<double>       b; // the distance is b_k q_k
    LocalSystem<dim>          local;
    for (const Held &one : held)
      {
        const Tie &tie = context.state.aggregates()->ties()[one.tie];
        nodes.assign(1, tie.node);
        b.assign(1, 1.);
        for (unsigned int k = 0; k < tie.nodes.size(); ++k)
          {
            nodes.push_back(tie.nodes[k]);
            b.push_back(-tie.weights[k]);
          }
        const unsigned int n = nodes.size();
        local.reinit(context.state, nodes.data(), n, tangent);
        Tensor<1, dim> distance;
        for (unsigned int k = 0; k < n; ++k)
          distance +=
            b[k] * value(context, nodes[k], local.nodal_increments[k]);
        for (unsigned int c = 0; c < dim; ++c)
          {
            if (system.is_prescribed(local.dofs[c]))
              continue;
            for (unsigned int k = 0; k < n; ++k)
              {
                local.force[dim * k + c] = -one.scale * b[k] * distance[c];
                if (tangent)
                  for (unsigned int l = 0; l < n; ++l)
                    local.matrix(dim * k + c, dim * l + c) =
                      one.scale * rate * b[k] * b[l];
              }
          }
        system.add(local, tangent);
      }
  }



  template <int dim>
  std::vector<Effect>
  GhostStiffness<dim>::effects(const StepContext<dim> &context) const
  {
    std::ostringstream does;
    does << "are held to filled cells, ghost factor " << this->factor;
    return {effect_on_cuts(context.state, "ghost term", does.str())};
  }



  template <int dim>
  double
  GhostStiffness<dim>::of_point(const State<dim>  &state,
                                const unsigned int p) const
  {
    return tangent_shear_modulus(state, p);
  }



  template <int dim>
  double
  GhostStiffness<dim>::of_volume(const double volume) const
  {
    return dim == 2 ? 1. : std::cbrt(volume);
  }



  template <int dim>
  double
  GhostMass<dim>::of_point(const State<dim> &state, const unsigned int p) const
  {
    return state.material(state.material_points().body(p)).density();
  }



  template <int dim>
  double
  GhostMass<dim>::of_volume(const double volume) const
  {
    return volume;
  }



  template <int dim>
  Tensor<1, dim>
  GhostMass<dim>::value(const StepContext<dim> &context,
                        const unsigned int      node,
                        const Tensor<1, dim>   &du) const
  {
    return context.motion->inertial_acceleration(node, du);
  }



  template <int dim>
  double
  GhostMass<dim>::value_by_increment(const StepContext<dim> &context) const
  {
    return context.motion->inertial_acceleration_by_increment();
  }



  template class Aggregation<2>;
  template class Aggregation<3>;
  template class GhostTerm<2>;
  template class GhostTerm<3>;
  template class GhostStiffness<2>;
  template class GhostStiffness<3>;
  template class GhostMass<2>;
  template class GhostMass<3>;
} // namespace moraine
