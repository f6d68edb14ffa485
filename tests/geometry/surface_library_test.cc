// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/placement.h>
#include <moraine/geometry/shape_library.h>
#include <moraine/core/exceptions.h>

#include <gtest/gtest.h>

#include <limits>

#include "surface_cases.h"

using namespace dealii;
using namespace moraine;
using namespace moraine_tests;

namespace
{
  template <int dim>
  std::shared_ptr<const Surface<dim>>
  read(const std::string &text)
  {
    ShapeParameters<dim> parameters(ShapeUse::surface);
    ParameterHandler     prm;
    parameters.add_parameters(prm);
    prm.parse_input_from_string(text);
    return make_surface<dim>(parameters, {}, "Boundaries/left");
  }

  template <int dim>
  std::string
  complaint(const std::string &text)
  {
    try
      {
        read<dim>(text);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(SurfaceLibrary, MakesEveryKind)
{
  const auto cells = box_cells<2>(5, 10., 0.);
  EXPECT_NEAR(
    measure(all_pieces(*read<2>("set Points = 1, 1; 4, 5; 4, 7"), cells, 2)),
    7.,
    1e-13);
  EXPECT_DOUBLE_EQ(read<2>("set Points = 0 0; 1 0")->level({.5, 2.}), 2.);
  EXPECT_DOUBLE_EQ(
    read<2>("set Points = 0 0; 1 0\nset Flip = true")->level({.5, 2.}), -2.);
  EXPECT_DOUBLE_EQ(read<2>(
                     "set Surface = plane\nset Point = 1, 0\nset Normal = 2, 0")
                     ->level({0., 3.}),
                   1.);
  EXPECT_DOUBLE_EQ(read<2>(
                     "set Surface = circle\nset Centre = 1, 0\nset Radius = 2\n"
                     "set Body side = outside")
                     ->level({1., 5.}),
                   3.);
  EXPECT_FALSE(read<2>("set Surface = arc\nset Centre = 1, 0\nset Radius = 2\n"
                       "set Start angle = 0\nset End angle = 90\n"
                       "set Body side = outside")
                 ->in_extent({1., -5.}));
  EXPECT_NEAR(read<2>("set Surface = expression\nset Expression = 2*y - 1\n"
                      "set Extent lower corner = 0, 0")
                ->level({1., 1.}),
              .5,
              1e-9);
  EXPECT_DOUBLE_EQ(
    read<3>("set Points = 0,0,0; 1,0,0; 1,1,0")->level({1., 0., 2.}), -2.);
  EXPECT_DOUBLE_EQ(
    read<3>("set Surface = sphere\nset Centre = 0,0,0\nset Radius = 1\n"
            "set Body side = inside")
      ->level({0., 0., .25}),
    .75);
  EXPECT_DOUBLE_EQ(
    read<3>("set Surface = cylinder\nset Axis start = 0,0,0\n"
            "set Axis end = 0,0,4\nset Radius = 1\nset Body side = inside")
      ->level({0.25, 0., 1.}),
    .75);
}

TEST(SurfaceLibrary, MistakesAreNamed)
{
  EXPECT_EQ(complaint<2>(""),
            "section 'Boundaries/left', key 'Points': not set. The surface "
            "'polyline' needs: Points");
  EXPECT_EQ(complaint<2>("set Points = 0, 0; 1"),
            "section 'Boundaries/left', key 'Points': found '1', allowed: "
            "2 numbers for each point");
  EXPECT_EQ(complaint<2>("set Points = 0, 0; 1, nan"),
            "section 'Boundaries/left', key 'Points': found '1, nan', allowed: "
            "2 numbers for each point");
  EXPECT_EQ(
    complaint<2>("set Points = 0, 0"),
    "section 'Boundaries/left', a line needs at least two points, found 1");
  EXPECT_EQ(
    complaint<2>("set Points = 0,0; 1,1\nset Radius = 3"),
    "section 'Boundaries/left', key 'Radius': set, but the "
    "surface 'polyline' does not use it. It uses: Points and, if wanted, "
    "Flip");
  EXPECT_EQ(
    complaint<2>("set Surface = circle\nset Centre = 0,0\nset Radius = -1\n"
                 "set Body side = inside"),
    "section 'Boundaries/left', key 'Radius': found '-1', allowed: a number > 0");
  EXPECT_EQ(complaint<2>(
              "set Surface = circle\nset Centre = 0,0\nset Radius = 1"),
            "section 'Boundaries/left', key 'Body side': not set. The "
            "surface 'circle' needs: Centre, Radius, Body side");
  EXPECT_EQ(
    complaint<2>("set Surface = expression\nset Expression = x +"),
    "section 'Boundaries/left', key 'Expression': found 'x +': Unexpected end "
    "of expression at position 4. Allowed: an expression in x,y with the "
    "constant pi");
  EXPECT_EQ(
    complaint<2>(
      "set Surface = expression\nset Expression = x\n"
      "set Extent lower corner = 1, 1\nset Extent upper corner = 2, 0"),
    "section 'Boundaries/left', key 'Extent upper corner': found '2, 0', "
    "allowed: above the lower corner in every direction");
}

TEST(SurfaceLibrary, RimsOfBodies)
{
  const auto shape = [](const std::string &text) {
    ShapeParameters<2> parameters;
    ParameterHandler   prm;
    parameters.add_parameters(prm);
    prm.parse_input_from_string(text);
    return parameters;
  };
  const auto bodies = make_shapes<2>(
    {{"block",
      shape("set Lower corner = 0, 0\nset Upper corner = 2, 1\n"
            "set Rotation angle = 90")},
     {"wheel",
      shape("set Shape = ring\nset Centre = 5, 5\nset Radius = 2\n"
            "set Inner radius = 1")},
     {"both", shape("set Shape = union\nset Operands = block, wheel")},
     {"all", shape("set Shape = mesh")},
     {"plate", shape("set Shape = disc\nset Centre = 0, 0\nset Radius = 1")},
     {"file", shape("set Shape = points-from-file\nset Point file = a.csv")}},
    "Bodies");
  const auto make = [&](const std::string &text) {
    ShapeParameters<2> parameters(ShapeUse::surface);
    ParameterHandler   prm;
    parameters.add_parameters(prm);
    prm.parse_input_from_string(text);
    return make_surface<2>(parameters, bodies, "Boundaries/left");
  };
  // the placement goes along
  const auto left = make("set Body = block\nset Part = left");
  EXPECT_NEAR(left->level({-.5, .25}), .25, 1e-15);
  EXPECT_NEAR((left->normal({-.5, .25}) - Point<2>(0., -1.)).norm(), 0., 1e-15);
  EXPECT_NEAR(make("set Body = wheel\nset Part = inner")->level({5., 6.25}),
              .25,
              1e-14);
  EXPECT_NEAR(make("set Body = both\nset Part = wheel/outer")->level({5., 6.5}),
              .5,
              1e-14);
  EXPECT_NEAR(make("set Body = plate")->level({0., .25}), .75, 1e-14);

  const auto complaint_of = [&](const std::string &text) {
    try
      {
        make(text);
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("none");
  };
  const std::string here = "section 'Boundaries/left', ";
  EXPECT_EQ(complaint_of("set Body = whel"),
            here + "key 'Body': found 'whel', allowed: names of bodies; did "
                   "you mean 'wheel'? Allowed here: all, block, both, file, "
                   "plate, wheel");
  EXPECT_EQ(complaint_of("set Body = wheel\nset Part = iner"),
            here + "key 'Part': found 'iner', allowed: parts of the rim of "
                   "'wheel'; did you mean 'inner'? Allowed here: outer, inner");
  EXPECT_EQ(complaint_of("set Body = plate\nset Part = top"),
            here + "key 'Part': found 'top', allowed: nothing, the rim of "
                   "'plate' is one whole");
  EXPECT_EQ(complaint_of("set Part = top"),
            here + "key 'Body': not set. The surface 'rim of a body' needs: "
                   "Body");
  EXPECT_EQ(complaint_of("set Body = wheel\nset Radius = 2"),
            here + "key 'Radius': set, but the surface 'rim of a body' does "
                   "not use it. It uses: Body and, if wanted, Part");
  EXPECT_EQ(complaint_of("set Body = wheel\nset Surface = circle"),
            here + "key 'Surface': found 'circle', allowed: nothing, a rim of "
                   "a body is no other kind");
  for (const std::string name : {"all", "file"})
    EXPECT_EQ(complaint_of("set Body = " + name),
              here + "key 'Body': found '" + name +
                "', allowed: a body with a rim; points of a file and cells "
                "of the mesh have none");
}

TEST(RigidMotion, PosesAndBack)
{
  const RigidMotion<3> motion(
    {{[](const double t) { return 2. * t; }, {}, {}}},
    [](const double t) { return 90. * t; },
    {1., 0., 0.},
    Point<3>(0., 0., 5.));
  const auto pose = motion.pose(1.);
  EXPECT_NEAR(pose.map({2., 0., 7.}).distance({3., 1., 7.}), 0., 1e-14);
  EXPECT_NEAR(pose.inverse({3., 1., 7.}).distance({2., 0., 7.}), 0., 1e-14);
  EXPECT_NEAR((pose.rotate(Point<3>(1., 0., 0.)) - Point<3>(0., 1., 0.)).norm(),
              0.,
              1e-15);
  EXPECT_FALSE(RigidMotion<2>().moves());
  EXPECT_EQ(RigidMotion<2>().pose(3.).map({1., 2.}), (Point<2>(1., 2.)));
  const RigidMotion<2> bad({{{}, [](const double) {
                               return std::numeric_limits<double>::quiet_NaN();
                             }}});
  EXPECT_THROW(bad.pose(0.5), InputError);
  EXPECT_THROW(RigidMotion<3>(
                 {}, [](const double) { return 1.; }, {}, Tensor<1, 3>()),
               InputError);
}

TEST(MovedSurface, CutsAsItsImageDoes)
{
  const std::shared_ptr<const Surface<2>> line =
    read<2>("set Points = 2, 3; 6, 6");
  const auto      cells = box_cells<2>(7, 10., .2);
  MovedSurface<2> moved(line);
  for (unsigned int k = 0; k < 36; ++k)
    {
      const RigidMotion<2> motion({{[](const double t) { return .1 * t; }, {}}},
                                  [](const double t) { return 10. * t; },
                                  {4., 4.5});
      const auto           pose = motion.pose(k);
      moved.set_pose(pose);
      double length = 0.;
      for (const auto &p : all_pieces(moved, cells, 2))
        {
          EXPECT_NEAR(moved.level(p.x), 0., 1e-14);
          EXPECT_TRUE(moved.in_extent(p.x));
          EXPECT_TRUE(moved.bounding_box().point_inside(p.x, 1e-12));
          EXPECT_NEAR((moved.normal(p.x) - p.normal).norm(), 0., 1e-15);
          EXPECT_NEAR((pose.rotate(line->normal({})) - p.normal).norm(),
                      0.,
                      1e-15);
          length += p.JxW;
        }
      EXPECT_NEAR(length, 5., 1e-13 * 10.) << k;
      EXPECT_FALSE(moved.curved());
    }
}
