// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/shape_library.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>

#include <gtest/gtest.h>

using namespace moraine;
using dealii::Point;
using dealii::numbers::PI;

namespace
{
  // parameters as read from text
  template <int dim>
  ShapeParameters<dim>
  from_text(const std::string &text)
  {
    ShapeParameters<dim>     parameters;
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm);
    prm.parse_input_from_string(text);
    return parameters;
  }

  template <int dim>
  double
  volume(const std::string &text, const NamedShapes<dim> &known = {})
  {
    Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = -10.;
        upper[d] = 10.;
      }
    return make_shape(from_text<dim>(text), known, "Bodies/a")
      ->clip(ConvexPolytope<dim>(lower, upper))
      .volume;
  }

  template <int dim>
  std::string
  shape_complaint(const std::string &text, const NamedShapes<dim> &known = {})
  {
    try
      {
        make_shape(from_text<dim>(text), known, "Bodies/a");
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "none";
  }

  const std::string section = "section 'Bodies/a', ";
} // namespace



TEST(ShapeLibrary, EveryShapeCanBeMade)
{
  const std::map<std::string, std::pair<std::string, double>> flat{
    {"box", {"set Lower corner = 0, 0\nset Upper corner = 2, 3", 6.}},
    {"polygon", {"set Vertices = 0 0; 2 0; 1 1; 2, 2; 0 2", 3.}},
    {"disc", {"set Centre = 0, 1\nset Radius = 2", 4. * PI}},
    {"ring",
     {"set Centre = 0, 1\nset Radius = 2\nset Inner radius = 1", 3. * PI}},
    {"half-space", {"set Point = 0, 0\nset Normal = 1, 1", 200.}},
    {"mesh", {"", 400.}},
    {"expression", {"set Expression = x - 4", 120.}},
    {"union", {"set Operands = p, q", 7.}},
    {"intersection", {"set Operands = p, q", 1.}},
    {"difference", {"set Operands = p, q", 3.}}};
  const std::map<std::string, std::pair<std::string, double>> solid{
    {"box", {"set Lower corner = 0, 0, 0\nset Upper corner = 2, 3, 4", 24.}},
    {"polygon",
     {"set Vertices = 0 0; 2 0; 1 1; 2 2; 0 2\nset Extent = 1, 3", 6.}},
    {"sphere",
     {"set Centre = 0, 1, 0\nset Radius = 2\nset Inner radius = 1",
      28. / 3. * PI}},
    {"cylinder",
     {"set Axis start = 0, 0, 0\nset Axis end = 0, 0, 5\nset Radius = 2\n"
      "set Inner radius = 1",
      15. * PI}},
    {"half-space", {"set Point = 0, 0, 0\nset Normal = 1, 1, 0", 4000.}},
    {"mesh", {"", 8000.}},
    {"expression", {"set Expression = x - 4", 2400.}},
    {"union", {"set Operands = p, q", 15.}},
    {"intersection", {"set Operands = p, q", 1.}},
    {"difference", {"set Operands = p, q", 7.}}};
  const auto p2 = make_shapes<2>(
    {{"p", from_text<2>("set Lower corner = 0, 0\nset Upper corner = 2, 2")},
     {"q", from_text<2>("set Lower corner = 1, 1\nset Upper corner = 3, 3")}},
    "Bodies");
  const auto p3 = make_shapes<3>(
    {{"p",
      from_text<3>("set Lower corner = 0, 0, 0\nset Upper corner = 2, 2, 2")},
     {"q",
      from_text<3>("set Lower corner = 1, 1, 1\nset Upper corner = 3, 3, 3")}},
    "Bodies");
  for (const auto &entry : ShapeParameters<2>().kinds())
    {
      if (entry == "points-from-file")
        continue;
      EXPECT_NEAR(
        volume<2>("set Shape = " + entry + "\n" + flat.at(entry).first, p2) /
          flat.at(entry).second,
        1.,
        1e-13)
        << entry;
    }
  for (const auto &entry : ShapeParameters<3>().kinds())
    {
      if (entry == "points-from-file")
        continue;
      EXPECT_NEAR(
        volume<3>("set Shape = " + entry + "\n" + solid.at(entry).first, p3) /
          solid.at(entry).second,
        1.,
        1e-13)
        << entry;
    }
}



TEST(ShapeLibrary, Placement)
{
  const auto shape =
    make_shape<2>(from_text<2>(
                    "set Lower corner = 0, 0\nset Upper corner = 2, 1\n"
                    "set Rotation angle = 90\nset Translation = 3, 0"),
                  {},
                  "Bodies/a");
  EXPECT_TRUE(shape->contains(Point<2>(2.5, 1.9)));
  EXPECT_FALSE(shape->contains(Point<2>(3.5, 0.5)));
  EXPECT_NEAR(shape->bounding_box().lower_bound(0), 2., 1e-15);
}



TEST(ShapeLibrary, OperandsInAnyOrder)
{
  const auto body = [](const std::string &text) { return from_text<2>(text); };
  const std::string unit = "set Lower corner = 0, 0\nset Upper corner = 1, 1";
  const auto        made = make_shapes<2>(
    {{"all", body("set Shape = union\nset Operands = part, zz")},
            {"part", body("set Shape = difference\nset Operands = zz, hole")},
            {"hole", body("set Shape = disc\nset Centre = 0, 0\nset Radius = 0.5")},
            {"zz", body(unit)}},
    "Bodies");
  const ConvexPolytope<2> cell(Point<2>(-3., -3.), Point<2>(3., 3.));
  EXPECT_NEAR(made.at("part")->clip(cell).volume, 1. - PI / 16., 1e-14);
  EXPECT_NEAR(made.at("all")->clip(cell).volume, 1., 1e-6);

  const auto complaint_of =
    [](const std::map<std::string, ShapeParameters<2>> &bodies) {
      try
        {
          make_shapes<2>(bodies, "Bodies");
        }
      catch (const InputError &error)
        {
          return std::string(error.what());
        }
      return std::string("none");
    };
  EXPECT_EQ(complaint_of({{"a", body("set Shape = union\nset Operands = b, c")},
                          {"b", body("set Shape = union\nset Operands = a, c")},
                          {"c", body(unit)}}),
            "section 'Bodies/b', key 'Operands': found 'a', allowed: bodies "
            "that are not themselves made from this one");
  EXPECT_EQ(
    complaint_of({{"a", body("set Shape = union\nset Operands = slop, zz")},
                  {"slope", body(unit)},
                  {"zz", body(unit)}}),
    "section 'Bodies/a', key 'Operands': found 'slop', which is not the name "
    "of a body; did you mean 'slope'? Allowed here: a, slope, zz");
  EXPECT_EQ(
    complaint_of(
      {{"a", body("set Shape = union\nset Operands = b, c")},
       {"b", body(unit)},
       {"c", body("set Shape = points-from-file\nset Point file = f")}}),
    "section 'Bodies/a', key 'Operands': found 'c', allowed: bodies with a "
    "shape; the points of this one come from a file");
}



TEST(ShapeLibrary, Mistakes)
{
  EXPECT_EQ(shape_complaint<2>("set Shape = disc\nset Centre = 0, 0"),
            section + "key 'Radius': not set, or zero. The shape 'disc' "
                      "needs: Centre, Radius");
  EXPECT_EQ(shape_complaint<2>(
              "set Lower corner = 0, 0\nset Upper corner = 1, 1\n"
              "set Radius = 2"),
            section + "key 'Radius': set, but the shape 'box' does not use "
                      "it. It uses: Lower corner, Upper corner");
  EXPECT_EQ(shape_complaint<2>(
              "set Lower corner = 0, 0\nset Upper corner = 1, 0"),
            section + "key 'Upper corner': found '1, 0', allowed: more than "
                      "Lower corner (0, 0) in each coordinate");
  EXPECT_EQ(shape_complaint<2>("set Lower corner = 0\nset Upper corner = 1, 1"),
            section + "key 'Lower corner': found '0', allowed: 2 numbers");
  EXPECT_EQ(shape_complaint<2>("set Shape = ring\nset Centre = 0, 0\n"
                               "set Radius = 1\nset Inner radius = 1.5"),
            section + "key 'Inner radius': found '1.5', allowed: from 0 to "
                      "less than Radius (1)");
  EXPECT_EQ(shape_complaint<2>("set Shape = half-space\nset Point = 0, 0\n"
                               "set Normal = 0, 0"),
            section + "key 'Normal': found '0, 0', allowed: a vector that is "
                      "not 0");
  EXPECT_EQ(shape_complaint<3>(
              "set Shape = cylinder\nset Axis start = 0, 0, 1\n"
              "set Axis end = 0, 0, 1\nset Radius = 1"),
            section + "key 'Axis end': found '0, 0, 1', allowed: another "
                      "point than Axis start");
  EXPECT_EQ(shape_complaint<3>("set Lower corner = 0, 0, 0\n"
                               "set Upper corner = 1, 1, 1\n"
                               "set Rotation angle = 30"),
            section + "key 'Rotation axis': not set. A rotation in 3D needs "
                      "it");
  EXPECT_EQ(shape_complaint<2>("set Shape = union\nset Operands = p"),
            section + "key 'Operands': found 'p', allowed: two or more names");
  EXPECT_EQ(
    shape_complaint<2>("set Shape = expression\nset Expression = 1 -* x")
      .rfind(section + "key 'Expression': found '1 -* x': Unexpected", 0),
    0u);
  EXPECT_THROW(from_text<2>("set Shape = sphere"), dealii::ExceptionBase);
  EXPECT_THROW(from_text<2>("set Radius = -1"), dealii::ExceptionBase);

  ShapeParameters<2> misspelt;
  misspelt.texts["Shape"] = "discs";
  try
    {
      make_shape<2>(misspelt, {}, "Bodies/a");
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("did you mean 'disc'?"),
                std::string::npos);
    }
}



TEST(ShapeLibrary, BadPolygons)
{
  const auto polygon = [](const std::string &vertices) {
    return shape_complaint<2>("set Shape = polygon\nset Vertices = " +
                              vertices);
  };
  EXPECT_EQ(polygon("0 0; 1 0"),
            section + "key 'Vertices': found '0 0; 1 0', allowed: at least "
                      "three 'x y' separated by ';'");
  EXPECT_EQ(polygon("0 0; 1 0; 1 a"),
            section + "key 'Vertices': found '1 a', allowed: 2 numbers "
                      "for each point");
  const std::string allowed =
    ". Allowed: a polygon that does not touch itself, without the first vertex "
    "repeated at the end";
  EXPECT_EQ(polygon("0 0; 1 1; 1 0; 0 1"),
            section +
              "key 'Vertices': the edges between vertices 1-2 and 3-4 "
              "meet" +
              allowed);
  EXPECT_EQ(polygon("0 0; 1 0; 1 1; 0 0"),
            section + "key 'Vertices': vertex 4 is repeated by vertex 1" +
              allowed);
}
