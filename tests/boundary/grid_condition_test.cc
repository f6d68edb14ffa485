// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/boundary/condition_agreement.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../core/message.h"

using namespace moraine;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double t_start = 1, t_end = 1.5;

  /** Two conditions on all nodes of a box of the size @p size. */
  struct TwoConditions
  {
    TwoConditions(const double size)
      : mesh(box(size), MPI_COMM_WORLD)
      , space(mesh, 1)
      , conditions(2)
    {
      std::vector<unsigned char> active(mesh.triangulation().n_active_cells(),
                                        0);
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        active[cell->active_cell_index()] = cell->is_locally_owned();
      space.set_active_cells(active);
      for (unsigned int c = 0; c < 2; ++c)
        {
          conditions[c].name      = c == 0 ? "first" : "second";
          conditions[c].component = {{true, true}};
          conditions[c].region =
            dealii::BoundingBox<2>({Point<2>(0, 0), Point<2>(size, size)});
          conditions[c].displacement = [](const Point<2> &, const double) {
            return Tensor<1, 2>();
          };
        }
    }

    static MeshParameters<2>
    box(const double size)
    {
      MeshParameters<2> parameters;
      parameters.upper_corner = Point<2>(size, size);
      parameters.cells        = {4, 4};
      return parameters;
    }

    std::string
    complaint(const unsigned int n_steps = 1, const bool nodes_follow = false)
    {
      return message_of<InputError>([&] {
        check_agreement(
          conditions, space, t_start, t_end, n_steps, nodes_follow);
      });
    }

    BackgroundMesh<2>             mesh;
    GridSpace<2>                  space;
    std::vector<GridCondition<2>> conditions;
  };

  std::function<Tensor<1, 2>(const Point<2> &, const double)>
  along_x(const double rate)
  {
    return [rate](const Point<2> &x, const double t) {
      return Tensor<1, 2>({rate * t * x[1], 0});
    };
  }
} // namespace



TEST(GridConditions, ThoseThatAgree)
{
  for (const double size : {1e-6, 1., 1e6})
    {
      TwoConditions two(size);
      EXPECT_EQ(two.complaint(), "");
      two.conditions[0].displacement = along_x(0.1);
      two.conditions[1].displacement = along_x(0.1 * (1 + 1e-12));
      EXPECT_EQ(two.complaint(), "");
    }
}



TEST(GridConditions, ThoseThatDepartDuringAStep)
{
  for (const double size : {1e-6, 1., 1e6})
    for (const double rate : {0., 0.101, 0.1 * (1 + 1e-6)})
      {
        TwoConditions two(size);
        two.conditions[0].displacement = along_x(0.1);
        two.conditions[1].displacement = along_x(rate);
        const std::string message      = two.complaint();
        EXPECT_EQ(message.find("grid conditions: 'first' and "
                               "'second' prescribe different x displacements "
                               "at ("),
                  0u)
          << message;
        EXPECT_NE(message.find("from t = 1 to t = 1.5"), std::string::npos);
      }
}



TEST(GridConditions, ARotationAndWhatItsFormulaSays)
{
  constexpr double degree = dealii::numbers::PI / 180;
  const Point<2>   centre(0.3, 0.2);
  TwoConditions    two(1.);
  two.conditions[0].motion = RigidMotion<2>(
    {}, [](const double t) { return 10 * t; }, centre);
  // what is at x at the start of the step
  two.conditions[1].displacement = [&](const Point<2> &x, const double t) {
    const double       angle = 10 * (t - t_start) * degree;
    const Tensor<1, 2> r     = x - centre;
    const Tensor<1, 2> turned(
      {std::cos(angle) * r[0] - std::sin(angle) * r[1],
       std::sin(angle) * r[0] + std::cos(angle) * r[1]});
    return turned - r;
  };
  EXPECT_EQ(two.complaint(), "");
  two.conditions[0].motion = RigidMotion<2>(
    {}, [](const double t) { return 10.01 * t; }, centre);
  EXPECT_NE(two.complaint(), "");
}



TEST(GridConditions, NodesThatFollow)
{
  TwoConditions two(1.);
  two.conditions[0].motion = RigidMotion<2>(
    {}, [](const double t) { return 60 * (t - t_start); }, Point<2>());
  two.conditions[1].displacement = [&](const Point<2> &X, const double t) {
    return two.conditions[0].motion.pose(t).map(X) - X;
  };
  EXPECT_EQ(two.complaint(3, true), "");
  EXPECT_NE(two.complaint(3, false), "");

  const auto                pose = two.conditions[0].motion.pose(t_end);
  std::vector<Tensor<1, 2>> turn;
  for (unsigned int node = 0; node < two.space.n_nodes(); ++node)
    turn.push_back(pose.map(two.space.node_position(node)) -
                   two.space.node_position(node));
  two.space.move_nodes(turn);
  for (auto &condition : two.conditions)
    condition.start = t_start;
  EXPECT_EQ(message_of<InputError>(
              [&] { find_prescribed_nodes(two.conditions, two.space, t_end); }),
            "");
}



TEST(GridConditions, RegionsGoWithTheNodes)
{
  const Tensor<1, 2> move({0.3, 0.1});
  const auto         nodes_of = [](const TwoConditions &two) {
    std::vector<unsigned int> nodes;
    for (const auto &entry :
         find_prescribed_nodes<2>({two.conditions[0]}, two.space, t_start)
           .entries)
      nodes.push_back(entry.node);
    return nodes;
  };
  for (const bool by_vertices : {false, true})
    {
      TwoConditions two(1.);
      two.conditions[0].region =
        dealii::BoundingBox<2>({Point<2>(0.7, 0), Point<2>(0.8, 1)});
      const auto before = nodes_of(two);
      EXPECT_GT(before.size(), 0u);
      const Point<2> X = two.space.node_position(0);
      if (by_vertices)
        two.mesh.move_vertices([&](const Point<2> &x) { return x + move; });
      else
        two.space.move_nodes(
          std::vector<Tensor<1, 2>>(two.space.n_nodes(), move));
      EXPECT_LT((two.space.node_position(0) - X - move).norm(), 1e-14);
      EXPECT_EQ((two.space.built_position(0) - X).norm(), 0.);
      EXPECT_EQ(nodes_of(two), before);
    }
}



TEST(GridConditions, OfAStageTheyAgreeFromItsStartOn)
{
  for (const double stage : {0., 1.})
    {
      TwoConditions two(1.);
      two.conditions[0].displacement = [](const Point<2> &, const double t) {
        return Tensor<1, 2>({0.1 * std::min(t, 1.), 0});
      };
      for (auto &condition : two.conditions)
        condition.start = stage;
      const std::string message = message_of<InputError>(
        [&] { find_prescribed_nodes(two.conditions, two.space, t_end); });
      EXPECT_EQ(message.empty(), stage == 1.) << message;
      EXPECT_EQ(two.complaint(), "");
    }
}



TEST(GridConditions, OneComponentEach)
{
  TwoConditions two(1.);
  two.conditions[0].displacement = along_x(0.1);
  two.conditions[0].component    = {{true, false}};
  two.conditions[1].component    = {{false, true}};
  EXPECT_EQ(two.complaint(), "");
}
