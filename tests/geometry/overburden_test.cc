// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/overburden.h>
#include <moraine/geometry/shapes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace
{
  using namespace dealii;
  using namespace moraine;

  const BoundingBox<2> mesh_box(std::make_pair(Point<2>(0, 0),
                                               Point<2>(20, 30)));
  const Tensor<1, 2>   up = Point<2>(0, 1);

  ShapePointer<2>
  box(const double x0, const double y0, const double x1, const double y1)
  {
    return make_box<2>(Point<2>(x0, y0), Point<2>(x1, y1));
  }



  TEST(Overburden, Layers)
  {
    // Layers whose tops cut cells, and a body beside.
    const Overburden<2> ground({box(0, 0, 10, 4.3),
                                box(0, 4.3, 10, 9.7),
                                box(10, 0, 20, 25)},
                               mesh_box,
                               1.);
    const auto column = ground.above(Point<2>(3, 1.1), 0, up, {18, 20, 16})[0];
    EXPECT_NEAR(column.pressure, 18 * 3.2 + 20 * 5.4, 1e-11);
    EXPECT_EQ(column.top, 1u);
    EXPECT_NEAR(column.surface[1], 9.7, 1e-12);
    // Of a body with limits in the mesh and one that reaches to its end.
    EXPECT_NEAR(ground.above(Point<2>(15, 24), 2, up, {18, 20, 16})[0].pressure,
                16.,
                1e-12);
  }



  TEST(Overburden, MeansBesideAnEdgeAboveThePlace)
  {
    // Fills that stand side by side, and one beside a cliff.
    const Overburden<2> ground(
      {box(0, 0, 10, 4), box(0, 4, 3, 9), box(3, 4, 5, 8)}, mesh_box, 1.);
    const auto mean = [&](const double x) {
      const auto columns = ground.above(Point<2>(x, 1), 0, up, {10, 20, 30});
      EXPECT_EQ(columns.size(), 2u);
      return (columns[0].pressure + columns[1].pressure) / 2;
    };
    EXPECT_NEAR(mean(3), 30 + (20 * 5 + 30 * 4) / 2., 1e-10);
    EXPECT_NEAR(mean(5), 30 + 30 * 4 / 2., 1e-10);
    EXPECT_EQ(ground.above(Point<2>(3.001, 1), 0, up, {10, 20, 30}).size(), 1u);

    // Four columns that meet in a line.
    std::vector<ShapePointer<3>> quarters;
    for (const double x : {0., 2.})
      for (const double y : {0., 2.})
        quarters.push_back(
          make_box<3>(Point<3>(x, y, 0), Point<3>(x + 2, y + 2, 1. + x + y)));
    const Overburden<3> block(quarters,
                              BoundingBox<3>({Point<3>(), Point<3>(4, 4, 8)}),
                              1.);
    double              sum     = 0;
    const auto          columns = block.above(Point<3>(2, 2, 0.5),
                                     0,
                                     Tensor<1, 3>({0, 0, 1}),
                                     {1, 1, 1, 1});
    EXPECT_EQ(columns.size(), 4u);
    for (const auto &column : columns)
      sum += column.pressure;
    EXPECT_NEAR(sum / 4, 0.5 + (0 + 2 + 2 + 4) / 4., 1e-10);
  }



  TEST(Overburden, EndsAtAGap)
  {
    const Overburden<2> ground({box(0, 0, 10, 4), box(0, 5, 10, 9), nullptr},
                               mesh_box,
                               1.);
    const auto column = ground.above(Point<2>(3, 1), 0, up, {10, 10, 10})[0];
    EXPECT_NEAR(column.pressure, 30., 1e-12);
    EXPECT_EQ(column.top, 0u);

    // A slip of drawing is none.
    const Overburden<2> slip({box(0, 0, 10, 4), box(0, 4.005, 10, 9), nullptr},
                             mesh_box,
                             1.);
    EXPECT_NEAR(slip.above(Point<2>(3, 1), 0, up, {10, 10, 10})[0].pressure,
                79.95,
                1e-9);
  }



  TEST(Overburden, InclinedSurfaceAndGravity)
  {
    // Below y = 5 + x/2.
    const std::shared_ptr<const Shape<2>> slope = make_polygon<2>(
      {Point<2>(0, 0), Point<2>(20, 0), Point<2>(20, 15), Point<2>(0, 5)});
    const Overburden<2> ground({slope}, mesh_box, 1.);
    EXPECT_NEAR(ground.above(Point<2>(7, 2), 0, up, {10})[0].pressure,
                10 * (5 + 3.5 - 2),
                1e-11);
    // Along its normal it is the distance from the surface.
    const Tensor<1, 2> normal = Point<2>(-1, 2) / std::sqrt(5.);
    EXPECT_NEAR(ground.above(Point<2>(7, 2), 0, normal, {10})[0].pressure,
                10 * (5 + 3.5 - 2) * 2 / std::sqrt(5.),
                1e-11);
  }



  TEST(Overburden, EndsWithTheMesh)
  {
    // A body without limits in a box and in a mesh with an inclined top.
    const Overburden<2> in_box({make_space<2>()}, mesh_box, 1.);
    EXPECT_NEAR(in_box.above(Point<2>(7, 2), 0, up, {10})[0].pressure,
                280,
                1e-10);
    const Overburden<2> in_mesh({make_space<2>()},
                                mesh_box,
                                1.,
                                {{{Point<2>(0, 5), Point<2>(10, 10)}},
                                 {{Point<2>(10, 10), Point<2>(20, 15)}},
                                 {{Point<2>(0, 0), Point<2>(20, 0)}}});
    for (const double x : {7., 10., 13.})
      EXPECT_NEAR(in_mesh.above(Point<2>(x, 2), 0, up, {10})[0].pressure,
                  10 * (5 + x / 2 - 2),
                  1e-10);
  }



  TEST(Overburden, ThreeDimensions)
  {
    const BoundingBox<3> box_3d(
      std::make_pair(Point<3>(0, 0, 0), Point<3>(4, 4, 4)));
    const Overburden<3> ground(
      {make_box<3>(Point<3>(0, 0, 0), Point<3>(4, 4, 3))}, box_3d, 0.5);
    Tensor<1, 3> z;
    z[2] = 1;
    EXPECT_NEAR(ground.above(Point<3>(1, 1, 0.2), 0, z, {10})[0].pressure,
                28,
                1e-12);
    const Overburden<3> in_mesh(
      {make_space<3>()},
      box_3d,
      0.5,
      {{{Point<3>(0, 0, 2), Point<3>(4, 0, 2), Point<3>(0, 4, 2)}},
       {{Point<3>(4, 4, 2), Point<3>(4, 0, 2), Point<3>(0, 4, 2)}}});
    EXPECT_NEAR(in_mesh.above(Point<3>(1, 3, 0.2), 0, z, {10})[0].pressure,
                18,
                1e-11);
  }
} // namespace
