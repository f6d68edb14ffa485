// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/shapes.h>

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include "surface_cases.h"

using namespace dealii;
using namespace moraine;
using namespace moraine_tests;

namespace
{
  /** Length of the segment a–b inside the box [0, L]². */
  double
  length_in_box(const Point<2> &a, const Point<2> &b, const double L)
  {
    double from = 0., to = 1.;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const double v = b[d] - a[d];
        if (v == 0.)
          {
            if (a[d] < 0. || a[d] > L)
              return 0.;
            continue;
          }
        const double s0 = (0. - a[d]) / v, s1 = (L - a[d]) / v;
        from = std::max(from, std::min(s0, s1));
        to   = std::min(to, std::max(s0, s1));
      }
    return to > from ? (to - from) * a.distance(b) : 0.;
  }

  template <int dim>
  double
  polynomial(const Point<dim> &x, const Tensor<1, dim> &c, const unsigned int p)
  {
    return std::pow(0.3 + (c * x), p);
  }
} // namespace

TEST(Polyline, LengthIsExactAtRandomPlaces)
{
  for (const double distortion : {0., 0.2})
    {
      const auto cells = box_cells<2>(7, 10., distortion);
      Numbers    numbers(3);
      for (unsigned int i = 0; i < 2000; ++i)
        {
          const Point<2> a   = numbers.point<2>(-3., 13.),
                         b   = numbers.point<2>(-3., 13.);
          const auto   line  = make_flat_face<2>({a, b}, i % 2);
          const double exact = length_in_box(a, b, 10.);
          EXPECT_NEAR(measure(all_pieces(*line, cells, 2)), exact, 1e-13 * 20.);
        }
    }
}

TEST(Polyline, AlignedPiecesLieOnceAndOnTheBodySide)
{
  // every mesh line, outer ones included, walked both ways
  const auto cells = box_cells<2>(10, 1., 0.);
  for (unsigned int i = 0; i <= 10; ++i)
    for (const bool vertical : {false, true})
      for (const bool backwards : {false, true})
        {
          const double c = 0.1 * i;
          Point<2>     a = vertical ? Point<2>(c, 0) : Point<2>(0, c),
                   b     = vertical ? Point<2>(c, 1) : Point<2>(1, c);
          if (backwards)
            std::swap(a, b);
          const auto line = make_flat_face<2>({a, b});
          double     sum  = 0.;
          for (const auto &cell : cells)
            {
              std::vector<SurfacePoint<2>> points;
              line->pieces(cell, 2, points);
              if (!points.empty())
                {
                  EXPECT_GT(line->level(centre<2>(cell)), 0.);
                }
              for (const auto &p : points)
                EXPECT_NEAR(line->level(p.x), 0., 1e-15);
              sum += measure(points);
            }
          const bool body_is_low = vertical != backwards;
          const bool outer       = body_is_low ? i == 0 : i == 10;
          EXPECT_NEAR(sum, outer ? 0. : 1., 1e-13)
            << i << vertical << backwards;
        }
}

TEST(Polyline, AlignedUpToRoundOffOnTurnedMeshes)
{
  // a regular mesh turned and shifted; the wall follows one of its lines
  for (unsigned int k = 0; k < 90; ++k)
    {
      const double angle = k * numbers::PI / 45., c = std::cos(angle),
                   s  = std::sin(angle);
      const auto turn = [&](const Point<2> &x) {
        return Point<2>(37.3 + c * x[0] - s * x[1],
                        -12.1 + s * x[0] + c * x[1]);
      };
      auto cells = box_cells<2>(8, 2., 0.);
      for (auto &cell : cells)
        for (auto &v : cell)
          v = turn(v);
      const auto line =
        make_flat_face<2>({turn({0., 0.75}), turn({2., 0.75})}, k % 2);
      double sum = 0.;
      for (const auto &cell : cells)
        {
          std::vector<SurfacePoint<2>> points;
          line->pieces(cell, 1, points);
          if (!points.empty())
            {
              EXPECT_GT(line->level(centre<2>(cell)), 0.);
            }
          sum += measure(points);
        }
      EXPECT_NEAR(sum, 2., 1e-12);
    }
}

TEST(Polyline, ThroughVerticesAndTinyCorners)
{
  // exact to 1e-13 of the size of the coordinates, 2 here
  const auto cells = box_cells<2>(5, 1., 0.);
  for (const double offset : {0.,
                              1e-16,
                              1e-15,
                              1e-13,
                              3e-13,
                              1e-12,
                              1e-11,
                              1e-10,
                              1e-8,
                              1e-4,
                              0.05,
                              0.1999999999})
    for (const bool flip : {false, true})
      {
        const auto diagonal =
          make_flat_face<2>({{-1., -1. + offset}, {2., 2. + offset}}, flip);
        EXPECT_NEAR(measure(all_pieces(*diagonal, cells, 3)),
                    (1. - offset) * std::sqrt(2.),
                    2e-13);
        const auto corner =
          make_flat_face<2>({{-1., 1. + offset}, {1. + offset, -1.}}, flip);
        EXPECT_NEAR(measure(all_pieces(*corner, cells, 3)),
                    offset * std::sqrt(2.),
                    2e-13);
      }
}

TEST(Polyline, PolynomialsCellByCell)
{
  for (const double distortion : {0., 0.2})
    {
      const auto cells = box_cells<2>(6, 1., distortion);
      Numbers    numbers(5);
      for (unsigned int i = 0; i < 50; ++i)
        {
          const Point<2> a = numbers.point<2>(0., 1.),
                         b = numbers.point<2>(0., 1.);
          const auto line  = make_flat_face<2>({a, b});
          const auto c     = numbers.direction<2>();
          for (unsigned int n = 1; n <= 4; ++n)
            for (const auto &cell : cells)
              {
                std::vector<SurfacePoint<2>> few, many;
                line->pieces(cell, n, few);
                line->pieces(cell, 8, many);
                double low = 0., high = 0.;
                for (const auto &p : few)
                  {
                    low += p.JxW * polynomial<2>(p.x, c, 2 * n - 1);
                    EXPECT_TRUE(inside_cell(cell, p.x, 1e-14));
                    EXPECT_NEAR(p.normal.norm(), 1., 1e-15);
                  }
                for (const auto &p : many)
                  high += p.JxW * polynomial<2>(p.x, c, 2 * n - 1);
                EXPECT_NEAR(low, high, 1e-14);
              }
        }
    }
}

TEST(Polyline, LevelNormalAndExtentOfACorner)
{
  // walking east, then north: the body is the quarter up and to the left
  const auto line = make_flat_face<2>({{0, 0}, {2, 0}, {2, 2}});
  EXPECT_DOUBLE_EQ(line->level({1, 0.5}), 0.5);
  EXPECT_DOUBLE_EQ(line->level({1, -0.5}), -0.5);
  EXPECT_DOUBLE_EQ(line->level({3, -1}), -std::sqrt(2.));
  EXPECT_NEAR((line->normal({3, -1}) - Point<2>(1, -1) / std::sqrt(2.)).norm(),
              0.,
              1e-15);
  EXPECT_NEAR((line->normal({1, 0.1}) - Point<2>(0, -1)).norm(), 0., 1e-15);
  EXPECT_TRUE(line->in_extent({1, 0.5}));
  EXPECT_TRUE(line->in_extent({3, -1}));
  EXPECT_TRUE(line->in_extent({0, -1}));
  EXPECT_FALSE(line->in_extent({-0.1, -1}));
  EXPECT_FALSE(line->in_extent({2.1, 2.1}));
  const auto flipped = make_flat_face<2>({{0, 0}, {2, 0}, {2, 2}}, true);
  EXPECT_DOUBLE_EQ(flipped->level({3, -1}), std::sqrt(2.));
  EXPECT_NEAR(measure(all_pieces(*line, box_cells<2>(3, 5., 0.1), 2)),
              4.,
              1e-13);
  EXPECT_THROW(make_flat_face<2>({{0, 0}}), InputError);
  EXPECT_THROW(make_flat_face<2>({{0, 0}, {0, 0}}), InputError);
}

TEST(Polyline, ClosedSquareIsADistance)
{
  const auto square =
    make_flat_face<2>({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
  Numbers numbers(9);
  for (unsigned int i = 0; i < 500; ++i)
    {
      const Point<2> x     = numbers.point<2>(-1., 2.);
      const double   dx    = std::max(-x[0], x[0] - 1.),
                   dy      = std::max(-x[1], x[1] - 1.);
      const double outside = std::hypot(std::max(dx, 0.), std::max(dy, 0.));
      EXPECT_NEAR(square->level(x),
                  std::max(dx, dy) > 0. ? -outside : -std::max(dx, dy),
                  1e-14);
      EXPECT_TRUE(square->in_extent(x));
    }
}

TEST(Plane, LineInTwoDimensions)
{
  const auto cells = box_cells<2>(7, 10., 0.2);
  Numbers    numbers(4);
  for (unsigned int i = 0; i < 500; ++i)
    {
      const Point<2>     p = numbers.point<2>(0., 10.);
      const Tensor<1, 2> n = numbers.direction<2>();
      const Tensor<1, 2> t = Point<2>(-n[1], n[0]);
      EXPECT_NEAR(
        measure(all_pieces(*make_half_space<2>(p, 3. * n)->rim(), cells, 1)),
        length_in_box(p - 50. * t, p + 50. * t, 10.),
        1e-12);
    }
}

TEST(Plane, AreaInACube)
{
  // known sections of the unit cube, on regular and distorted meshes
  for (const double distortion : {0., 0.15})
    {
      const auto cells = box_cells<3>(3, 1., distortion);
      const auto area  = [&](const Point<3> &p, const Tensor<1, 3> &n) {
        return measure(all_pieces(*make_half_space<3>(p, n)->rim(), cells, 2));
      };
      EXPECT_NEAR(area({.5, .5, .5}, Point<3>(1, 1, 1)),
                  .75 * std::sqrt(3.),
                  1e-13);
      EXPECT_NEAR(area({.5, .5, .5}, Point<3>(1, -1, 0)), std::sqrt(2.), 1e-13);
      EXPECT_NEAR(area({.3, .1, .1}, Point<3>(1, 0, 0)), 1., 1e-13);
      for (const double c : {1e-6, 1e-3, 0.2, 1. / 3., 0.7, 1.})
        EXPECT_NEAR(area({c, 0, 0}, Point<3>(1, 1, 1)),
                    std::sqrt(.75) * c * c,
                    1e-13);
    }
}

TEST(Plane, AlignedOnceAndOnTheBodySideIn3D)
{
  const auto cells = box_cells<3>(4, 1., 0.);
  for (unsigned int d = 0; d < 3; ++d)
    for (unsigned int i = 0; i <= 4; ++i)
      for (const double sign : {-1., 1.})
        {
          Point<3> p(.4, .4, .4);
          p[d] = i / 4.;
          const auto plane =
            make_half_space<3>(p, sign * Point<3>::unit_vector(d))->rim();
          double sum = 0.;
          for (const auto &cell : cells)
            {
              std::vector<SurfacePoint<3>> points;
              plane->pieces(cell, 2, points);
              if (!points.empty())
                {
                  EXPECT_GT(plane->level(centre<3>(cell)), 0.);
                  EXPECT_EQ(points.size(), 4u);
                }
              sum += measure(points);
            }
          EXPECT_NEAR(sum, i == (sign > 0 ? 0 : 4) ? 0. : 1., 1e-13);
        }
}

TEST(PlanePatch, AreaAndPolynomialsAtRandomPlaces)
{
  for (const double distortion : {0., 0.15})
    {
      const auto cells = box_cells<3>(4, 1., distortion);
      Numbers    numbers(6);
      for (unsigned int i = 0; i < 60; ++i)
        {
          const Point<3> a       = numbers.point<3>(0., 1.),
                         b       = numbers.point<3>(0., 1.),
                         c       = numbers.point<3>(0., 1.);
          const auto   patch     = make_flat_face<3>({a, b, c}, i % 2);
          const auto   direction = numbers.direction<3>();
          const double area      = 0.5 * cross_product_3d(b - a, c - a).norm();
          for (unsigned int n = 1; n <= 4; ++n)
            {
              const QWitherdenVincentSimplex<2> rule(n);
              double                            exact = 0., sum = 0.;
              for (unsigned int q = 0; q < rule.size(); ++q)
                exact += 2. * area * rule.weight(q) *
                         polynomial<3>(a + rule.point(q)[0] * (b - a) +
                                         rule.point(q)[1] * (c - a),
                                       direction,
                                       2 * n - 1);
              const auto points = all_pieces(*patch, cells, n);
              for (const auto &p : points)
                {
                  sum += p.JxW * polynomial<3>(p.x, direction, 2 * n - 1);
                  EXPECT_GT(p.JxW, 0.);
                  EXPECT_NEAR(patch->level(p.x), 0., 1e-14);
                  EXPECT_TRUE(patch->in_extent(p.x));
                }
              EXPECT_NEAR(measure(points), area, 1e-13);
              EXPECT_NEAR(sum, exact, 1e-13);
            }
        }
    }
}

TEST(PlanePatch, CellsOfARegularMeshKeepTheirOwnPoints)
{
  const auto cells = box_cells<3>(4, 1., 0.);
  Numbers    numbers(8);
  for (unsigned int i = 0; i < 20; ++i)
    {
      const auto plane =
        make_half_space<3>(numbers.point<3>(.2, .8), numbers.direction<3>())
          ->rim();
      for (const auto &cell : cells)
        {
          std::vector<SurfacePoint<3>> few, many;
          plane->pieces(cell, 2, few);
          plane->pieces(cell, 5, many);
          double low = 0., high = 0.;
          for (const auto &p : few)
            {
              low += p.JxW * p.x[0] * p.x[1] * p.x[2];
              for (unsigned int d = 0; d < 3; ++d)
                {
                  EXPECT_GE(p.x[d], cell[0][d] - 1e-14);
                  EXPECT_LE(p.x[d], cell[7][d] + 1e-14);
                }
            }
          for (const auto &p : many)
            high += p.JxW * p.x[0] * p.x[1] * p.x[2];
          EXPECT_NEAR(low, high, 1e-15);
        }
    }
}

TEST(PlanePatch, NonConvexAndOnFaces)
{
  // an L of area 3/4 on the mesh face z = 1/2, the body above or below
  const auto                  cells   = box_cells<3>(4, 1., 0.);
  const std::vector<Point<3>> outline = {
    {0, 0, .5}, {1, 0, .5}, {1, .5, .5}, {.5, .5, .5}, {.5, 1, .5}, {0, 1, .5}};
  for (const bool flip : {false, true})
    {
      const auto patch = make_flat_face<3>(outline, flip);
      EXPECT_NEAR(patch->normal({})[2], flip ? -1. : 1., 1e-15);
      double sum = 0.;
      for (const auto &cell : cells)
        {
          std::vector<SurfacePoint<3>> points;
          patch->pieces(cell, 2, points);
          if (!points.empty())
            {
              EXPECT_GT(patch->level(centre<3>(cell)), 0.);
            }
          sum += measure(points);
        }
      EXPECT_NEAR(sum, .75, 1e-13);
      EXPECT_TRUE(patch->in_extent({.25, .75, 0.}));
      EXPECT_FALSE(patch->in_extent({.75, .75, .5}));
    }
  EXPECT_NEAR(measure(all_pieces(*make_flat_face<3>(outline),
                                 box_cells<3>(3, 1., .15),
                                 3)),
              .75,
              1e-13);
}

TEST(PlanePatch, MistakesAreNamed)
{
  EXPECT_THROW(make_flat_face<3>({{0, 0, 0}, {1, 0, 0}}), InputError);
  EXPECT_THROW(make_flat_face<3>({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}),
               InputError);
  EXPECT_THROW(make_flat_face<3>({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, .1}}),
               InputError);
  EXPECT_THROW(make_flat_face<3>(
                 {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, -.5, 0}}),
               InputError);
}
