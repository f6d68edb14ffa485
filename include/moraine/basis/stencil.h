// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_stencil_h
#define moraine_basis_stencil_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace moraine
{
  /**
   * How a batch of points that touch the same nodes sees the mesh:
   * @f$N_a(x_p)@f$ and @f$\nabla N_a(x_p)@f$ for each point and node. Assembly
   * sees nothing else of a method.
   */
  template <int dim>
  struct StencilBlock
  {
    unsigned int        n_points = 0;
    unsigned int        n_nodes  = 0;
    const unsigned int *points   = nullptr; ///< flat point numbers
    const unsigned int *nodes    = nullptr; ///< node numbers of the GridSpace
    /** The part of its volume with which each point counts; none if that is
     * all of it. A point may occur more than once then. */
    const double *shares = nullptr;

    /** @f$N_a@f$ of the points, point major. */
    std::vector<double> values;
    /** @f$\nabla N_a@f$ of the points, point major [1/length]. */
    std::vector<dealii::Tensor<1, dim>> gradients;

    /** The n_nodes values of the p-th point of the block. */
    const double *
    N(const unsigned int p) const
    {
      return &values[p * n_nodes];
    }

    /** The n_nodes gradients of the p-th point of the block. */
    const dealii::Tensor<1, dim> *
    grad_N(const unsigned int p) const
    {
      return &gradients[p * n_nodes];
    }

    double
    share(const unsigned int p) const
    {
      return shares ? shares[p] : 1.;
    }

    void
    reinit(const unsigned int  points_in_block,
           const unsigned int *point_numbers,
           const unsigned int  nodes_in_block,
           const unsigned int *node_numbers)
    {
      n_points = points_in_block;
      points   = point_numbers;
      n_nodes  = nodes_in_block;
      nodes    = node_numbers;
      if (values.size() < n_points * n_nodes)
        {
          values.resize(n_points * n_nodes);
          gradients.resize(n_points * n_nodes);
        }
    }
  };
} // namespace moraine

#endif
