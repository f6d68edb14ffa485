// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_block_mass_h
#define moraine_state_block_mass_h

#include <moraine/basis/stencil.h>

#include <deal.II/base/tensor.h>

#include <deal.II/lac/vector.h>

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
      constexpr double   share     = 1e-3;
      constexpr double   round_off = 1e-10;
      const unsigned int n         = block.n_nodes;
      lumped.assign(n, all);
      any = all;
      if (all)
        return;
      of_nodes.assign(n, 0.);
      double least = 0;
      for (unsigned int p = 0; p < block.n_points; ++p)
        {
          const double  m = mass(block.points[p]);
          const double *N = block.N(p);
          for (unsigned int a = 0; a < n; ++a)
            {
              of_nodes[a] += m * N[a];
              least = std::min(least, N[a]);
            }
        }
      if (least < -round_off)
        return;
      const auto [smallest, largest] =
        std::minmax_element(of_nodes.begin(), of_nodes.end());
      const double limit = share * *largest;
      any                = *smallest < limit;
      for (unsigned int a = 0; any && a < n; ++a)
        lumped[a] = of_nodes[a] < limit;
    }

    /** Add @p c times the product of a point of mass one with @p u to nodal
     * forces. */
    void
    add_product(const double                              *N,
                const double                               c,
                const std::vector<dealii::Tensor<1, dim>> &u,
                dealii::Vector<double>                    &force) const
    {
      const unsigned int     n = lumped.size();
      dealii::Tensor<1, dim> u_p;
      double                 of_lumped = 0;
      for (unsigned int a = 0; a < n; ++a)
        if (any && lumped[a])
          of_lumped += N[a];
        else
          u_p += N[a] * u[a];
      for (unsigned int a = 0; a < n; ++a)
        {
          dealii::Tensor<1, dim> row = u_p;
          if (any)
            row = lumped[a] ? u[a] : u_p + of_lumped * u[a];
          for (unsigned int d = 0; d < dim; ++d)
            force[dim * a + d] += c * N[a] * row[d];
        }
    }

    /** The share of a point of mass one in @f$u^T M w@f$. */
    double
    product(const double                              *N,
            const std::vector<dealii::Tensor<1, dim>> &u,
            const std::vector<dealii::Tensor<1, dim>> &w) const
    {
      const unsigned int     n = lumped.size();
      dealii::Tensor<1, dim> u_p, w_p;
      double                 of_lumped = 0, sum = 0;
      for (unsigned int a = 0; a < n; ++a)
        if (any && lumped[a])
          {
            of_lumped += N[a];
            sum += N[a] * (u[a] * w[a]);
          }
        else
          {
            u_p += N[a] * u[a];
            w_p += N[a] * w[a];
          }
      for (unsigned int a = 0; of_lumped > 0 && a < n; ++a)
        if (!lumped[a])
          sum += of_lumped * N[a] * (u[a] * w[a]);
      return sum + u_p * w_p;
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
        {
          const double m_a = m * N[a];
          double      *row = &matrix[a * n];
          if (!any)
            for (unsigned int b = 0; b < n; ++b)
              row[b] += m_a * N[b];
          else if (lumped[a])
            row[a] += m_a;
          else
            {
              row[a] += m_a * of_lumped;
              for (unsigned int b = 0; b < n; ++b)
                if (!lumped[b])
                  row[b] += m_a * N[b];
            }
        }
    }

  private:
    std::vector<double>        of_nodes;
    std::vector<unsigned char> lumped;
    bool                       any = false;
  };
} // namespace moraine

#endif
