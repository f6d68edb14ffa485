// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What nodes get of points, and accelerations at the start.

#include <moraine/state/motion.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Tensor<1, dim>
  Motion<dim>::unknown_part(const PointField<dim, Tensor<1, dim>> &field,
                            const Nodal                           *known,
                            NodeValues Nodal::*const member,
                            const StencilBlock<dim> &block,
                            const unsigned int       p) const
  {
    Tensor<1, dim> value = field(points.values(block.points[p]));
    for (unsigned int k = 0; known && k < block.n_nodes; ++k)
      value -= block.N(p)[k] * (known->*member)[block.nodes[k]];
    return value;
  }



  template <int dim>
  typename Motion<dim>::Nodal
  Motion<dim>::map_to_nodes(const Nodal *known)
  {
    const GridSpace<dim> &space = state.grid();
    const unsigned int    n     = space.n_nodes();
    NodeValues            masses(n);
    Nodal                 values{NodeValues(n),
                 NodeValues(n),
                 NodeValues(before_field.exists() ? n : 0)};
    add_momenta(known, masses, values);
    std::vector<NodeValues *> found{&values.v, &values.a};
    if (before_field.exists())
      found.push_back(&values.a_before);
    space.sum_over_ranks(masses);
    for (NodeValues *sums : found)
      {
        space.sum_over_ranks(*sums);
        for (unsigned int k = 0; k < n; ++k)
          if (masses[k][0] > 0)
            (*sums)[k] /= masses[k][0];
      }
    find_massless(masses);
    if (!massless.empty())
      extend_motion(known, values);
    if (const auto *aggregates = state.strict_aggregates())
      for (NodeValues *of_nodes : found)
        aggregates->hand_over(space, masses, *of_nodes);
    return values;
  }



  template <int dim>
  void
  Motion<dim>::add_momenta(const Nodal *known,
                           NodeValues  &masses,
                           Nodal       &sums) const
  {
    const Basis<dim> &basis = state.point_basis();
    StencilBlock<dim> block;
    NodeValues        places; ///< of the nodes of a block
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        if (gradient_field.exists())
          {
            places.resize(block.n_nodes);
            for (unsigned int k = 0; k < block.n_nodes; ++k)
              places[k] = state.grid().node_position(block.nodes[k]);
          }
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            const unsigned int   point = block.points[p];
            const double         m     = state.mass(point);
            const Tensor<1, dim> V =
              unknown_part(v_field, known, &Nodal::v, block, p);
            const Tensor<1, dim> A =
              unknown_part(a_field, known, &Nodal::a, block, p);
            Tensor<1, dim> B;
            if (before_field.exists())
              B = unknown_part(before_field, known, &Nodal::a_before, block, p);
            // The mean place of what nodes see of the point: with it the
            // gradient gives no momentum.
            Tensor<1, dim> centre;
            for (unsigned int k = 0; k < places.size(); ++k)
              centre += block.N(p)[k] * places[k];
            Tensor<2, dim> G;
            if (gradient_field.exists())
              G = gradient_field(points.values(point));
            for (unsigned int k = 0; k < block.n_nodes; ++k)
              {
                const unsigned int node  = block.nodes[k];
                const double       share = block.N(p)[k] * m;
                masses[node][0] += share;
                masses[node][1] += m;
                sums.v[node] += share * V;
                sums.a[node] += share * A;
                if (before_field.exists())
                  sums.a_before[node] += share * B;
                if (gradient_field.exists())
                  sums.v[node] += share * (G * (places[k] - centre));
              }
          }
      }
  }



  template <int dim>
  void
  Motion<dim>::extend_motion(const Nodal *known, Nodal &values) const
  {
    const auto velocity = [&](const StencilBlock<dim> &block,
                              const unsigned int       p,
                              const unsigned int       k) {
      Tensor<1, dim> V = unknown_part(v_field, known, &Nodal::v, block, p);
      if (!gradient_field.exists())
        return V;
      Tensor<1, dim> way = state.grid().node_position(block.nodes[k]);
      for (unsigned int l = 0; l < block.n_nodes; ++l)
        way -= block.N(p)[l] * state.grid().node_position(block.nodes[l]);
      V += gradient_field(points.values(block.points[p])) * way;
      return V;
    };
    const auto extend_accelerations = [&](const auto &field,
                                          NodeValues Nodal::*const member) {
      extend(
        [&](const auto &block, const unsigned int p, const unsigned int) {
          return unknown_part(field, known, member, block, p);
        },
        values.*member);
    };
    extend(velocity, values.v);
    extend_accelerations(a_field, &Nodal::a);
    if (before_field.exists())
      extend_accelerations(before_field, &Nodal::a_before);
  }



  template <int dim>
  typename Motion<dim>::NodeValues
  Motion<dim>::node_masses() const
  {
    // By the size of functions: quadratic ones are below 0 in places.
    NodeValues        masses(state.grid().n_nodes());
    const Basis<dim> &basis = state.point_basis();
    StencilBlock<dim> block;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            const double m = state.mass(block.points[p]);
            for (unsigned int k = 0; k < block.n_nodes; ++k)
              {
                masses[block.nodes[k]][0] += m * std::abs(block.N(p)[k]);
                masses[block.nodes[k]][1] += m;
              }
          }
      }
    state.grid().sum_over_ranks(masses);
    return masses;
  }



  template <int dim>
  void
  Motion<dim>::find_massless(const NodeValues &masses)
  {
    constexpr double round_off = 1e-12;
    bool             any       = false;
    massless.resize(masses.size());
    for (unsigned int k = 0; k < masses.size(); ++k)
      {
        massless[k] =
          masses[k][1] > 0 && masses[k][0] <= round_off * masses[k][1];
        any = any || massless[k];
      }
    if (!Utilities::MPI::logical_or(any, state.grid().communicator()))
      massless.clear();
  }



  template <int dim>
  template <class Value>
  void
  Motion<dim>::extend(const Value &value, NodeValues &values) const
  {
    // By the gradient alone a point in the corner of a cell would give nothing
    // to the opposite corner.
    constexpr double      least = 1e-6;
    const GridSpace<dim> &space = state.grid();
    const Basis<dim>     &basis = state.point_basis();
    const double          h     = space.mesh().cell_size();
    NodeValues            weights(space.n_nodes()), sums(space.n_nodes());
    StencilBlock<dim>     block;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        const auto nodes = basis.batch_nodes(g);
        if (std::none_of(nodes.begin(), nodes.end(), [&](const auto node) {
              return massless[node];
            }))
          continue;
        basis.evaluate(g, block);
        for (unsigned int k = 0; k < block.n_nodes; ++k)
          if (const unsigned int node = block.nodes[k]; massless[node])
            for (unsigned int p = 0; p < block.n_points; ++p)
              {
                const double weight = state.mass(block.points[p]) *
                                      (least + h * block.grad_N(p)[k].norm());
                weights[node][0] += weight;
                sums[node] += weight * value(block, p, k);
              }
      }
    for (NodeValues *sum : {&weights, &sums})
      space.sum_over_ranks(*sum);
    for (unsigned int k = 0; k < values.size(); ++k)
      if (massless[k])
        values[k] = sums[k] / weights[k][0];
  }



  template <int dim>
  typename Motion<dim>::NodeValues
  Motion<dim>::mean_of_bodies(
    const std::function<Tensor<1, dim>(const unsigned int, const unsigned int)>
      &velocity)
  {
    const GridSpace<dim> &space  = state.grid();
    const Basis<dim>     &basis  = state.point_basis();
    const NodeValues      masses = node_masses();
    NodeValues            mean(space.n_nodes());
    NodeValues            of_body; ///< velocities of the nodes of a block
    StencilBlock<dim>     block;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        of_body.resize(block.n_nodes);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            const unsigned int body = points.body(block.points[p]);
            if (p == 0 || body != points.body(block.points[p - 1]))
              for (unsigned int k = 0; k < block.n_nodes; ++k)
                of_body[k] = velocity(body, block.nodes[k]);
            const double m = state.mass(block.points[p]);
            for (unsigned int k = 0; k < block.n_nodes; ++k)
              {
                const double share = m * std::abs(block.N(p)[k]);
                mean[block.nodes[k]] += share * of_body[k];
              }
          }
      }
    space.sum_over_ranks(mean);
    for (unsigned int k = 0; k < mean.size(); ++k)
      if (masses[k][0] > 0)
        mean[k] /= masses[k][0];
    find_massless(masses);
    if (!massless.empty())
      extend(
        [&](const auto &block, const unsigned int p, const unsigned int k) {
          return velocity(points.body(block.points[p]), block.nodes[k]);
        },
        mean);
    return mean;
  }



  template <int dim>
  void
  Motion<dim>::set_accelerations(const LA::Vector &values)
  {
    state.grid().node_values(values, a);
    for (unsigned int k = 0; k < massless.size(); ++k)
      if (massless[k])
        a[k] = Tensor<1, dim>();
    interpolate(a, a_field);
    if (!massless.empty())
      extend(
        [&](const auto &block, const unsigned int p, const unsigned int) {
          return a_field(points.values(block.points[p]));
        },
        a);
  }



  template <int dim>
  void
  Motion<dim>::interpolate(const NodeValues &values,
                           const PointField<dim, dealii::Tensor<1, dim>> &field)
  {
    const Basis<dim> &basis = state.point_basis();
    StencilBlock<dim> block;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            Tensor<1, dim> value;
            for (unsigned int k = 0; k < block.n_nodes; ++k)
              value += block.N(p)[k] * values[block.nodes[k]];
            field.store(value, points.values(block.points[p]));
          }
      }
  }



  template typename Motion<2>::Nodal
  Motion<2>::map_to_nodes(const Nodal *);
  template typename Motion<2>::NodeValues
  Motion<2>::mean_of_bodies(
    const std::function<Tensor<1, 2>(const unsigned int, const unsigned int)>
      &);
  template void
  Motion<2>::set_accelerations(const LA::Vector &);
  template void
  Motion<2>::interpolate(const NodeValues &,
                         const PointField<2, Tensor<1, 2>> &);
  template typename Motion<3>::Nodal
  Motion<3>::map_to_nodes(const Nodal *);
  template typename Motion<3>::NodeValues
  Motion<3>::mean_of_bodies(
    const std::function<Tensor<1, 3>(const unsigned int, const unsigned int)>
      &);
  template void
  Motion<3>::set_accelerations(const LA::Vector &);
  template void
  Motion<3>::interpolate(const NodeValues &,
                         const PointField<3, Tensor<1, 3>> &);
} // namespace moraine
