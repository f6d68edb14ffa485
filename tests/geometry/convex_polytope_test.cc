// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/convex_polytope.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace moraine;
using dealii::Point;
using dealii::Tensor;

namespace
{
  ConvexPolytope<3>
  unit_cube()
  {
    return {Point<3>(), Point<3>(1., 1., 1.)};
  }

  // a cell with all faces bent, and its right neighbour
  std::array<CellVertices<3>, 2>
  bent_cells()
  {
    std::array<Point<3>, 12> x;
    for (unsigned int i = 0; i < 12; ++i)
      x[i] = Point<3>(i % 3 + 0.1 * std::sin(1. + 3. * i),
                      i / 3 % 2 + 0.1 * std::sin(2. + 5. * i),
                      i / 6 + 0.1 * std::sin(3. + 7. * i));
    std::array<CellVertices<3>, 2> cells;
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int v = 0; v < 8; ++v)
        cells[c][v] = x[c + v % 2 + 3 * (v / 2 % 2) + 6 * (v / 4)];
    return cells;
  }

  // int of detJ over the reference cell: 2^3 Gauss points are exact
  double
  trilinear_volume(const CellVertices<3> &x)
  {
    double sum = 0.;
    for (unsigned int q = 0; q < 8; ++q)
      {
        double xi[3];
        for (unsigned int d = 0; d < 3; ++d)
          xi[d] = 0.5 + ((q >> d & 1) ? 0.5 : -0.5) / std::sqrt(3.);
        Tensor<2, 3> jacobian;
        for (unsigned int v = 0; v < 8; ++v)
          for (unsigned int k = 0; k < 3; ++k)
            {
              double slope = 1.;
              for (unsigned int d = 0; d < 3; ++d)
                slope *= d == k ? ((v >> d & 1) ? 1. : -1.) :
                                  ((v >> d & 1) ? xi[d] : 1. - xi[d]);
              for (unsigned int i = 0; i < 3; ++i)
                jacobian[i][k] += slope * x[v][i];
            }
        sum += dealii::determinant(jacobian) / 8.;
      }
    return sum;
  }
} // namespace



TEST(ConvexPolytope, QuadrilateralAreaAndCentroid)
{
  const ConvexPolytope<2> cell({{{0., 0.}, {2., 0.}, {0., 1.}, {4., 3.}}});
  // two triangles: (0,0) (2,0) (4,3) and (0,0) (4,3) (0,1)
  EXPECT_NEAR(cell.volume(), 3. + 2., 1e-15);
  const Point<2> expected((3. * 2. + 2. * 4. / 3.) / 5.,
                          (3. * 1. + 2. * 4. / 3.) / 5.);
  EXPECT_LT(cell.centroid().distance(expected), 1e-15);
}



TEST(ConvexPolytope, CornerOfCubeCutOff)
{
  auto cube = unit_cube();
  cube.clip(Point<3>(0.5, 0., 0.), Tensor<1, 3>({-1., -1., -1.}));
  EXPECT_NEAR(cube.volume(), 1. / 48., 1e-16);
  EXPECT_LT(cube.centroid().distance(Point<3>(0.125, 0.125, 0.125)), 1e-15);
}



TEST(ConvexPolytope, PlaneThroughFourEdgesAndTwoHalvesMakeTheWhole)
{
  // the plane through the middles of six edges: a regular hexagon
  const Tensor<1, 3>                        normal({1., 1., 1.});
  std::vector<ConvexPolytope<3>::PointList> cut;
  auto one = unit_cube(), other = unit_cube();
  one.clip(Point<3>(0.5, 0.5, 0.5), normal, &cut);
  other.clip(Point<3>(0.5, 0.5, 0.5), -normal);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_EQ(cut[0].size(), 6u);
  EXPECT_NEAR(one.volume(), 0.5, 1e-15);
  EXPECT_NEAR(other.volume(), 0.5, 1e-15);
}



TEST(ConvexPolytope, PlaneThroughVertices)
{
  auto wedge = unit_cube();
  wedge.clip(Point<3>(), Tensor<1, 3>({1., -1., 0.}));
  EXPECT_NEAR(wedge.volume(), 0.5, 1e-16);
  EXPECT_LT(wedge.centroid().distance(Point<3>(2. / 3., 1. / 3., 0.5)), 1e-15);
  EXPECT_EQ(wedge.vertices().size(), 6u);

  auto corner = unit_cube();
  corner.clip(Point<3>(1., 0., 0.), Tensor<1, 3>({-1., -1., -1.}));
  EXPECT_NEAR(corner.volume(), 1. / 6., 1e-16);
  EXPECT_EQ(corner.vertices().size(), 4u);

  ConvexPolytope<2> triangle(Point<2>(), Point<2>(1., 1.));
  triangle.clip(Point<2>(), Tensor<1, 2>({1., -1.}));
  EXPECT_EQ(triangle.vertices().size(), 3u);
  EXPECT_NEAR(triangle.volume(), 0.5, 1e-16);
}



TEST(ConvexPolytope, PlanesThatTouch)
{
  // in a face, an edge and a vertex, within round-off, from both sides
  for (const double shift : {-1e-16, 0., 1e-16})
    for (const Tensor<1, 3> &normal : {Tensor<1, 3>({1., 0., 0.}),
                                       Tensor<1, 3>({1., 1., 0.}),
                                       Tensor<1, 3>({1., 2., 3.})})
      {
        auto       kept = unit_cube(), lost = unit_cube();
        const auto point = Point<3>(shift * normal);
        kept.clip(point, normal);
        lost.clip(point, -normal);
        EXPECT_DOUBLE_EQ(kept.volume(), 1.);
        EXPECT_EQ(kept.vertices().size(), 8u);
        EXPECT_TRUE(lost.empty());
        EXPECT_EQ(lost.volume(), 0.);
      }
}



TEST(ConvexPolytope, ManyCutsStayAdditive)
{
  // each polytope is split by a plane in turn; nothing gets lost
  std::vector<ConvexPolytope<3>> parts{unit_cube()};
  for (unsigned int k = 0; k < 7; ++k)
    {
      const Tensor<1, 3> normal({std::sin(1. + 2. * k),
                                 std::cos(3. * k),
                                 k % 3 == 0 ? 0. : std::sin(5. * k)});
      const Point<3>     point(0.5, 0.3 + 0.05 * k, k % 2 == 0 ? 0. : 0.5);
      std::vector<ConvexPolytope<3>> next;
      for (const auto &part : parts)
        for (const double side : {1., -1.})
          {
            next.push_back(part);
            next.back().clip(point, side * normal);
            if (next.back().empty())
              next.pop_back();
          }
      parts = next;
    }
  EXPECT_GT(parts.size(), 20u);
  double       volume = 0.;
  Tensor<1, 3> first;
  for (const auto &part : parts)
    {
      EXPECT_GE(part.moments(part.centroid()).volume, 0.);
      volume += part.volume();
      first += part.volume() * part.centroid();
    }
  EXPECT_NEAR(volume, 1., 1e-14);
  EXPECT_LT((first - Tensor<1, 3>({0.5, 0.5, 0.5})).norm(), 1e-14);
}



TEST(ConvexPolytope, BentFacesAreWatertightAndExact)
{
  const auto cells = bent_cells();
  for (const auto &vertices : cells)
    {
      const ConvexPolytope<3> cell(vertices);
      const double            exact = trilinear_volume(vertices);
      EXPECT_NEAR(cell.volume(), exact, 1e-14 * exact);
      // the halves of any plane sum up although the cell is not convex
      const Tensor<1, 3> normal({1., 0.3, -0.2});
      auto               one = cell, other = cell;
      one.clip(cell.vertex_mean(), normal);
      other.clip(cell.vertex_mean(), -normal);
      EXPECT_GT(one.volume(), 0.2 * exact);
      EXPECT_NEAR(one.volume() + other.volume(), exact, 1e-14 * exact);
    }
}



TEST(ConvexPolytope, SmallAndFarFromTheOrigin)
{
  const double      h = 1e-3;
  const Point<2>    lower(1000., -2000.);
  ConvexPolytope<2> cell(lower, lower + Tensor<1, 2>({h, h}));
  cell.clip(lower, Tensor<1, 2>({1., -1.}));
  // coordinates carry round-off of 2000 * 1.1e-16 each
  EXPECT_NEAR(cell.volume() / (h * h), 0.5, 1e-9);
  EXPECT_LT(cell.centroid().distance(lower +
                                     Tensor<1, 2>({2. / 3. * h, h / 3.})),
            1e-12);
}



TEST(ConvexPolytope, PullInside)
{
  const ConvexPolytope<2> square(Point<2>(), Point<2>(1., 1.));
  EXPECT_EQ(square.pull_inside(Point<2>(0.9, 0.2)), Point<2>(0.9, 0.2));
  EXPECT_LT(square.pull_inside(Point<2>(1.5, 0.5)).distance(Point<2>(1., 0.5)),
            1e-15);
  EXPECT_LT(unit_cube()
              .pull_inside(Point<3>(0.5, 0.5, -2.))
              .distance(Point<3>(0.5, 0.5, 0.)),
            1e-15);
}
