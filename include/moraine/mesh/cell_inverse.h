// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_cell_inverse_h
#define moraine_mesh_cell_inverse_h

#include <moraine/mesh/cell_map.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <optional>

namespace moraine
{
  /**
   * The inverse map from places in and near one cell to its unit box, for many
   * places. With @f$\eta = \xi - \tfrac12@f$ the multilinear map is
   * @f$x = \sum_m c_m \prod_{d \in m} \eta_d@f$, a sum over all sets m of
   * directions: means and differences of the vertices make the @f$c_m@f$ once,
   * and an iteration of Newton's method costs their few products.
   */
  template <int dim>
  class CellInverse
  {
  public:
    explicit CellInverse(const CellVertices<dim> &cell)
      : c(cell)
    {
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int m = 0; m < c.size(); ++m)
          if (((m >> d) & 1u) == 0)
            {
              const dealii::Point<dim> lower = c[m], upper = c[m | (1u << d)];
              c[m]             = lower + 0.5 * (upper - lower);
              c[m | (1u << d)] = dealii::Point<dim>(upper - lower);
            }
    }

    /**
     * The place @f$\xi@f$ with @f$x(\xi) = x@f$, to round-off. Nothing where
     * Newton's method comes across @f$\det \partial x/\partial \xi \le 0@f$ or
     * does not converge, as can happen for places outside and for vertices that
     * make no convex cell, or hardly one.
     */
    std::optional<dealii::Point<dim>>
    operator()(const dealii::Point<dim> &x) const;

  private:
    /**
     * Columns of the Jacobian at @p eta.
     * @return the place there, less c[0].
     */
    dealii::Tensor<1, dim>
    evaluate(const dealii::Tensor<1, dim> &eta,
             dealii::Tensor<1, dim>       *columns) const;

    /** c_m, bit d of the index m telling whether direction d is in the set. */
    CellVertices<dim> c;
  };



  template <int dim>
  inline dealii::Tensor<1, dim>
  CellInverse<dim>::evaluate(const dealii::Tensor<1, dim> &eta,
                             dealii::Tensor<1, dim>       *columns) const
  {
    dealii::Tensor<1, dim> place;
    if constexpr (dim == 2)
      for (unsigned int k = 0; k < dim; ++k)
        {
          columns[0][k] = c[1][k] + c[3][k] * eta[1];
          columns[1][k] = c[2][k] + c[3][k] * eta[0];
          place[k]      = columns[0][k] * eta[0] + c[2][k] * eta[1];
        }
    else
      for (unsigned int k = 0; k < dim; ++k)
        {
          const double xy = c[3][k] + c[7][k] * eta[2];
          const double z  = c[4][k] + c[5][k] * eta[0] + c[6][k] * eta[1];
          columns[0][k]   = c[1][k] + xy * eta[1] + c[5][k] * eta[2];
          columns[1][k]   = c[2][k] + xy * eta[0] + c[6][k] * eta[2];
          columns[2][k]   = z + c[7][k] * eta[0] * eta[1];
          place[k] =
            (c[1][k] + xy * eta[1]) * eta[0] + c[2][k] * eta[1] + z * eta[2];
        }
    return place;
  }



  template <int dim>
  inline std::optional<dealii::Point<dim>>
  CellInverse<dim>::operator()(const dealii::Point<dim> &x) const
  {
    // After a correction this small the next one is lost in round-off.
    constexpr double       small_square = 1e-18;
    constexpr unsigned int enough       = 20;

    const dealii::Tensor<1, dim> target = x - c[0];
    dealii::Tensor<1, dim>       eta, J[dim];
    for (unsigned int iteration = 0; iteration < enough; ++iteration)
      {
        const dealii::Tensor<1, dim> r = target - evaluate(eta, J);
        dealii::Tensor<1, dim>       step;
        double                       det;
        if constexpr (dim == 2)
          {
            det     = J[0][0] * J[1][1] - J[0][1] * J[1][0];
            step[0] = r[0] * J[1][1] - r[1] * J[1][0];
            step[1] = J[0][0] * r[1] - J[0][1] * r[0];
          }
        else
          {
            const auto J12 = dealii::cross_product_3d(J[1], J[2]);
            const auto Jr  = dealii::cross_product_3d(J[0], r);
            det            = J[0] * J12;
            step[0]        = r * J12;
            step[1]        = Jr * J[2];
            step[2]        = -(Jr * J[1]);
          }
        if (!(det > 0))
          return {};
        step /= det;
        eta += step;
        if (step.norm_square() < small_square)
          {
            for (unsigned int d = 0; d < dim; ++d)
              eta[d] += 0.5;
            return dealii::Point<dim>(eta);
          }
      }
    return {};
  }
} // namespace moraine

#endif
