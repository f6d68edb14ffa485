// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/points/bodies.h>
#include <moraine/geometry/shapes.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace moraine;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // 8 x 8 cells of size 0.5 from the origin
  MeshParameters<2>
  mesh_parameters()
  {
    MeshParameters<2> parameters;
    parameters.upper_corner = Point<2>(4, 4);
    parameters.cell_size    = 0.5;
    return parameters;
  }

  std::shared_ptr<const Shape<2>>
  box(const Point<2> &lower, const Point<2> &upper)
  {
    return make_box<2>(lower, upper);
  }

  PointList<2>
  points_at(const std::vector<Point<2>> &positions)
  {
    return {positions,
            std::vector<double>(positions.size(), 0.25),
            {},
            {},
            Tensor<2, 2>(),
            [](const unsigned int i) { return "row " + std::to_string(i); }};
  }

  // what seeding these bodies complains about
  std::string
  complaint(const std::vector<Body<2>> &bodies)
  {
    const BackgroundMesh<2> mesh(mesh_parameters(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    try
      {
        seed_bodies(bodies, CellSeeder<2>(2, PointLayout::equal), points);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace



TEST(SeedBodies, NoPointOfAFittedRuleIsLost)
{
  MeshParameters<3> parameters;
  parameters.upper_corner = Point<3>(1, 1, 1);
  parameters.cells        = {4, 4, 4};
  const BackgroundMesh<3> mesh(parameters, MPI_COMM_WORLD);
  PointSet<3>             points(mesh, {});
  const auto              volumes = seed_bodies<3>(
    {{"box",
                   make_box<3>(Point<3>(0.07, 0.1, 0.23), Point<3>(0.73, 0.85, 0.9))}},
    CellSeeder<3>(3, PointLayout::gauss, 2),
    points);
  EXPECT_NEAR(volumes[0], 0.66 * 0.75 * 0.67, 1e-14);
  for (unsigned int p = 0; p < points.n_local(); ++p)
    EXPECT_GT(points.volume(p), 0.);
}



TEST(SeedBodies, VolumesAndIds)
{
  const BackgroundMesh<2> mesh(mesh_parameters(), MPI_COMM_WORLD);
  PointSet<2>             points(mesh, {});
  const auto              turned = make_moved<2>(
    box(Point<2>(0, 0), Point<2>(1.3, 0.7)),
    Placement<2>(33., Point<2>(), Tensor<1, 2>(), Point<2>(0.9, 0.4)));
  const auto volumes =
    seed_bodies({{"turned", turned},
                 {"list", points_at({{3.1, 3.2}, {0.1, 3.9}})},
                 {"box", box(Point<2>(2.6, 0), Point<2>(4, 2))}},
                CellSeeder<2>(2, PointLayout::equal),
                points);
  ASSERT_EQ(volumes.size(), 3u);
  EXPECT_NEAR(volumes[0], 1.3 * 0.7, 1e-14);
  EXPECT_EQ(volumes[1], 0.5);
  EXPECT_NEAR(volumes[2], 2.8, 1e-14);

  // 64 cells with room for 3 bodies of 4 points, then the list
  std::vector<unsigned int> listed, ids;
  for (unsigned int p = 0; p < points.n_local(); ++p)
    {
      ids.push_back(points.id(p));
      if (points.body(p) == 1)
        listed.push_back(points.id(p) - 64 * 3 * 4);
    }
  const auto sorted = [](const std::vector<unsigned int> &mine) {
    std::vector<unsigned int> all;
    for (const auto &some :
         dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(sorted(listed), (std::vector<unsigned int>{0, 1}));
  const auto all = sorted(ids);
  EXPECT_EQ(all.size(), points.n_global());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}



TEST(SeedBodies, RefusesWhatIsNotInTheMesh)
{
  EXPECT_EQ(complaint({{"a", box(Point<2>(1, 1), Point<2>(4, 2))}}), "");
  EXPECT_EQ(complaint({{"a", box(Point<2>(1, 1), Point<2>(5, 2))}}),
            "body 'a': found 25 % of its volume outside the mesh, "
            "which is (0 0) to (4 4), allowed: a body in the mesh; only "
            "half-spaces and expressions are cut by it, and 'Shape = "
            "intersection' with a box cuts others");
  EXPECT_EQ(complaint({{"a", box(Point<2>(5, 1), Point<2>(6, 2))}}),
            "body 'a': found no part of the body inside the mesh, "
            "allowed: a body that is not empty and lies in the mesh");
  EXPECT_EQ(complaint({{"a", points_at({{1, 1}, {4.5, 1}})}}),
            "row 1: found a point at (4.5 1), allowed: points inside the mesh");
}



TEST(SeedBodies, RefusesOverlap)
{
  EXPECT_EQ(complaint({{"a", box(Point<2>(1, 1), Point<2>(2.2, 2))},
                       {"b", box(Point<2>(2.2, 1), Point<2>(3, 2))}}),
            "");
  EXPECT_EQ(complaint({{"a", box(Point<2>(1, 1), Point<2>(2.2, 1.4))},
                       {"b", box(Point<2>(2.1, 1), Point<2>(3, 1.4))}}),
            "bodies: 'a' and 'b' overlap near (2.25 1.25), allowed: "
            "bodies that share no volume");
}



// The common part of two curved shapes comes from subdivision.
TEST(SeedBodies, ALiningFitsIntoItsTunnel)
{
  const auto ground_around = [](const Point<2> &centre) {
    return combine<2>(Operation::subtract,
                      box(Point<2>(0, 0), Point<2>(4, 4)),
                      make_ball<2>(centre, 1.3));
  };
  const Point<2> centre(2.03, 1.93);
  const auto     lining = combine<2>(Operation::hollow_out,
                                 make_ball<2>(centre, 1.3),
                                 make_ball<2>(centre, 1.1));
  EXPECT_EQ(complaint({{"ground", ground_around(centre)}, {"lining", lining}}),
            "");
  EXPECT_NE(complaint({{"ground", ground_around(Point<2>(2.05, 1.93))},
                       {"lining", lining}}),
            "");
}
