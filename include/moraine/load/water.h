// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_load_water_h
#define moraine_load_water_h

#include <moraine/core/expression.h>
#include <moraine/points/point_fields.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** Texts of what is known of the water in a stage; empty where nothing is. */
  struct WaterTexts
  {
    std::string level;
    std::string pressure;
    std::string free_level;
    std::string curve;
    std::string section; ///< of messages
    bool        cuts_suction = true;
    double      unit_weight  = 0; ///< [force/length^dim]
  };

  /** Water in and around a point. Pressures are positive in compression. */
  template <int dim>
  struct WaterAt
  {
    /** A pressure and how it changes with the place of the point. */
    struct Pressure
    {
      double                          value = 0;
      dealii::Tensor<1, dim>          gradient;
      dealii::SymmetricTensor<2, dim> curvature;
    };

    Pressure               pore;    ///< @f$p_w@f$
    Pressure               outer;   ///< @f$p_r@f$, of the water outside
    double                 wet = 0; ///< the part below the phreatic line
    dealii::Tensor<1, dim> wet_gradient;
  };

  /**
   * Given pore water pressures @f$p_w(x, t)@f$ in the bodies, and @f$p_r(x,
   * t)@f$ in the water around them. As a level is given, it is a height of the
   * last coordinate with hydrostatic pressure below it.
   *
   * A point has the mean over a box of its own size. So the force on a point is
   * continuous as it crosses the level. With the mean q of the uncut pressure
   * and the span @f$\pm k = \sum_d |\partial_d q|\, h_d@f$ that it has in the
   * box of half lengths h,
   * @f[ p = m(q) = q \text{ for } q \ge k, \quad 0 \text{ for } q \le -k,
   *     \quad (q + k)^2 / 4k \text{ between;} \qquad
   *     \text{wet part: } m'(q) . @f]
   * That is exact where the gradient is along one axis.
   */
  template <int dim>
  class Water
  {
  public:
    /** @throw InputError for texts that cannot be understood. */
    explicit Water(const WaterTexts &texts);

    /** Around a point at @p x in a box of these @p half lengths. @throws
     * InputError naming place and key if a value is no number there. */
    WaterAt<dim>
    at(const dealii::Point<dim>     &x,
       const dealii::Tensor<1, dim> &half,
       const double                  t) const;

    /** The uncut pressure, which is negative above the phreatic line. */
    double
    uncut_pressure(const dealii::Point<dim> &x, const double t) const;

    /** Pore pressure at a place. */
    double
    pore_pressure(const dealii::Point<dim> &x, const double t) const;

    /** Pressure of the water outside at a place of the surface. */
    double
    outer_pressure(const dealii::Point<dim> &x, const double t) const;

    /** Height of the phreatic line at @p x, if it is given by one. */
    std::optional<double>
    level(const dealii::Point<dim> &x, const double t) const;

    /** Height of the water outside; none where it is that of the pores. */
    std::optional<double>
    free_level(const dealii::Point<dim> &x, const double t) const;

  private:
    using Number = std::optional<Expression<dim>>;

    double unit_weight;
    bool   cuts_suction;

    /** The mean of a function over the box, and how it changes. */
    template <typename Function>
    static typename WaterAt<dim>::Pressure
    mean(const Function               &function,
         const dealii::Point<dim>     &x,
         const dealii::Tensor<1, dim> &half,
         const unsigned int            n_directions);

    /** The uncut pressure below the height given by @p level. */
    typename WaterAt<dim>::Pressure
    below(const Expression<dim>        &level,
          const dealii::Point<dim>     &x,
          const dealii::Tensor<1, dim> &half,
          const double                  t) const;

    /** By which pressures are multiplied. */
    double
    factor(const double t) const
    {
      return curve ? curve->value(t) : 1.;
    }

    Number level_expression, pressure_expression, free_level_expression;
    std::optional<TimeCurve> curve;
  };

  /** Water of a scene: what there is by now, and what points keep of it. */
  template <int dim>
  struct WaterInBodies
  {
    /** None where a stage has none. */
    std::optional<Water<dim>> water;
    /** By body: what it weighs more below the phreatic line than above
     * [mass/length^dim]. */
    std::vector<double> extra_density;
    /** Pressure and total stress, in the layout of points. */
    PointField<dim, double>                        pore_pressure;
    PointField<dim, dealii::SymmetricTensor<2, 3>> total_stress;
  };
} // namespace moraine

#endif
