// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shapes.h>
#include <moraine/points/moment_fitting.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace moraine;
using dealii::Point;
using dealii::Tensor;

namespace
{
  double
  factorial(const unsigned int n)
  {
    return std::tgamma(n + 1.);
  }

  template <int dim>
  double
  power(const Point<dim> &x, const std::array<unsigned int, dim> &exponent)
  {
    double value = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      value *= std::pow(x[d], exponent[d]);
    return value;
  }

  /** Whether the rule meets exact(exponents) for all up to the degree. */
  template <int dim, typename Exact>
  void
  check_moments(const dealii::Quadrature<dim> &rule,
                const Shape<dim>              &shape,
                const unsigned int             degree,
                const Exact                   &exact)
  {
    const unsigned int n_moments = std::pow(degree + 1, dim);
    ASSERT_GT(rule.size(), 0u);
    EXPECT_LE(rule.size(), n_moments);
    for (unsigned int m = 0; m < n_moments; ++m)
      {
        std::array<unsigned int, dim> exponent;
        unsigned int                  rest = m;
        for (unsigned int d = 0; d < dim; ++d, rest /= degree + 1)
          exponent[d] = rest % (degree + 1);
        double sum = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
          sum += rule.weight(q) * power<dim>(rule.point(q), exponent);
        EXPECT_NEAR(sum / exact(exponent), 1., 1e-10);
      }
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        EXPECT_GT(rule.weight(q), 0.);
        EXPECT_TRUE(shape.contains(rule.point(q)));
      }
  }

  /** The simplex sum x_d < s cut from the unit cell. */
  template <int dim>
  void
  check_simplex(const double s)
  {
    Tensor<1, dim> normal;
    Point<dim>     lower, upper, place;
    for (unsigned int d = 0; d < dim; ++d)
      {
        normal[d] = 1.;
        upper[d]  = 1.;
        place[d]  = s / dim;
      }
    const auto                    shape = make_half_space<dim>(place, normal);
    std::vector<SignedPiece<dim>> pieces;
    shape->add_pieces(ConvexPolytope<dim>(lower, upper), 1., pieces);
    const auto rule = moment_fitted_rule<dim>(pieces,
                                              *shape,
                                              std::pow(s, dim) / factorial(dim),
                                              3);
    check_moments<dim>(rule, *shape, 3, [s](const auto &exponent) {
      double       value = 1.;
      unsigned int sum   = dim;
      for (const unsigned int e : exponent)
        {
          value *= factorial(e);
          sum += e;
        }
      return value / factorial(sum) * std::pow(s, sum);
    });
  }
} // namespace

TEST(MomentFitting, CornerOfACell)
{
  check_simplex<2>(1.);
  check_simplex<2>(1e-4);
  check_simplex<3>(1.);
  check_simplex<3>(1e-2);
}

TEST(MomentFitting, PiecesMayBeSubtracted)
{
  const auto box = [](const double size) {
    return make_box<2>(Point<2>(), Point<2>(size, size));
  };
  const auto angle = combine<2>(Operation::subtract, box(2.), box(0.5));
  std::vector<SignedPiece<2>> pieces;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      angle->add_pieces(ConvexPolytope<2>(Point<2>(i / 3., j / 3.),
                                          Point<2>((i + 1) / 3., (j + 1) / 3.)),
                        1.,
                        pieces);
  const auto rule = moment_fitted_rule<2>(pieces, *angle, 0.75, 3);
  check_moments<2>(rule, *angle, 3, [](const auto &exponent) {
    double whole = 1., hole = 1.;
    for (const unsigned int e : exponent)
      {
        whole /= e + 1.;
        hole *= std::pow(0.5, e + 1.) / (e + 1.);
      }
    return whole - hole;
  });
}
