// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_stencil_h
#define moraine_basis_stencil_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace moraine
{
  /** The cells that a batch of points touches, and what is the same for all
   * that is in a cell. */
  template <int dim>
  struct CellMeanBlock
  {
    static constexpr unsigned int n_corners = 1u << dim;

    /** None where strains have no part that is the same in a cell. */
    unsigned int n_cells = 0;
    /** The corners of the cells among the nodes of the block, cell major. */
    const unsigned int *places = nullptr;
    /** The parts of the points that each cell stands for, point major; none if
     * there is one cell. */
    const double *shares = nullptr;
    /** @f$b_{ca}@f$, means of gradients at the corners [1/length], cell major.
     */
    std::vector<dealii::Tensor<1, dim>> gradients;

    /** @f$s_{pc}@f$; its sum over cells is 1. */
    double
    share(const unsigned int p, const unsigned int c) const
    {
      return shares ? shares[p * n_cells + c] : 1.;
    }
  };

  /**
   * How a batch of points that touch the same nodes sees the mesh:
   * @f$N_a(x_p)@f$ and @f$\nabla N_a(x_p)@f$ for each point and node. Assembly
   * sees nothing else of a method.
   */
  template <int dim>
  struct StencilBlock
  {
    unsigned int n_points = 0;
    unsigned int n_nodes  = 0;
    /** Functions of the nodes behind them, with their gradients, are zero at
     * all points. */
    unsigned int        n_own_nodes = 0;
    const unsigned int *points      = nullptr; ///< flat point numbers
    const unsigned int *nodes       = nullptr; ///< numbers of the GridSpace
    /** The part of its volume with which each point counts; none if that is
     * all of it. A point may occur more than once then. */
    const double *shares = nullptr;
    /** Of State::evaluate(); reinit() takes them away. */
    CellMeanBlock<dim> means;

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
      n_points      = points_in_block;
      points        = point_numbers;
      n_nodes       = nodes_in_block;
      n_own_nodes   = nodes_in_block;
      nodes         = node_numbers;
      means.n_cells = 0;
      if (values.size() < n_points * n_nodes)
        {
          values.resize(n_points * n_nodes);
          gradients.resize(n_points * n_nodes);
        }
    }

    /**
     * Mix the gradients of points with the means of their cells,
     * @f$\beta \nabla N_a(x_p) + (1-\beta) \sum_c s_{pc} b_{ca}@f$ with
     * @f$\beta@f$ = @p own_share. Gradients of linear functions stay, and so do
     * the forces of uniform stress.
     */
    void
    average_gradients(const double own_share)
    {
      constexpr unsigned int n_corners = CellMeanBlock<dim>::n_corners;
      for (unsigned int p = 0; p < n_points; ++p)
        {
          dealii::Tensor<1, dim> *g = &gradients[p * n_nodes];
          for (unsigned int a = 0; a < n_nodes; ++a)
            g[a] *= own_share;
          for (unsigned int c = 0; c < means.n_cells; ++c)
            {
              const double        part   = (1 - own_share) * means.share(p, c);
              const unsigned int *places = &means.places[c * n_corners];
              const dealii::Tensor<1, dim> *b = &means.gradients[c * n_corners];
              for (unsigned int a = 0; a < n_corners; ++a)
                g[places[a]] += part * b[a];
            }
        }
      n_own_nodes = n_nodes;
    }

    /** Have the @p n_longer nodes of @p longer, which begins with the nodes of
     * the block; functions of the others are zero at all points. */
    void
    append_nodes(const unsigned int n_longer, const unsigned int *longer)
    {
      const unsigned int n = n_nodes;
      if (values.size() < n_points * n_longer)
        {
          values.resize(n_points * n_longer);
          gradients.resize(n_points * n_longer);
        }
      // From the end, so that nothing is overwritten before it has moved.
      for (unsigned int p = n_points; p-- > 0;)
        for (unsigned int a = n_longer; a-- > 0;)
          {
            values[p * n_longer + a] = a < n ? values[p * n + a] : 0.;
            gradients[p * n_longer + a] =
              a < n ? gradients[p * n + a] : dealii::Tensor<1, dim>();
          }
      n_nodes = n_longer;
      nodes   = longer;
    }
  };
} // namespace moraine

#endif
