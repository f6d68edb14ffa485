// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/boundary_term.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What the least rotation that turns one unit vector to another makes of
     * a vector. */
    template <int dim>
    Tensor<1, dim>
    turned(const Tensor<1, dim> &v,
           const Tensor<1, dim> &from,
           const Tensor<1, dim> &to)
    {
      const Tensor<1, dim> sum = from + to;
      return v - (sum * v) / (1 + from * to) * sum + 2 * (from * v) * to;
    }
  } // namespace



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



  template double
  BoundaryTerm<2>::force_magnitude(const GridSpace<2> &,
                                   const std::vector<HoldingPoint> &) const;
  template double
  BoundaryTerm<3>::force_magnitude(const GridSpace<3> &,
                                   const std::vector<HoldingPoint> &) const;
} // namespace moraine
