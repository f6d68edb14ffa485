// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/implicit_boundary.h>

#include <moraine/geometry/straight_surfaces.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/state/state.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>


#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  const Tensor<1, 2> traction({1., 2.});

  double
  angle(const double t)
  {
    return 10 * t * t;
  }



  /**
   * A line in a body that turns from time 0 to 1, where it is left with the
   * traction, and is then to turn to time 3.
   */
  struct TurningLine
  {
    TurningLine(const Constraint<2>::Kind kind, const StrainMeasure measure)
      : scene(false, 2, measure)
      , state(scene.space,
              scene.points,
              *scene.basis,
              {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
              MeshAfterStep::reset,
              measure)
      , motion({}, angle, Point<2>(2., 2.))
      , line(
          "line",
          std::make_shared<Polyline>(
            std::vector<Point<2>>{{1.9, 1.1}, {2.1, 2.8}}),
          motion,
          [](const Point<2> &, const double) { return Tensor<1, 2>(); },
          {kind, {}},
          EnforcementParameters().enforcement_of(),
          0.)
    {
      state.begin_step();
      line.begin_step(scene.space, 0, 0.5, true, measure, true);
      line.set_target(1);
      const unsigned int n = line.points().size();
      line.accept(std::vector<Tensor<1, 2>>(n, traction),
                  std::vector<Tensor<1, 2>>(n));
      line.begin_step(scene.space, 1, 0.5, true, measure, false);
      line.set_target(3);
    }

    Tensor<1, 2>
    turned(const double t_0, const double t_1) const
    {
      return motion.pose(t_1).rotation() *
             (transpose(motion.pose(t_0).rotation()) * traction);
    }

    void
    expect(const Tensor<1, 2> &reaction) const
    {
      EXPECT_GT(Utilities::MPI::sum<unsigned int>(line.points().size(),
                                                  MPI_COMM_WORLD),
                0u);
      for (const auto &point : line.points())
        EXPECT_LT((point.reaction - reaction).norm(), 1e-13);
    }

    SmallScene<2>       scene;
    State<2>            state;
    RigidMotion<2>      motion;
    ImplicitBoundary<2> line;
  };
} // namespace



TEST(ImplicitBoundary, ACarriedReactionIsAVectorOfItsPlace)
{
  const TurningLine line(Constraint<2>::fixed, StrainMeasure::small);
  line.expect(traction);
}



TEST(ImplicitBoundary, AFixedSurfaceTurnsItsReactionByTheStepAtFiniteStrain)
{
  const TurningLine line(Constraint<2>::fixed, StrainMeasure::finite);
  EXPECT_GT((line.turned(1, 3) - traction).norm(), 0.1);
  line.expect(line.turned(1, 3));
}



TEST(ImplicitBoundary, ARollersReactionGoesWithItsNormal)
{
  for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
    {
      const TurningLine line(Constraint<2>::roller, measure);
      EXPECT_GT((line.turned(0, 1) - traction).norm(), 0.1);
      line.expect(line.turned(0, 1));
    }
}
