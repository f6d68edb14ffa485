// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_linear_fit_h
#define moraine_points_linear_fit_h

#include <moraine/points/point_set.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>

namespace moraine
{
  /**
   * What changes from point to point in a cell as a linear function of place,
   * @f$f(x) = \bar f + g \cdot (x - \bar x)@f$, nearest to the values of the
   * points in the mean square by volume. Along directions in which the points
   * are hardly spread, as in a sliver of a cell, it is constant.
   *
   * @tparam Value a number or a tensor
   */
  template <int dim, typename Value>
  class LinearFit
  {
  public:
    /**
     * @param points of which those in one cell are taken
     * @param in_cell that cell, with a point at least
     * @param place function of the number of a point: where it is
     * @param value the same: what is fitted
     * @param least_spread of points along a direction, the mean of squares
     */
    template <typename Place, typename ValueAt>
    LinearFit(const PointSet<dim>                      &points,
              const typename PointSet<dim>::CellPoints &in_cell,
              const Place                              &place,
              const ValueAt                            &value,
              const double                              least_spread)
    {
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        {
          all += points.volume(p);
          centre += points.volume(p) * place(p);
          mean += points.volume(p) * value(p);
        }
      centre /= all;
      mean /= all;
      dealii::SymmetricTensor<2, dim> spread;
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        {
          const dealii::Tensor<1, dim> away = place(p) - centre;
          spread += points.volume(p) / all *
                    dealii::symmetrize(dealii::outer_product(away, away));
        }
      for (const auto &[square, direction] : dealii::eigenvectors(spread))
        {
          if (square < least_spread)
            continue;
          ++n_spread;
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            {
              const double part = points.volume(p) / all *
                                  ((place(p) - centre) * direction) / square;
              for (unsigned int d = 0; d < dim; ++d)
                slope[d] += part * direction[d] * (value(p) - mean);
            }
        }
    }

    /** The volume of the points. */
    double
    volume() const
    {
      return all;
    }

    /** Whether it follows all directions. */
    bool
    is_complete() const
    {
      return n_spread == dim;
    }

    Value
    at(const dealii::Tensor<1, dim> &x) const
    {
      Value result = mean;
      for (unsigned int d = 0; d < dim; ++d)
        result += (x[d] - centre[d]) * slope[d];
      return result;
    }

    /** By component of place. */
    const std::array<Value, dim> &
    gradient() const
    {
      return slope;
    }

  private:
    double                 all = 0;
    dealii::Tensor<1, dim> centre;
    Value                  mean{};
    std::array<Value, dim> slope{};
    unsigned int           n_spread = 0; ///< directions with points apart
  };
} // namespace moraine

#endif
