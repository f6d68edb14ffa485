// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_cell_shapes_h
#define moraine_mesh_cell_shapes_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace moraine
{
  /**
   * The shape functions of FE_Q(degree), degree 1 or 2, at one place of a cell
   * whose geometry is given by its nodes (isoparametric),
   * @f$x(\xi) = \sum_a N_a(\xi) X_a@f$. Nodes are numbered lexicographically.
   *
   * deal.II's FEValues evaluates many points of one cell at once after a set-up
   * that costs more than a handful of points; here a point costs what its
   * (degree+1)^dim products cost. The values agree with FE_Q (tested).
   */
  template <int dim, int degree>
  class CellShapes
  {
  public:
    static constexpr unsigned int n_nodes =
      (dim == 2 ? 1 : degree + 1) * (degree + 1) * (degree + 1);

    /**
     * Evaluate at the unit cell's place @p xi of a cell with nodes @p X: the
     * n_nodes values @p N, @f$N_a@f$, and gradients in real space @p grad_N,
     * @f$\nabla N_a@f$ [1/length].
     */
    static void
    evaluate(const dealii::Point<dim> &xi,
             const dealii::Point<dim> *X,
             double                   *N,
             dealii::Tensor<1, dim>   *grad_N);

    /** Values alone. */
    static void
    values(const dealii::Point<dim> &xi, double *N);

    /**
     * The place @f$\xi@f$ with @f$x(\xi) = x@f$, also outside the cell, by
     * Newton's method from the middle, or from @p start. For many places of
     * one cell and degree 1 there is CellInverse.
     */
    static dealii::Point<dim>
    inverse(const dealii::Point<dim> &x,
            const dealii::Point<dim> *X,
            const dealii::Point<dim> &start = middle());

    /** @f$\partial x / \partial \xi@f$ at @p xi of a cell with nodes @p X. */
    static dealii::Tensor<2, dim>
    jacobian(const dealii::Point<dim> &xi, const dealii::Point<dim> *X);

    /** Of the unit cell. */
    static dealii::Point<dim>
    middle()
    {
      dealii::Point<dim> xi;
      for (unsigned int d = 0; d < dim; ++d)
        xi[d] = 0.5;
      return xi;
    }

  private:
    /** Values and derivatives of the 1D Lagrange functions on [0,1]. */
    static void
    line(const double xi, double *value, double *derivative)
    {
      if constexpr (degree == 1)
        {
          value[0]      = 1 - xi;
          value[1]      = xi;
          derivative[0] = -1;
          derivative[1] = 1;
        }
      else
        {
          static_assert(degree == 2);
          value[0]      = (1 - xi) * (1 - 2 * xi);
          value[1]      = 4 * xi * (1 - xi);
          value[2]      = xi * (2 * xi - 1);
          derivative[0] = 4 * xi - 3;
          derivative[1] = 4 - 8 * xi;
          derivative[2] = 4 * xi - 1;
        }
    }

    /** Values and unit-cell gradients. */
    static void
    unit_cell(const dealii::Point<dim> &xi,
              double                   *N,
              dealii::Tensor<1, dim>   *unit_gradients)
    {
      double value[dim][degree + 1], derivative[dim][degree + 1];
      for (unsigned int d = 0; d < dim; ++d)
        line(xi[d], value[d], derivative[d]);
      unsigned int a = 0;
      for (unsigned int k = 0; k < (dim == 3 ? degree + 1 : 1); ++k)
        for (unsigned int j = 0; j <= degree; ++j)
          for (unsigned int i = 0; i <= degree; ++i, ++a)
            {
              const double Nk      = (dim == 3 ? value[dim - 1][k] : 1.);
              N[a]                 = value[0][i] * value[1][j] * Nk;
              unit_gradients[a][0] = derivative[0][i] * value[1][j] * Nk;
              unit_gradients[a][1] = value[0][i] * derivative[1][j] * Nk;
              if constexpr (dim == 3)
                unit_gradients[a][2] =
                  value[0][i] * value[1][j] * derivative[2][k];
            }
    }
  };



  template <int dim, int degree>
  inline void
  CellShapes<dim, degree>::evaluate(const dealii::Point<dim> &xi,
                                    const dealii::Point<dim> *X,
                                    double                   *N,
                                    dealii::Tensor<1, dim>   *grad_N)
  {
    unit_cell(xi, N, grad_N);
    dealii::Tensor<2, dim> J;
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          J[i][j] += X[a][i] * grad_N[a][j];
    const dealii::Tensor<2, dim> inverse_J = dealii::invert(J);
    for (unsigned int a = 0; a < n_nodes; ++a)
      grad_N[a] = grad_N[a] * inverse_J;
  }



  template <int dim, int degree>
  inline void
  CellShapes<dim, degree>::values(const dealii::Point<dim> &xi, double *N)
  {
    dealii::Tensor<1, dim> unit_gradients[n_nodes];
    unit_cell(xi, N, unit_gradients);
  }



  template <int dim, int degree>
  inline dealii::Tensor<2, dim>
  CellShapes<dim, degree>::jacobian(const dealii::Point<dim> &xi,
                                    const dealii::Point<dim> *X)
  {
    double                 N[n_nodes];
    dealii::Tensor<1, dim> unit_gradients[n_nodes];
    unit_cell(xi, N, unit_gradients);
    dealii::Tensor<2, dim> J;
    for (unsigned int a = 0; a < n_nodes; ++a)
      J +=
        dealii::outer_product(dealii::Tensor<1, dim>(X[a]), unit_gradients[a]);
    return J;
  }



  template <int dim, int degree>
  inline dealii::Point<dim>
  CellShapes<dim, degree>::inverse(const dealii::Point<dim> &x,
                                   const dealii::Point<dim> *X,
                                   const dealii::Point<dim> &start)
  {
    dealii::Point<dim>     xi = start;
    double                 N[n_nodes];
    dealii::Tensor<1, dim> unit_gradients[n_nodes];
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        unit_cell(xi, N, unit_gradients);
        dealii::Tensor<1, dim> residual = x;
        dealii::Tensor<2, dim> J;
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            residual -= N[a] * X[a];
            J += dealii::outer_product(dealii::Tensor<1, dim>(X[a]),
                                       unit_gradients[a]);
          }
        const dealii::Tensor<1, dim> step = dealii::invert(J) * residual;
        xi += step;
        // Steps shrink to their squares; far from the origin round-off of x
        // keeps them from shrinking further.
        if (step.norm_square() < 1e-20)
          break;
      }
    return xi;
  }
} // namespace moraine

#endif
