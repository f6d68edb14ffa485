// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/load/load.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/state/state.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  ForceOnPoints<2>
  force_at(const Point<2> &place)
  {
    return ForceOnPoints<2>(
      "nail",
      [](const Point<2> &x, const double t) {
        return Tensor<1, 2>({x[0], t});
      },
      place);
  }



  void
  find_points(ForceOnPoints<2> &force, const PointSet<2> &points)
  {
    force.find_points(points, [&points](const unsigned int p) {
      return points.position(p) - points.displacement_field()(points.values(p));
    });
  }



  /** Where the points of all ranks are that the force acts on. */
  std::vector<Point<2>>
  places_of(const ForceOnPoints<2> &force, const PointSet<2> &points)
  {
    std::vector<Point<2>> places;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (force.acts_on(p))
        places.push_back(points.position(p));
    std::vector<Point<2>> all;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(MPI_COMM_WORLD, places))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  }



  /** That the force acts on one point, which is at @p place by now. */
  void
  expect_one_point_at(const Point<2>    &place,
                      ForceOnPoints<2>  &force,
                      const PointSet<2> &points)
  {
    find_points(force, points);
    const auto places = places_of(force, points);
    ASSERT_EQ(places.size(), 1u);
    EXPECT_NEAR(places[0].distance(place), 0., 1e-12);
  }



  TEST(ForceOnPoints, AllThatAreEquallyNearShareIt)
  {
    SmallScene<2> scene;
    auto          force = force_at({2., 2.});
    find_points(force, scene.points);
    const auto places = places_of(force, scene.points);
    ASSERT_EQ(places.size(), 4u);
    for (const Point<2> &x : places)
      EXPECT_NEAR(x.distance({2., 2.}), 0.25 * std::sqrt(2.), 1e-12);
    const Tensor<1, 2> share = force.value({3., 0.}, 8.);
    EXPECT_DOUBLE_EQ(share[0], 0.75);
    EXPECT_DOUBLE_EQ(share[1], 2.);
  }



  TEST(ForceOnPoints, StaysWithThePointThatIsNearest)
  {
    SmallScene<2> scene;
    auto          force = force_at({1.7, 2.3});
    expect_one_point_at({1.75, 2.25}, force, scene.points);

    // Into other cells, some of other ranks.
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      scene.points.set_position(p,
                                scene.points.position(p) +
                                  Tensor<1, 2>({0.6, 0.55}));
    scene.points.find_cells();
    expect_one_point_at({2.35, 2.8}, force, scene.points);
  }



  TEST(ForceOnPoints, ChoosesThePointThatWasNearestAtTheStart)
  {
    SmallScene<2>      scene;
    const Tensor<1, 2> shift({0.6, 0.55});
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        scene.points.set_position(p, scene.points.position(p) + shift);
        scene.points.displacement_field().store(shift, scene.points.values(p));
      }
    scene.points.find_cells();
    auto force = force_at({1.7, 2.3});
    expect_one_point_at({2.35, 2.8}, force, scene.points);
  }



  TEST(ForceOnPoints, PointsGoThroughAnArchive)
  {
    SmallScene<2> scene;
    auto          force = force_at({2., 2.});
    find_points(force, scene.points);
    Archive archive;
    force.write(archive);
    auto copy = force_at({0., 0.});
    copy.read(archive);
    find_points(copy, scene.points);
    const auto places = places_of(force, scene.points);
    const auto copied = places_of(copy, scene.points);
    ASSERT_EQ(copied.size(), 4u);
    for (unsigned int k = 0; k < 4; ++k)
      EXPECT_EQ(copied[k], places[k]);
  }



  TEST(CarriedLoad, PlacesMoveWhenTheStepIsKeptAndGoThroughAnArchive)
  {
    SmallScene<2> scene;
    State<2>      state(scene.space,
                   scene.points,
                   *scene.basis,
                   {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
                   MeshAfterStep::reset);
    state.begin_step();
    const auto push = [](const Point<2> &, const double t) {
      return Tensor<1, 2>({t, 0.});
    };
    CarriedLoad<2> load("push",
                        "point force",
                        push,
                        {{Point<2>(1.5, 2.2), 1.}});
    load.find_cells(scene.space, 0.5);
    load.set_functions(scene.basis->functions_at(load.places()));
    const Tensor<1, 2>              shift({0.3, -0.1});
    const std::vector<Tensor<1, 2>> shifts(scene.space.n_nodes(), shift);
    load.prepare_move(scene.space, shifts, true);
    load.undo();
    load.move();
    EXPECT_EQ(load.places()[0].x, Point<2>(1.5, 2.2));
    load.prepare_move(scene.space, shifts, true);
    load.move();
    EXPECT_LT((load.places()[0].x - (Point<2>(1.5, 2.2) + shift)).norm(),
              1e-14);

    Archive archive;
    load.write(archive);
    CarriedLoad<2> copy("push", "point force", push, {{Point<2>(), 1.}});
    copy.read(archive);
    EXPECT_EQ(copy.places()[0].x, load.places()[0].x);
  }



  TEST(CarriedLoad, BeginsWhereNodesHaveCarriedItsPlacesByThen)
  {
    SmallScene<2> scene;
    State<2>      state(scene.space,
                   scene.points,
                   *scene.basis,
                   {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
                   MeshAfterStep::follow_material);
    state.begin_step();
    const Tensor<1, 2> shift({0.3, -1.4});
    scene.space.move_nodes(
      std::vector<Tensor<1, 2>>(scene.space.n_nodes(), shift));
    const Point<2> X(1.5, 2.2);
    CarriedLoad<2> load("push",
                        "point force",
                        [](const Point<2> &, const double) {
                          return Tensor<1, 2>();
                        },
                        {{X, 1.}});
    for (unsigned int k = 0; k < 2; ++k)
      {
        load.find_cells(scene.space, 0.5);
        EXPECT_LT((load.places()[0].x - (X + shift)).norm(), 1e-14);
      }
  }



  TEST(ForceOnPoints, NeedsAPointNearby)
  {
    SmallScene<2> scene;
    auto          force = force_at({40., 40.});
    EXPECT_THROW(find_points(force, scene.points), InputError);
  }
} // namespace
