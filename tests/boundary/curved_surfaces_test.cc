// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/curved_surfaces.h>
#include <moraine/boundary/rigid_motion.h>
#include <moraine/core/exceptions.h>

#include <gtest/gtest.h>

#include "surface_cases.h"

using namespace dealii;
using namespace moraine;
using namespace moraine_tests;

namespace
{
  const double pi = dealii::numbers::PI;

  template <int dim>
  double
  relative_error(const Surface<dim> &surface,
                 const Cells<dim>   &cells,
                 const unsigned int  n_gauss,
                 const double        exact)
  {
    return std::abs(measure(all_pieces(surface, cells, n_gauss)) / exact - 1.);
  }
} // namespace

TEST(Arc, LengthIsExactAtRandomPlaces)
{
  for (const double distortion : {0., 0.2})
    {
      const auto cells = box_cells<2>(9, 10., distortion);
      Numbers    random(11);
      for (unsigned int i = 0; i < 500; ++i)
        {
          const double r     = random.between(0.1, 3.);
          const double start = random.between(-400., 400.),
                       sweep = random.between(1., 360.);
          const Point<2> c   = random.point<2>(3.1, 6.9);
          const Arc      arc(c, r, i % 2, start, start + sweep);
          const auto     points = all_pieces(arc, cells, 2);
          EXPECT_NEAR(measure(points), r * sweep * pi / 180., 1e-13 * 10.);
          for (const auto &p : points)
            {
              EXPECT_NEAR(arc.level(p.x), 0., 1e-14);
              EXPECT_TRUE(arc.in_extent(p.x));
              EXPECT_TRUE(arc.bounding_box().point_inside(p.x, 1e-12));
              EXPECT_NEAR(
                (p.normal - (i % 2 ? 1. : -1.) * (p.x - c) / r).norm(),
                0.,
                1e-13);
            }
        }
    }
}

TEST(Arc, PiecesLieInTheirCells)
{
  const auto cells = box_cells<2>(9, 10., 0.2);
  const Arc  arc({4.7, 5.2}, 3.3, true);
  for (const auto &cell : cells)
    {
      std::vector<SurfacePoint<2>> points;
      arc.pieces(cell, 3, points);
      for (const auto &p : points)
        EXPECT_TRUE(inside_cell(cell, p.x, 1e-13));
    }
}

TEST(Arc, TangentToMeshLinesAndThroughVertices)
{
  // centres and radii on the mesh, and off it by next to nothing
  const auto cells = box_cells<2>(10, 10., 0.);
  for (const double offset : {0., 1e-16, 1e-15, -1e-15, 1e-12, 1e-9, -1e-7})
    for (const bool inside : {false, true})
      for (const double r : {0.25, 0.5, 1., 2., 3., std::sqrt(2.), 5.})
        {
          const Arc    arc({5. + offset, 5. - offset},
                        r - std::abs(offset),
                        inside);
          const double exact = 2. * pi * (r - std::abs(offset));
          // only a circle that leaves the mesh by round-off may lose a little
          EXPECT_NEAR(measure(all_pieces(arc, cells, 2)) / exact,
                      1.,
                      r == 5. ? 1e-6 : 1e-13)
            << offset << ' ' << r;
        }
}

TEST(Arc, IntegratesAlongTheCurve)
{
  // the area by the divergence theorem, exact to the Gauss rule in the angle
  const auto cells = box_cells<2>(9, 10., 0.2);
  const Arc  arc({4.7, 5.2}, 3.3, true);
  double     area = 0.;
  for (const auto &p : all_pieces(arc, cells, 5))
    area += 0.5 * p.JxW * (p.normal * p.x);
  EXPECT_NEAR(area / (pi * 3.3 * 3.3), 1., 1e-13);
}

TEST(Arc, ExtentAndMistakes)
{
  const Arc quarter({1., 1.}, 2., false, -45., 45.);
  EXPECT_TRUE(quarter.in_extent({2., 1.}));
  EXPECT_FALSE(quarter.in_extent({0., 1.}));
  EXPECT_DOUBLE_EQ(quarter.level({4., 1.}), 1.);
  EXPECT_NEAR(quarter.bounding_box().upper_bound(0), 3., 1e-15);
  EXPECT_NEAR(quarter.bounding_box().lower_bound(0), 1. + std::sqrt(2.), 1e-15);
  EXPECT_THROW(Arc({0., 0.}, 0., true), InputError);
  EXPECT_THROW(Arc({0., 0.}, 1., true, 90., 90.), InputError);
  EXPECT_THROW(Arc({0., 0.}, 1., true, 0., 361.), InputError);
}

TEST(Sphere, CircleByTheGenerator)
{
  // error of the length at r/h = 3.3; order 2n in the cell size
  const Sphere<2> circle({5.03, 4.96}, 3.3, true);
  const double    exact = 2. * pi * 3.3;
  for (const double distortion : {0., 0.2})
    {
      const auto coarse = box_cells<2>(10, 10., distortion),
                 fine   = box_cells<2>(40, 10., distortion);
      for (unsigned int n = 1; n <= 4; ++n)
        std::printf("circle, distortion %.1f, %u points: %.2e %.2e\n",
                    distortion,
                    n,
                    relative_error<2>(circle, coarse, n, exact),
                    relative_error<2>(circle, fine, n, exact));
    }
}

TEST(Sphere, Area)
{
  const Sphere<3> sphere({1.03, 0.96, 1.01}, 0.7, false);
  const double    exact = 4. * pi * 0.49;
  for (const double distortion : {0., 0.1})
    {
      const auto coarse = box_cells<3>(6, 2., distortion),
                 fine   = box_cells<3>(12, 2., distortion);
      for (unsigned int n = 1; n <= 4; ++n)
        std::printf("sphere, distortion %.1f, %u points: %.2e %.2e\n",
                    distortion,
                    n,
                    relative_error<3>(sphere, coarse, n, exact),
                    relative_error<3>(sphere, fine, n, exact));
    }
}

TEST(Cylinder, Area)
{
  const double       exact = 2. * pi * 0.6 * 1.1;
  const auto         cells = box_cells<3>(8, 2., 0.);
  const Cylinder     along({1.03, 0.96, 0.37}, {1.03, 0.96, 1.47}, 0.6, true);
  const Tensor<1, 3> axis = Point<3>(1., 2., 3.) / std::sqrt(14.);
  const Point<3>     middle(1.01, .99, 1.02);
  const Cylinder tilted(middle - .55 * axis, middle + .55 * axis, 0.6, true);
  for (unsigned int n = 2; n <= 4; ++n)
    std::printf("cylinder, %u points: along %.2e, tilted %.2e\n",
                n,
                relative_error<3>(along, cells, n, exact),
                relative_error<3>(tilted, cells, n, exact));
}

TEST(ExpressionSurface, AgreesWithTheCircle)
{
  const std::string          text = "3.3 - sqrt((x-5.03)^2 + (y-4.96)^2)";
  const ExpressionSurface<2> circle(text),
    half(text, BoundingBox<2>({{0., 4.96}, {10., 10.}}));
  for (const double distortion : {0., 0.2})
    {
      const auto cells = box_cells<2>(10, 10., distortion);
      for (unsigned int n = 2; n <= 4; ++n)
        std::printf("expression, %u points: %.2e, half %.2e\n",
                    n,
                    relative_error<2>(circle, cells, n, 2. * pi * 3.3),
                    relative_error<2>(half, cells, n, pi * 3.3));
    }
}
