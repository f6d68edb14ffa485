// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_block_mass_h
#define moraine_state_block_mass_h

#include <moraine/basis/stencil.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <vector>

namespace moraine
{
  /**
   * The mass matrix of a batch of points: the consistent one, @f$M_{ab} =
   * \sum_p m_p N_a N_b@f$, whose rows and columns of some nodes are lumped, so
   * that sums of rows stay. With the set L of these nodes,
   *
   * @f[ M_{aa} = \sum_p m_p N_a \quad (a \in L), \qquad
   *     M_{ab} = \sum_p m_p N_a (N_b + \delta_{ab} \sum_{c \in L} N_c)
   *     \quad (a, b \notin L). @f]
   *
   * L has all nodes, or those that have less than a thousandth of the mass of
   * another one of the batch, unless functions are negative somewhere. With the
   * consistent mass of a point, such a node would have the point's motion
   * divided by its small @f$N_a@f$.
   */
  template <int dim>
  class BlockMass
  {
  public:
    /** @p mass gives that of a point. */
    template <class Mass>
    void
    find_lumped(const StencilBlock<dim> &block,
                const Mass              &mass,
                const bool               all)
    {
      constexpr double share = 1e-3;
      lumped.assign(block.n_nodes, all);
      any = all;
      if (all)
        return;
      bool negative = false;
      of_nodes.assign(block.n_nodes, 0.);
      for (unsigned int p = 0; p < block.n_points; ++p)
        {
          const double m = mass(block.points[p]);
          for (unsigned int a = 0; a < block.n_nodes; ++a)
            {
              of_nodes[a] += m * block.N(p)[a];
              negative = negative || block.N(p)[a] < 0;
            }
        }
      if (negative)
        return;
      const double limit =
        share * *std::max_element(of_nodes.begin(), of_nodes.end());
      for (unsigned int a = 0; a < block.n_nodes; ++a)
        {
          lumped[a] = of_nodes[a] < limit;
          any       = any || lumped[a];
        }
    }

    /** The share of a point with functions @p N in the product with @p u, over
     * its mass: row a has @f$N_a@f$ times @p rows[a]. */
    void
    multiply(const double                              *N,
             const std::vector<dealii::Tensor<1, dim>> &u,
             std::vector<dealii::Tensor<1, dim>>       &rows) const
    {
      const unsigned int     n = lumped.size();
      dealii::Tensor<1, dim> of_point;
      rows.resize(n);
      if (!any)
        {
          for (unsigned int a = 0; a < n; ++a)
            of_point += N[a] * u[a];
          std::fill(rows.begin(), rows.end(), of_point);
          return;
        }
      double of_lumped = 0;
      for (unsigned int a = 0; a < n; ++a)
        if (lumped[a])
          of_lumped += N[a];
        else
          of_point += N[a] * u[a];
      for (unsigned int a = 0; a < n; ++a)
        rows[a] = lumped[a] ? u[a] : of_point + of_lumped * u[a];
    }

    /** Add the share of a point of mass @p m to the @p matrix, row by row. */
    void
    add_matrix(const double        *N,
               const double         m,
               std::vector<double> &matrix) const
    {
      const unsigned int n         = lumped.size();
      double             of_lumped = 0;
      for (unsigned int a = 0; any && a < n; ++a)
        of_lumped += lumped[a] ? N[a] : 0.;
      for (unsigned int a = 0; a < n; ++a)
        if (lumped[a])
          matrix[a * n + a] += m * N[a];
        else
          {
            matrix[a * n + a] += m * N[a] * of_lumped;
            for (unsigned int b = 0; b < n; ++b)
              if (!lumped[b])
                matrix[a * n + b] += m * N[a] * N[b];
          }
    }

  private:
    std::vector<double>        of_nodes;
    std::vector<unsigned char> lumped;
    bool                       any = false;
  };
} // namespace moraine

#endif
