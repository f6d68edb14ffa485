// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/implicit_boundary.h>

#include <moraine/geometry/shapes.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/state/state.h>

#include <deal.II/base/mpi.h>

#include <deal.II/physics/transformations.h>

#include <gtest/gtest.h>

#include <array>
#include <map>

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
      , line(make_line(motion, kind))
    {
      state.begin_step();
      line.begin_step(scene.space, 0, 0.5, true, measure, true);
      line.set_target(1);
      const unsigned int n = line.points().size();
      line.prepare(std::vector<Tensor<1, 2>>(n, traction),
                   std::vector<Tensor<1, 2>>(n));
      line.keep();
      line.begin_step(scene.space, 1, 0.5, true, measure, false);
      line.set_target(3);
    }

    static ImplicitBoundary<2>
    make_line(const RigidMotion<2> &motion, const Constraint<2>::Kind kind)
    {
      return ImplicitBoundary<2>(
        "line",
        make_flat_face<2>(std::vector<Point<2>>{{1.9, 1.1}, {2.1, 2.8}}),
        motion,
        [](const Point<2> &, const double) { return Tensor<1, 2>(); },
        {kind, {}},
        EnforcementParameters().enforcement_of(),
        0.);
    }

    Tensor<1, 2>
    turned(const double t_0, const double t_1) const
    {
      return motion.pose(t_1).rotation() *
             (transpose(motion.pose(t_0).rotation()) * traction);
    }

    void
    expect(const Tensor<1, 2> &multiplier) const
    {
      EXPECT_GT(Utilities::MPI::sum<unsigned int>(line.points().size(),
                                                  MPI_COMM_WORLD),
                0u);
      for (const auto &point : line.points())
        EXPECT_LT((point.multiplier - multiplier).norm(), 1e-13);
    }

    SmallScene<2>       scene;
    State<2>            state;
    RigidMotion<2>      motion;
    ImplicitBoundary<2> line;
  };
} // namespace



TEST(ImplicitBoundary, AMultiplierIsAVectorOfItsPlace)
{
  const TurningLine line(Constraint<2>::fixed, StrainMeasure::small);
  line.expect(traction);
}



TEST(ImplicitBoundary, AFixedSurfaceTurnsItsMultiplierByTheStepAtFiniteStrain)
{
  const TurningLine line(Constraint<2>::fixed, StrainMeasure::finite);
  EXPECT_GT((line.turned(1, 3) - traction).norm(), 0.1);
  line.expect(line.turned(1, 3));
}



TEST(ImplicitBoundary, ARollersMultiplierGoesWithItsNormal)
{
  for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
    {
      const TurningLine line(Constraint<2>::roller, measure);
      EXPECT_GT((line.turned(0, 1) - traction).norm(), 0.1);
      // What is along the line is no pressure of a roller.
      const Tensor<1, 2> along =
        line.motion.pose(1).rotation() * Tensor<1, 2>({0.2, 1.7});
      const Tensor<1, 2> turned = line.turned(0, 1);
      line.expect(turned - (turned * along) / along.norm_square() * along);
    }
}



TEST(ImplicitBoundary, WhatItCarriesGoesThroughAnArchive)
{
  TurningLine original(Constraint<2>::roller, StrainMeasure::small);
  Archive     written;
  original.line.write(written);
  const Archive archive =
    written.gathered(MPI_COMM_WORLD).scattered(MPI_COMM_WORLD);

  auto copy = TurningLine::make_line(original.motion, Constraint<2>::roller);
  copy.read(archive);
  copy.begin_step(
    original.scene.space, 1, 0.5, true, StrainMeasure::small, false);
  copy.set_target(3);
  const auto &points = original.line.points();
  ASSERT_EQ(copy.points().size(), points.size());
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      EXPECT_EQ(copy.points()[q].x, points[q].x);
      EXPECT_EQ(copy.points()[q].multiplier, points[q].multiplier);
      EXPECT_GT(points[q].multiplier.norm(), 0.5);
    }
  Archive again;
  copy.write(again);
  EXPECT_TRUE(again.gathered(MPI_COMM_WORLD) ==
              written.gathered(MPI_COMM_WORLD));
}



TEST(ImplicitBoundary, AStepThatIsNotKeptLeavesNoTrace)
{
  TurningLine tried(Constraint<2>::fixed, StrainMeasure::small);
  Archive     before, after;
  tried.line.write(before);
  const unsigned int n = tried.line.points().size();
  tried.line.set_multipliers(std::vector<Tensor<1, 2>>(n, -5. * traction));
  tried.line.prepare(std::vector<Tensor<1, 2>>(n, 3. * traction),
                     std::vector<Tensor<1, 2>>(n, traction));
  tried.line.undo();
  tried.line.begin_step(
    tried.scene.space, 1, 0.5, true, StrainMeasure::small, true);
  tried.line.set_target(3);
  tried.expect(traction);
  tried.line.write(after);
  EXPECT_TRUE(after == before);
}



namespace
{
  /** A plane through a body, at an angle to its cells, that turns. */
  template <int dim>
  struct TurningPlane
  {
    TurningPlane()
      : scene(false, 2, StrainMeasure::finite)
      , state(scene.space,
              scene.points,
              *scene.basis,
              {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
              MeshAfterStep::reset,
              StrainMeasure::finite)
      , motion({}, angle, middle())
      , plane(make(motion))
    {
      state.begin_step();
    }

    static Point<dim>
    middle()
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = 2;
      return x;
    }

    static std::vector<Point<dim>>
    corners()
    {
      const double            dy = 0.4, dz = dim == 3 ? 0.2 : 0;
      std::vector<Point<dim>> corners;
      for (const auto &[y, z] : {std::array<double, 2>{{-1, -1}},
                                 std::array<double, 2>{{1, -1}},
                                 std::array<double, 2>{{1, 1}},
                                 std::array<double, 2>{{-1, 1}}})
        if (dim == 3 || z < 0)
          {
            Point<dim> x = middle();
            x[0] += dy * y + dz * z;
            x[1] += y;
            if (dim == 3)
              x[dim - 1] += z;
            corners.push_back(x);
          }
      return corners;
    }

    static ImplicitBoundary<dim>
    make(const RigidMotion<dim>               &motion,
         const std::vector<Point<dim>>        &of   = corners(),
         const typename Constraint<dim>::Kind &kind = Constraint<dim>::fixed)
    {
      EnforcementParameters parameters;
      parameters.enforcement = "augmented Lagrangian";
      return ImplicitBoundary<dim>(
        "plane",
        make_flat_face<dim>(of),
        motion,
        [](const Point<dim> &, const double) { return Tensor<1, dim>(); },
        {kind, {}},
        parameters.enforcement_of(),
        0.);
    }

    void
    begin_step(ImplicitBoundary<dim> &of,
               const double           t,
               const bool             through_cells = true)
    {
      of.begin_step(scene.space,
                    t,
                    0.5,
                    true,
                    StrainMeasure::finite,
                    true,
                    false,
                    {},
                    through_cells);
    }

    static unsigned int
    n_slopes(const ImplicitBoundary<dim> &of)
    {
      return Utilities::MPI::sum<unsigned int>(of.slopes().size(),
                                               MPI_COMM_WORLD);
    }

    SmallScene<dim>       scene;
    State<dim>            state;
    RigidMotion<dim>      motion;
    ImplicitBoundary<dim> plane;
  };



  template <int dim>
  void
  check_slopes()
  {
    TurningPlane<dim> turning;
    auto             &plane = turning.plane;
    turning.begin_step(plane, 0, false);
    EXPECT_EQ(turning.n_slopes(plane), 0u);
    turning.begin_step(plane, 0);
    EXPECT_GT(turning.n_slopes(plane), 1u);
    plane.set_target(1);
    const Tensor<2, dim> turn_0_1 = turning.motion.pose(1).rotation();
    const Tensor<2, dim> turn_1_3 =
      turning.motion.pose(3).rotation() * transpose(turn_0_1);

    // Tractions that are linear along all of the plane.
    Tensor<2, dim> gradient;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        gradient[i][j] = 1 + i - 0.3 * j;
    std::vector<Tensor<1, dim>> tractions;
    for (unsigned int k = 0; k < plane.slopes().size(); ++k)
      {
        const BoundarySlope<dim> &slope = plane.slopes()[k];
        const BoundaryPoint<dim> &point = plane.points()[slope.point];
        Tensor<1, dim>            of_places;
        double                    of_one = 0;
        for (unsigned int a = 0; a < turning.scene.space.nodes_per_cell(); ++a)
          {
            const unsigned int node =
              turning.scene.space.cell_nodes(point.cell)[a];
            of_one += plane.slope_of_N(k)[a];
            of_places += plane.slope_of_N(k)[a] *
                         (turning.scene.space.node_position(node) - point.x);
          }
        EXPECT_NEAR(of_one, 0, 1e-13);
        EXPECT_LT((of_places - slope.offset).norm(), 1e-13);
        EXPECT_NEAR(slope.offset * point.normal, 0, 1e-13);
        EXPECT_LT(
          (slope.prescribed - (turn_0_1 * slope.offset - slope.offset)).norm(),
          1e-13);
        EXPECT_EQ(slope.multiplier.norm(), 0.);
        tractions.push_back(gradient * slope.offset);
      }
    const std::vector<Tensor<1, dim>> none(plane.points().size());
    plane.prepare(none, none, tractions);
    plane.keep();
    Archive written;
    plane.write(written);

    ImplicitBoundary<dim> resumed = TurningPlane<dim>::make(turning.motion);
    resumed.read(written.gathered(MPI_COMM_WORLD).scattered(MPI_COMM_WORLD));
    for (ImplicitBoundary<dim> *next : {&plane, &resumed})
      {
        turning.begin_step(*next, 1);
        next->set_target(3);
        EXPECT_GT(turning.n_slopes(plane), 1u);
        EXPECT_EQ(next->slopes().size(), plane.slopes().size());
        for (const BoundarySlope<dim> &slope : next->slopes())
          {
            const Tensor<1, dim> at_start =
              gradient * (transpose(turn_0_1) * slope.offset);
            EXPECT_LT((slope.multiplier_at_start - at_start).norm(), 1e-13);
            EXPECT_LT((slope.multiplier - turn_1_3 * at_start).norm(), 1e-13);
          }
      }
  }
} // namespace



TEST(ImplicitBoundary, SlopesHoldWhatVariesAlongAPieceAndGoWithTheSurface)
{
  check_slopes<2>();
  check_slopes<3>();
}



TEST(ImplicitBoundary, WhatSlidesAroundABendIsNotHeldByItsSlope)
{
  // Through three cells, bent by 37 degrees in the one between.
  const std::vector<Point<2>> bent{{2.2, 0.6}, {2.5, 1.5}, {2.2, 2.4}};
  TurningPlane<2>             scene;
  for (const auto &[kind, n] : {std::make_pair(Constraint<2>::fixed, 3u),
                                std::make_pair(Constraint<2>::roller, 2u)})
    {
      auto line = TurningPlane<2>::make(scene.motion, bent, kind);
      scene.begin_step(line, 0);
      EXPECT_EQ(scene.n_slopes(line), n);
    }
}



TEST(ImplicitBoundary, DepthsAreThoseOfTheMaterialWithinTheCellAndATenthOfIt)
{
  SmallScene<2> scene;
  State<2>      state(scene.space,
                 scene.points,
                 *scene.basis,
                 {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
                 MeshAfterStep::reset,
                 StrainMeasure::small);
  state.begin_step();
  ImplicitBoundary<2> line(
    "line",
    make_flat_face<2>(std::vector<Point<2>>{{1.25, 1.}, {1.25, 2.5}}),
    RigidMotion<2>(
      {}, [](const double) { return 0.; }, Point<2>()),
    [](const Point<2> &, const double) { return Tensor<1, 2>(); },
    {Constraint<2>::fixed, {}},
    EnforcementParameters().enforcement_of(),
    0.);
  const auto begin_step = [&]() {
    line.begin_step(scene.space, 0, 0.5, true, StrainMeasure::small, false);
  };
  // In the upper of its two cells it has half the length.
  const auto expect = [&](const double lower, const double upper) {
    for (const auto &point : line.points())
      EXPECT_NEAR(point.depth, point.x[1] < 2 ? lower : upper, 1e-12);
  };
  begin_step();
  EXPECT_GT(Utilities::MPI::sum<unsigned int>(line.points().size(),
                                              MPI_COMM_WORLD),
            0u);
  expect(1, 1);
  const unsigned int n_cells = scene.mesh.triangulation().n_active_cells();
  for (const auto &[volume, lower, upper] :
       {std::array<double, 3>{{0.3, 0.3, 0.6}},
        std::array<double, 3>{{0.75, 0.75, 1}},
        std::array<double, 3>{{0.04, 0.1, 0.1}}})
    {
      line.set_depths(std::vector<double>(n_cells, volume), 1);
      expect(lower, upper);
      line.set_depths(std::vector<double>(n_cells, volume), 2.5);
      expect(std::min(2.5 * lower, 1.), std::min(2.5 * upper, 1.));
    }
  begin_step();
  expect(1, 1);
}



namespace
{
  /** Points of each cell of this rank; with their length on all ranks. */
  struct Places
  {
    Places(const SurfacePointer<2> &surface,
           const std::string       &enforcement,
           const std::string       &held      = "auto",
           const bool               in_motion = false,
           const Point<2>          &centre    = Point<2>())
    {
      EnforcementParameters parameters;
      parameters.enforcement    = enforcement;
      parameters.held_in_a_cell = held;
      SmallScene<2> scene;
      State<2>      state(scene.space,
                     scene.points,
                     *scene.basis,
                     {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
                     MeshAfterStep::reset,
                     StrainMeasure::small);
      state.begin_step();
      ImplicitBoundary<2> boundary(
        "surface",
        surface,
        RigidMotion<2>(
          {}, [](const double) { return 0.; }, Point<2>()),
        [](const Point<2> &, const double) { return Tensor<1, 2>(); },
        {Constraint<2>::roller, {}},
        parameters.enforcement_of(),
        0.);
      boundary.begin_step(
        scene.space, 0, 0.5, true, StrainMeasure::small, false, in_motion);
      points = boundary.points();
      for (const auto &point : points)
        {
          ++of_cell[point.cell];
          length += point.JxW;
        }
      boundary.set_target(1);
      const Tensor<2, 2> turn =
        Physics::Transformations::Rotations::rotation_matrix_2d(0.5);
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          Tensor<1, 2> of_linear(-points[q].x), turned;
          for (unsigned int a = 0; a < 4; ++a)
            {
              const Point<2> node = scene.space.node_position(
                scene.space.cell_nodes(points[q].cell)[a]);
              of_linear += boundary.N(q)[a] * node;
              turned +=
                boundary.N(q)[a] * (turn * (node - centre) - (node - centre));
            }
          off_linear = std::max(off_linear, of_linear.norm());
          off_turned = std::max(
            off_turned,
            boundary.constraint_state(points[q], turned, 1.).violation.norm());
          normal_gradients.push_back(
            boundary.surface_at_end().normal_gradient(points[q].x,
                                                      points[q].h));
        }
      length = Utilities::MPI::sum(length, MPI_COMM_WORLD);
    }

    void
    expect(const unsigned int n) const
    {
      for (const auto &in_cell : of_cell)
        EXPECT_EQ(in_cell.second, n);
    }

    std::vector<BoundaryPoint<2>>        points;
    std::map<unsigned int, unsigned int> of_cell;
    double                               length     = 0;
    double                               off_linear = 0;
    /** Violation after a turn about the centre. */
    double off_turned = 0;
    /** At the points. */
    std::vector<SymmetricTensor<2, 2>> normal_gradients;
  };
} // namespace



TEST(ImplicitBoundary, HoldsTheMeanOfACellUnlessItRunsAlongItsFaces)
{
  const auto line = [](const Point<2> &a, const Point<2> &b) {
    return make_flat_face<2>(std::vector<Point<2>>{a, b});
  };
  const Point<2> a(0.6, 0.7), b(2.9, 2.3), c(2.9, 0.7);
  for (const char *how : {"augmented Lagrangian", "weighted", "penalty"})
    {
      const Places inclined(line(a, b), how);
      inclined.expect(1);
      EXPECT_NEAR(inclined.length, a.distance(b), 1e-12);
      EXPECT_LT(inclined.off_linear, 1e-12);
      for (const auto &point : inclined.points)
        EXPECT_NEAR((point.x - a) * point.normal, 0, 1e-12);
      for (const auto &gradient : inclined.normal_gradients)
        EXPECT_EQ(gradient.norm(), 0);
      Places(line(a, b), how, "places").expect(4);
      Places(line(a, c), how).expect(4);
    }
  Places(line(a, b), "skew Nitsche").expect(4);
  Places(line(a, b), "skew Nitsche", "mean").expect(1);
}



TEST(ImplicitBoundary, OnACurveARollersMeanGoesAroundFreely)
{
  const Point<2> centre(1.9, 1.8);
  const double   radius = 1.3;
  const auto     circle = make_arc(centre, radius, true, 0., 360.);
  const Places   one(circle, "augmented Lagrangian", "auto", false, centre);
  one.expect(1);
  EXPECT_NEAR(one.length, 2 * numbers::PI * radius, 1e-6);
  EXPECT_LT(one.off_linear, 1e-12);
  EXPECT_LT(one.off_turned, 1e-12);
  for (const auto &point : one.points)
    EXPECT_LT((point.normal - (point.x - centre) / radius).norm(), 0.05);
  const Places in_motion(circle, "augmented Lagrangian", "auto", true, centre);
  EXPECT_LT(in_motion.off_turned, 1e-12);
  EXPECT_GE(Utilities::MPI::sum(in_motion.points.size(), MPI_COMM_WORLD),
            4 * Utilities::MPI::sum(one.points.size(), MPI_COMM_WORLD));
  // The normal turns by 1/r along the circle, not across it.
  for (unsigned int q = 0; q < one.points.size(); ++q)
    {
      const Tensor<1, 2>          to = one.points[q].x - centre;
      const double                r  = to.norm();
      const SymmetricTensor<2, 2> exact =
        1 / r *
        (unit_symmetric_tensor<2>() -
         symmetrize(outer_product(to / r, to / r)));
      EXPECT_LT((one.normal_gradients[q] - exact).norm(), 1e-6);
    }
}



TEST(ImplicitBoundary, OnEachSideOfACornerThereIsAMean)
{
  const Places corner(make_flat_face<2>(std::vector<Point<2>>{{1.2, 1.3},
                                                              {1.6, 1.4},
                                                              {1.5, 1.8}}),
                      "augmented Lagrangian");
  corner.expect(2);
}



TEST(ImplicitBoundary, EachOwnerInACellWithoutMaterialDecidesAlone)
{
  BackgroundMesh<2>          mesh(unit_cells<2>(4), MPI_COMM_WORLD);
  GridSpace<2>               space(mesh, 1);
  std::vector<unsigned char> active(mesh.triangulation().n_active_cells(), 0);
  unsigned int               right = 0;
  for (const auto &cell : mesh.triangulation().active_cell_iterators())
    {
      const unsigned int c        = cell->active_cell_index();
      const bool         is_right = cell->point_inside(Point<2>(2.5, 1.5));
      if (is_right)
        right = c;
      active[c] = cell->is_locally_owned() &&
                  (is_right || cell->point_inside(Point<2>(1.5, 2.5)));
    }
  space.set_active_cells(active);

  // Half of it is nearest to the cell on the right, half to the one above.
  const Point<2>      a(1.1, 1.8), b(1.8, 1.1);
  ImplicitBoundary<2> line(
    "line",
    make_flat_face<2>(std::vector<Point<2>>{a, b}),
    RigidMotion<2>(),
    [](const Point<2> &, const double) { return Tensor<1, 2>(); },
    {Constraint<2>::fixed, {}},
    EnforcementParameters().enforcement_of(),
    0.);
  line.begin_step(space,
                  0,
                  0.8,
                  true,
                  StrainMeasure::small,
                  true,
                  false,
                  [right](const unsigned int cell,
                          const Point<2> &,
                          const double) { return cell == right; });
  // Places are those of the whole line, whatever is above.
  double length = 0;
  for (const auto &point : line.points())
    {
      EXPECT_EQ(point.cell, right);
      length += point.JxW;
    }
  EXPECT_EQ(line.n_points(MPI_COMM_WORLD), 2u);
  EXPECT_NEAR(Utilities::MPI::sum(length, MPI_COMM_WORLD),
              0.5 * a.distance(b),
              1e-12);
}
