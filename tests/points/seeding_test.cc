// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/shapes.h>
#include <moraine/points/point_list.h>
#include <moraine/points/seeding.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

using namespace moraine;
using dealii::Point;
using dealii::Tensor;

namespace
{
  template <int dim>
  std::vector<SeededPoint<dim>>
  seed_mesh(const CellSeeder<dim> &seeder,
            const Shape<dim>      &shape,
            const unsigned int     n,
            const double           lower,
            const double           h,
            const double           bend = 0.)
  {
    std::vector<SeededPoint<dim>> points;
    for (unsigned int c = 0; c < std::pow(n, dim); ++c)
      {
        CellVertices<dim> cell;
        for (unsigned int v = 0; v < cell.size(); ++v)
          {
            unsigned int rest = c;
            for (unsigned int d = 0; d < dim; ++d, rest /= n)
              cell[v][d] = lower + h * (rest % n + ((v >> d) & 1));
            const Point<dim> x = cell[v];
            for (unsigned int d = 0; d < dim; ++d)
              cell[v][d] += bend * h * std::sin(9. * x[(d + 1) % dim]);
          }
        seeder.seed(cell, shape, points);
      }
    return points;
  }

  template <int dim>
  double
  total(const std::vector<SeededPoint<dim>> &points)
  {
    double sum = 0.;
    for (const auto &point : points)
      sum += point.volume;
    return sum;
  }

  // the message of what read_point_file() says about a file of this text
  template <int dim>
  std::string
  complaint(const std::string &text)
  {
    const std::string name =
      testing::TempDir() + "moraine_points_" +
      std::to_string(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) +
      ".csv";
    std::ofstream(name) << text;
    std::string message = "none";
    try
      {
        read_point_file<dim>(name);
      }
    catch (const InputError &error)
      {
        message       = error.what();
        const auto at = message.find(name);
        EXPECT_NE(at, std::string::npos) << message;
        if (at != std::string::npos)
          message.replace(at, name.size(), "FILE");
      }
    std::remove(name.c_str());
    return message;
  }
} // namespace



TEST(Seeding, VolumesSumUpToTheBody)
{
  const auto flat =
    make_moved<2>(make_box<2>(Point<2>(0., 0.), Point<2>(1., 0.5)),
                  Placement<2>(30., Point<2>(0.3, 0.1), {}, {}));
  const auto solid = make_moved<3>(
    make_box<3>(Point<3>(), Point<3>(1., 0.5, 0.7)),
    Placement<3>(30., Point<3>(), Tensor<1, 3>({1., 2., 3.}), {}));
  for (const PointLayout layout : {PointLayout::gauss, PointLayout::equal})
    for (const unsigned int n : {1, 2, 3})
      {
        const CellSeeder<2> seeder(n, layout);
        EXPECT_NEAR(total(seed_mesh(seeder, *flat, 14, -0.51, 0.13)) / 0.5,
                    1.,
                    1e-12);
        EXPECT_NEAR(total(seed_mesh(seeder, *flat, 14, -0.51, 0.13, 0.15)) /
                      0.5,
                    1.,
                    1e-12);
        EXPECT_NEAR(
          total(seed_mesh(CellSeeder<3>(n, layout), *solid, 8, -0.61, 0.27)) /
            0.35,
          1.,
          1e-12);
      }
  EXPECT_NEAR(total(seed_mesh(CellSeeder<2>(2, PointLayout::equal),
                              *make_ball<2>(Point<2>(0.2, 0.1), 0.7),
                              15,
                              -0.8,
                              0.13)) /
                (0.49 * dealii::numbers::PI),
              1.,
              1e-12);
}



TEST(Seeding, FacesOfSubCellsOfGaussPoints)
{
  for (const unsigned int n : {1, 3, 4})
    {
      const dealii::QGauss<1> line(n);
      const CellSeeder<2>     seeder(n, PointLayout::gauss);
      double                  start = 0, longest = 0;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double x   = line.point(i)[0];
          const double end = start + line.weight(i);
          longest          = std::max(longest, line.weight(i));
          EXPECT_NEAR(seeder.distance_to_faces(Point<2>(0.5, x))[1],
                      std::min(x - start, end - x),
                      1e-14);
          start = end;
        }
      EXPECT_NEAR(seeder.longest_edge(), longest, 1e-14);
    }
  const CellSeeder<3> equal(5, PointLayout::equal);
  EXPECT_NEAR(equal.longest_edge(), 0.2, 1e-15);
  EXPECT_NEAR(equal.distance_to_faces(Point<3>(0.1, 0.25, 0.99))[1],
              0.05,
              1e-15);
}



TEST(Seeding, FullCellWithGaussLayoutIsTheGaussRule)
{
  const auto everywhere = make_box<2>(Point<2>(-9., -9.), Point<2>(9., 9.));
  const dealii::QGauss<2> rule(3);
  const auto              points =
    seed_mesh(CellSeeder<2>(3, PointLayout::gauss), *everywhere, 1, 0.5, 2.);
  ASSERT_EQ(points.size(), 9u);
  for (unsigned int q = 0; q < 9; ++q)
    {
      const Point<2> expected(0.5 + 2. * rule.point(q)[0],
                              0.5 + 2. * rule.point(q)[1]);
      EXPECT_LT(points[q].position.distance(expected), 1e-15);
      EXPECT_NEAR(points[q].volume, 4. * rule.weight(q), 1e-15);
    }

  // a taper: x = xi (1 + eta), so detJ = 1 + eta
  std::vector<SeededPoint<2>> tapered;
  CellSeeder<2>(2, PointLayout::gauss)
    .seed({{{0., 0.}, {1., 0.}, {0., 1.}, {2., 1.}}}, *everywhere, tapered);
  const double g = 0.5 + 0.5 / std::sqrt(3.);
  ASSERT_EQ(tapered.size(), 4u);
  EXPECT_NEAR(tapered[3].position[0], g * (1. + g), 1e-15);
  EXPECT_NEAR(tapered[3].volume, 0.25 * (1. + g), 1e-15);
}



TEST(Seeding, AlignedBodyIsNotClippedByRoundOff)
{
  // 0.1 * 3 is not 0.3: faces agree with the mesh to round-off only
  const auto body = make_box<2>(Point<2>(0.3, 0.3), Point<2>(0.7, 0.6));
  for (const PointLayout layout : {PointLayout::gauss, PointLayout::equal})
    {
      const auto points =
        seed_mesh(CellSeeder<2>(2, layout), *body, 10, 0., 0.1);
      EXPECT_EQ(points.size(), 48u);
      EXPECT_NEAR(total(points), 0.12, 1e-15);
    }
}



TEST(Seeding, ClippedPointsAreCentroids)
{
  const auto body = make_box<2>(Point<2>(0.25, 0.), Point<2>(1., 1.));
  std::vector<SeededPoint<2>> points;
  CellSeeder<2>(2, PointLayout::gauss)
    .seed({{{0., 0.}, {1., 0.}, {0., 1.}, {1., 1.}}}, *body, points);
  ASSERT_EQ(points.size(), 4u);
  EXPECT_NEAR(points[0].position[0], 0.375, 1e-15);
  EXPECT_NEAR(points[0].position[1], 0.25, 1e-15);
  EXPECT_NEAR(points[0].volume, 0.125, 1e-15);
  // in a cut cell full sub-cells too
  EXPECT_NEAR(points[1].position[0], 0.75, 1e-15);
}



TEST(Seeding, TrilinearGradientsOfCutCellsAreIntegrated)
{
  // A gradient holds 1, x, y, z, xy, yz and zx; the first four are integrated
  // by any centroid. On cells of a grid of boxes the last three add up.
  const auto body =
    make_moved<3>(make_box<3>(Point<3>(), Point<3>(1., 0.5, 0.7)),
                  Placement<3>(30.,
                               Point<3>(),
                               Tensor<1, 3>({1., 2., 3.}),
                               Tensor<1, 3>({0.4, 0.3, 0.3})));
  const auto products = [&](const unsigned int n) {
    std::array<double, 3> sums{};
    for (const auto &point :
         seed_mesh(CellSeeder<3>(n, PointLayout::equal), *body, 3, -0.5, 1.))
      for (unsigned int d = 0; d < 3; ++d)
        sums[d] +=
          point.volume * point.position[d] * point.position[(d + 1) % 3];
    return sums;
  };
  // int x_i x_j of the body: its principal moments, turned, about its centre
  const Placement<3> turn(30., Point<3>(), Tensor<1, 3>({1., 2., 3.}), {});
  const Point<3>     c =
    turn.map(Point<3>(0.5, 0.25, 0.35)) + Tensor<1, 3>({0.4, 0.3, 0.3});
  const std::array<double, 3> length{{1., 0.5, 0.7}};
  for (const unsigned int n : {1, 2, 3})
    {
      const auto sums = products(n);
      for (unsigned int d = 0; d < 3; ++d)
        {
          const unsigned int e     = (d + 1) % 3;
          double             exact = c[d] * c[e];
          for (unsigned int k = 0; k < 3; ++k)
            exact += turn.rotation()[d][k] * turn.rotation()[e][k] * length[k] *
                     length[k] / 12.;
          EXPECT_NEAR(sums[d], 0.35 * exact, 1e-14);
        }
    }
}



TEST(Seeding, PointsOfCutCellsLieInBodyAndCell)
{
  const auto body =
    make_half_space<3>(Point<3>(0.31, 0.27, 0.4), Tensor<1, 3>({1., 2., 3.}));
  std::vector<SeededPoint<3>> points;
  const CellSeeder<3>         seeder(2, PointLayout::equal);
  seeder.seed(CellVertices<3>{{{0., 0., 0.},
                               {1., 0., 0.},
                               {0., 1., 0.},
                               {1., 1., 0.},
                               {0., 0., 1.},
                               {1., 0., 1.},
                               {0., 1., 1.},
                               {1., 1., 1.}}},
              *body,
              points);
  EXPECT_GT(points.size(), 8u);
  EXPECT_LE(points.size(), seeder.max_points());
  for (const auto &point : points)
    {
      EXPECT_TRUE(body->contains(point.position));
      for (unsigned int d = 0; d < 3; ++d)
        {
          EXPECT_GT(point.position[d], 0.);
          EXPECT_LT(point.position[d], 1.);
        }
    }
}



TEST(Seeding, ThinBodyKeepsItsVolume)
{
  // a wire whose section is 1e-14 of a cell face
  const auto wire =
    make_box<3>(Point<3>(0., 0.5, 0.5), Point<3>(3., 0.5 + 1e-7, 0.5 + 1e-7));
  const double section = std::pow((0.5 + 1e-7) - 0.5, 2);
  EXPECT_NEAR(
    total(seed_mesh(CellSeeder<3>(1, PointLayout::equal), *wire, 3, 0., 1.)) /
      (3. * section),
    1.,
    1e-7);
}



TEST(PointFile, ReadsPointsAndSkipsFurtherColumns)
{
  const std::string name =
    testing::TempDir() + "moraine_good_points_" +
    std::to_string(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) +
    ".csv";
  std::ofstream(name)
    << "x, y, z, volume, age\r\n1,2,3,0.5,7\r\n\n4,5,6,1e-3,8";
  const auto points = read_point_file<3>(name);
  std::remove(name.c_str());
  ASSERT_EQ(points.positions.size(), 2u);
  EXPECT_EQ(points.positions[1], Point<3>(4., 5., 6.));
  EXPECT_EQ(points.volumes[1], 1e-3);
  EXPECT_EQ(points.origin(1), name + ":4");
}



TEST(PointFile, BadRowsAreNamed)
{
  EXPECT_EQ(complaint<2>("x,y,volume\n1,2,3\n\n1,abc,3\n"),
            "FILE:4: column 'y': found 'abc'. Allowed: a finite number");
  EXPECT_EQ(complaint<2>("x,y,volume\n1,nan,3\n"),
            "FILE:2: column 'y': found 'nan'. Allowed: a finite number");
  EXPECT_EQ(complaint<2>("x,y,volume\n1,2 m,3\n"),
            "FILE:2: column 'y': found '2 m'. Allowed: a finite number");
  EXPECT_EQ(complaint<2>("x,y,volume\n1,2\n"),
            "FILE:2: found 2 values. Allowed: 3, one for each column of the "
            "header");
  EXPECT_EQ(complaint<2>("x,y,volume\n1,2,3,\n"),
            "FILE:2: found 4 values. Allowed: 3, one for each column of the "
            "header");
  EXPECT_EQ(complaint<2>("x,y,volume\n1,2,0\n"),
            "FILE:2: column 'volume': found '0'. Allowed: a number > 0");
  EXPECT_EQ(complaint<3>("x,y,volume\n1,2,3\n"),
            "FILE:1: found the header 'x,y,volume'. Allowed in 3D: "
            "x,y,z,volume and, if wanted, names of more columns");
  EXPECT_EQ(complaint<2>("x,y,volume,a,a\n1,2,3,4,5\n"),
            "FILE:1: the column name 'a' is given twice");
  EXPECT_EQ(complaint<2>("x,y,volume\n"),
            "The point file 'FILE' has no points.");
  EXPECT_THROW(read_point_file<2>("/nowhere/points.csv"), InputError);
}
