// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/bodies_of_nodes.h>

#include <algorithm>
#include <numeric>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::vector<unsigned int>
    from_soft_to_stiff(const State<dim> &state, const unsigned int n_bodies)
    {
      std::vector<double> stiffness(n_bodies);
      for (unsigned int b = 0; b < n_bodies; ++b)
        {
          const LameConstants C = state.material(b).elastic_stiffness();
          stiffness[b]          = C.lambda + 2 * C.mu;
        }
      std::vector<unsigned int> order(n_bodies);
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](const unsigned int a, const unsigned int b) {
                         return stiffness[a] < stiffness[b];
                       });
      return order;
    }



    /** 1 at the nodes that points of this rank in body @p b touch. */
    template <int dim>
    std::vector<Tensor<1, dim>>
    touched_nodes(const State<dim> &state, const unsigned int b)
    {
      std::vector<Tensor<1, dim>> touched(state.grid().n_nodes());
      StencilBlock<dim>           block;
      for (unsigned int g = 0; g < state.point_basis().n_batches(); ++g)
        {
          state.point_basis().evaluate(g, block);
          if (std::any_of(block.points,
                          block.points + block.n_points,
                          [&](const unsigned int p) {
                            return state.material_points().body(p) == b;
                          }))
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                touched[block.nodes[a]][c] = 1;
        }
      return touched;
    }
  } // namespace



  template <int dim>
  BodiesOfNodes
  find_bodies_of_nodes(const State<dim> &state, const unsigned int n_bodies)
  {
    const GridSpace<dim> &space = state.grid();
    BodiesOfNodes         bodies;
    bodies.of_node.assign(space.n_nodes(), 0);
    if (n_bodies == 1)
      return bodies;
    LA::Vector sums = space.vector();
    bodies.of_unknown.assign(sums.locally_owned_size(), 0);
    for (const unsigned int b : from_soft_to_stiff(state, n_bodies))
      {
        std::vector<Tensor<1, dim>> touched = touched_nodes(state, b);
        space.sum_node_values(touched, sums);
        space.node_values(sums, touched);
        for (unsigned int node = 0; node < space.n_nodes(); ++node)
          if (touched[node][0] > 0)
            bodies.of_node[node] = b;
        unsigned int k = 0;
        for (const auto dof : space.locally_owned())
          {
            if (sums(dof) > 0)
              bodies.of_unknown[k] = b;
            ++k;
          }
      }
    return bodies;
  }



  template BodiesOfNodes
  find_bodies_of_nodes(const State<2> &, const unsigned int);
  template BodiesOfNodes
  find_bodies_of_nodes(const State<3> &, const unsigned int);
} // namespace moraine
