// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/body_parts.h>

#include <deal.II/base/mpi.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cstdint>
#include <map>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the largest gradient at a point; its square is the stiffness. */
    constexpr double felt = 1e-3;



    using DisjointSets = boost::disjoint_sets_with_storage<>;



    /** A body, a node by its first unknown, volume and moments of volume. */
    struct Sum
    {
      std::uint64_t         node;
      unsigned int          body;
      std::array<double, 4> moments;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &node;
        archive &body;
        archive &moments;
      }
    };



    /** The parts this rank sees, and the nodes that belong to them. */
    struct LocalParts
    {
      std::vector<Sum> sums; ///< at the root of each part
      /** Pairs of nodes of a body that hang together. */
      std::vector<std::array<std::uint64_t, 3>> joints;
    };



    template <int dim>
    LocalParts
    find_local_parts(const GridSpace<dim> &space,
                     const PointSet<dim>  &points,
                     const Basis<dim>     &basis,
                     const unsigned int    n_bodies)
    {
      const std::size_t          n_nodes = space.n_nodes();
      DisjointSets               sets(n_bodies * n_nodes);
      std::vector<unsigned char> touched(n_bodies * n_nodes, 0);
      std::map<std::size_t, std::array<double, 4>>      moments_at;
      std::vector<std::pair<std::size_t, unsigned int>> home;
      StencilBlock<dim>                                 block;
      for (unsigned int g = 0; g < basis.n_batches(); ++g)
        {
          basis.evaluate(g, block);
          for (unsigned int i = 0; i < block.n_points; ++i)
            {
              const unsigned int    p        = block.points[i];
              const Tensor<1, dim> *gradient = block.grad_N(i);
              unsigned int          first    = 0;
              for (unsigned int a = 1; a < block.n_nodes; ++a)
                if (gradient[a].norm_square() > gradient[first].norm_square())
                  first = a;
              const std::size_t of_body = points.body(p) * n_nodes;
              const double limit = felt * felt * gradient[first].norm_square();
              for (unsigned int a = 0; a < block.n_nodes; ++a)
                if (gradient[a].norm_square() > limit)
                  {
                    sets.union_set(of_body + block.nodes[a],
                                   of_body + block.nodes[first]);
                    touched[of_body + block.nodes[a]] = 1;
                  }
              home.emplace_back(of_body + block.nodes[first], p);
            }
        }
      for (const auto &[node, p] : home)
        {
          std::array<double, 4> &moments = moments_at[sets.find_set(node)];
          moments[0] += points.volume(p);
          for (unsigned int d = 0; d < dim; ++d)
            moments[d + 1] += points.volume(p) * points.position(p)[d];
        }
      LocalParts         parts;
      const unsigned int n_ranks =
        Utilities::MPI::n_mpi_processes(space.communicator());
      for (const auto &[root, moments] : moments_at)
        parts.sums.push_back({space.node_dof(root % n_nodes),
                              static_cast<unsigned int>(root / n_nodes),
                              moments});
      if (n_ranks > 1)
        for (std::size_t i = 0; i < touched.size(); ++i)
          if (touched[i])
            parts.joints.push_back(
              {{i / n_nodes,
                space.node_dof(i % n_nodes),
                space.node_dof(sets.find_set(i) % n_nodes)}});
      return parts;
    }
  } // namespace



  template <int dim>
  std::vector<std::vector<BodyPart<dim>>>
  parts_of_bodies(const GridSpace<dim> &space,
                  const PointSet<dim>  &points,
                  const Basis<dim>     &basis,
                  const unsigned int    n_bodies)
  {
    const LocalParts local = find_local_parts(space, points, basis, n_bodies);
    const std::uint64_t n_dofs = space.n_dofs();
    DisjointSets        sets(n_bodies * n_dofs);
    for (const auto &of_rank :
         Utilities::MPI::all_gather(space.communicator(), local.joints))
      for (const auto &[body, a, b] : of_rank)
        sets.union_set(body * n_dofs + a, body * n_dofs + b);

    std::map<std::size_t, std::array<double, 4>> moments_at;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(space.communicator(), local.sums))
      for (const Sum &sum : of_rank)
        {
          auto &moments =
            moments_at[sets.find_set(sum.body * n_dofs + sum.node)];
          for (unsigned int k = 0; k < moments.size(); ++k)
            moments[k] += sum.moments[k];
        }

    std::vector<std::vector<BodyPart<dim>>> parts(n_bodies);
    for (const auto &[root, moments] : moments_at)
      {
        BodyPart<dim> part;
        part.volume = moments[0];
        for (unsigned int d = 0; d < dim; ++d)
          part.centre[d] = moments[d + 1] / moments[0];
        parts[root / n_dofs].push_back(part);
      }
    for (auto &of_body : parts)
      std::sort(of_body.begin(),
                of_body.end(),
                [](const BodyPart<dim> &a, const BodyPart<dim> &b) {
                  return a.volume > b.volume;
                });
    return parts;
  }



#define INSTANTIATE(dim) \
  template decltype(parts_of_bodies<dim>) parts_of_bodies<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
