// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/load/water.h>

#include <moraine/core/exceptions.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::optional<Expression<dim>>
    optional_expression(const std::string &text,
                        const std::string &section,
                        const std::string &key)
    {
      if (text.empty())
        return {};
      return Expression<dim>(text, place(section, key));
    }



    /** m(q), m'(q), m''(q) of Water. */
    struct Cut
    {
      double value, slope, curvature;
    };



    Cut
    cut(const double q, const double k)
    {
      if (q >= k && q > 0)
        return {q, 1., 0.};
      if (q <= -k)
        return {0., 0., 0.};
      return {(q + k) * (q + k) / (4 * k), (q + k) / (2 * k), 1 / (2 * k)};
    }



    template <int dim>
    Cut
    cut(const typename WaterAt<dim>::Pressure &q, const Tensor<1, dim> &half)
    {
      double k = 0;
      for (unsigned int d = 0; d < dim; ++d)
        k += std::abs(q.gradient[d]) * half[d];
      return cut(q.value, k);
    }



    /** m(q) with its derivatives by place, those of k left out. */
    template <int dim>
    typename WaterAt<dim>::Pressure
    apply(const Cut &m, const typename WaterAt<dim>::Pressure &q)
    {
      typename WaterAt<dim>::Pressure p;
      p.value     = m.value;
      p.gradient  = m.slope * q.gradient;
      p.curvature = m.slope * q.curvature;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = d; e < dim; ++e)
          p.curvature[d][e] += m.curvature * q.gradient[d] * q.gradient[e];
      return p;
    }
  } // namespace



  template <int dim>
  Water<dim>::Water(const WaterTexts &texts)
    : unit_weight(texts.unit_weight)
    , cuts_suction(texts.cuts_suction)
    , level_expression(
        optional_expression<dim>(texts.level, texts.section, "Level"))
    , pressure_expression(
        optional_expression<dim>(texts.pressure, texts.section, "Pressure"))
    , free_level_expression(
        optional_expression<dim>(texts.free_level, texts.section, "Free level"))
  {
    if (!texts.curve.empty())
      curve.emplace(texts.curve, place("Water", "Curve"));
  }



  template <int dim>
  template <typename Function>
  typename WaterAt<dim>::Pressure
  Water<dim>::mean(const Function       &function,
                   const Point<dim>     &x,
                   const Tensor<1, dim> &half,
                   const unsigned int    n_directions)
  {
    // By Simpson's rule along each axis; the difference of both ends is the
    // derivative of the mean along it.
    typename WaterAt<dim>::Pressure q;
    const double                    middle = function(x);
    q.value                                = middle;
    for (unsigned int d = 0; d < n_directions; ++d)
      {
        Point<dim> lower = x, upper = x;
        lower[d] -= half[d];
        upper[d] += half[d];
        const double at_lower = function(lower), at_upper = function(upper);
        const double bend = at_upper - 2 * middle + at_lower;
        q.value += bend / 6;
        q.gradient[d]     = (at_upper - at_lower) / (2 * half[d]);
        q.curvature[d][d] = bend / (half[d] * half[d]);
      }
    return q;
  }



  template <int dim>
  typename WaterAt<dim>::Pressure
  Water<dim>::below(const Expression<dim> &level,
                    const Point<dim>      &x,
                    const Tensor<1, dim>  &half,
                    const double           t) const
  {
    const double gamma = unit_weight;
    auto         q =
      mean([&](const Point<dim> &at) { return gamma * level.value(at, t); },
           x,
           half,
           dim - 1);
    q.value -= gamma * x[dim - 1];
    q.gradient[dim - 1] -= gamma;
    return q;
  }



  template <int dim>
  WaterAt<dim>
  Water<dim>::at(const Point<dim>     &x,
                 const Tensor<1, dim> &half,
                 const double          t) const
  {
    WaterAt<dim> result;
    const auto   q      = level_expression ?
                            below(*level_expression, x, half, t) :
                            mean(
                       [&](const Point<dim> &at) {
                         return pressure_expression->value(at, t);
                       },
                       x,
                       half,
                       dim);
    const Cut    m      = cut<dim>(q, half);
    result.wet          = m.slope;
    result.wet_gradient = m.curvature * q.gradient;
    result.outer        = apply<dim>(m, q);
    result.pore         = cuts_suction ? result.outer : q;
    if (free_level_expression)
      {
        const auto free = below(*free_level_expression, x, half, t);
        result.outer    = apply<dim>(cut<dim>(free, half), free);
      }
    if (curve)
      for (auto *pressure : {&result.pore, &result.outer})
        {
          const double c = factor(t);
          pressure->value *= c;
          pressure->gradient *= c;
          pressure->curvature *= c;
        }
    return result;
  }



  template <int dim>
  double
  Water<dim>::uncut_pressure(const Point<dim> &x, const double t) const
  {
    return level_expression ?
             unit_weight * (level_expression->value(x, t) - x[dim - 1]) :
             pressure_expression->value(x, t);
  }



  template <int dim>
  double
  Water<dim>::pore_pressure(const Point<dim> &x, const double t) const
  {
    const double q = uncut_pressure(x, t);
    return factor(t) * (cuts_suction ? std::max(q, 0.) : q);
  }



  template <int dim>
  double
  Water<dim>::outer_pressure(const Point<dim> &x, const double t) const
  {
    return factor(t) *
           std::max(0.,
                    free_level_expression ?
                      unit_weight *
                        (free_level_expression->value(x, t) - x[dim - 1]) :
                      uncut_pressure(x, t));
  }



  template <int dim>
  std::optional<double>
  Water<dim>::level(const Point<dim> &x, const double t) const
  {
    if (!level_expression)
      return {};
    return level_expression->value(x, t);
  }



  template <int dim>
  std::optional<double>
  Water<dim>::free_level(const Point<dim> &x, const double t) const
  {
    if (!free_level_expression)
      return {};
    return free_level_expression->value(x, t);
  }



  template class Water<2>;
  template class Water<3>;
} // namespace moraine
