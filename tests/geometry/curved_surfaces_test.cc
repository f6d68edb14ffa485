// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/shapes.h>

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "surface_cases.h"

using namespace dealii;
using namespace moraine;
using namespace moraine_tests;

namespace
{
  const double pi = dealii::numbers::PI;

  template <int dim>
  double
  relative_error(const Surface<dim> &surface,
                 const Cells<dim>   &cells,
                 const unsigned int  n_gauss,
                 const double        exact)
  {
    return std::abs(measure(all_pieces(surface, cells, n_gauss)) / exact - 1.);
  }

  /** Where an expression is zero, in the quarter above and right of a corner.
   */
  template <int dim>
  SurfacePointer<dim>
  zero_of(const std::string &expression, const Extent<dim> &extent = {})
  {
    return make_expression<dim>(expression, "here")->rim("", true, extent);
  }

  template <int dim>
  std::shared_ptr<const Surface<dim>>
  face(const Shape<dim> &shape, const std::string &part, const bool body_inside)
  {
    return shape.faces(part, body_inside, {}).at(0);
  }
} // namespace

TEST(Arc, LengthIsExactAtRandomPlaces)
{
  for (const double distortion : {0., 0.2})
    {
      const auto cells = box_cells<2>(9, 10., distortion);
      Numbers    random(11);
      for (unsigned int i = 0; i < 500; ++i)
        {
          const double r        = random.between(0.1, 3.);
          const double start    = random.between(-400., 400.),
                       sweep    = random.between(1., 360.);
          const Point<2> c      = random.point<2>(3.1, 6.9);
          const auto     arc    = make_arc(c, r, i % 2, start, start + sweep);
          const auto     points = all_pieces(*arc, cells, 2);
          EXPECT_NEAR(measure(points), r * sweep * pi / 180., 1e-13 * 10.);
          for (const auto &p : points)
            {
              EXPECT_NEAR(arc->level(p.x), 0., 1e-14);
              EXPECT_TRUE(arc->in_extent(p.x));
              EXPECT_TRUE(arc->bounding_box().point_inside(p.x, 1e-12));
              EXPECT_NEAR(
                (p.normal - (i % 2 ? 1. : -1.) * (p.x - c) / r).norm(),
                0.,
                1e-13);
            }
        }
    }
}

TEST(Arc, PiecesLieInTheirCells)
{
  const auto cells = box_cells<2>(9, 10., 0.2);
  const auto arc   = make_arc({4.7, 5.2}, 3.3, true);
  for (const auto &cell : cells)
    {
      std::vector<SurfacePoint<2>> points;
      arc->pieces(cell, 3, points);
      for (const auto &p : points)
        EXPECT_TRUE(inside_cell(cell, p.x, 1e-13));
    }
}

TEST(Arc, TangentToMeshLinesAndThroughVertices)
{
  // centres and radii on the mesh, and off it by next to nothing
  const auto cells = box_cells<2>(10, 10., 0.);
  for (const double offset : {0., 1e-16, 1e-15, -1e-15, 1e-12, 1e-9, -1e-7})
    for (const bool inside : {false, true})
      for (const double r : {0.25, 0.5, 1., 2., 3., std::sqrt(2.), 5.})
        {
          const auto arc =
            make_arc({5. + offset, 5. - offset}, r - std::abs(offset), inside);
          const double exact = 2. * pi * (r - std::abs(offset));
          // only a circle that leaves the mesh by round-off may lose a little
          EXPECT_NEAR(measure(all_pieces(*arc, cells, 2)) / exact,
                      1.,
                      r == 5. ? 1e-6 : 1e-13)
            << offset << ' ' << r;
        }
}

TEST(Arc, IntegratesAlongTheCurve)
{
  // the area by the divergence theorem, exact to the Gauss rule in the angle
  const auto cells = box_cells<2>(9, 10., 0.2);
  const auto arc   = make_arc({4.7, 5.2}, 3.3, true);
  double     area  = 0.;
  for (const auto &p : all_pieces(*arc, cells, 5))
    area += 0.5 * p.JxW * (p.normal * p.x);
  EXPECT_NEAR(area / (pi * 3.3 * 3.3), 1., 1e-13);
}

TEST(Arc, ExtentAndMistakes)
{
  const auto quarter = make_arc({1., 1.}, 2., false, -45., 45.);
  EXPECT_TRUE(quarter->in_extent({2., 1.}));
  EXPECT_FALSE(quarter->in_extent({0., 1.}));
  EXPECT_DOUBLE_EQ(quarter->level({4., 1.}), 1.);
  EXPECT_NEAR(quarter->bounding_box().upper_bound(0), 3., 1e-15);
  EXPECT_NEAR(quarter->bounding_box().lower_bound(0),
              1. + std::sqrt(2.),
              1e-15);
  EXPECT_THROW(make_arc({0., 0.}, 0., true), InputError);
  EXPECT_THROW(make_arc({0., 0.}, 1., true, 90., 90.), InputError);
  EXPECT_THROW(make_arc({0., 0.}, 1., true, 0., 361.), InputError);
}

TEST(LevelSetSurface, CircleByTheGenerator)
{
  // errors of the length with 2 and 3 points; they fall with the cell size
  const auto circle =
    zero_of<2>("(3.3^2 - (x - 5.03)^2 - (y - 4.96)^2)/(2*3.3)");
  const double exact  = 2. * pi * 3.3;
  const auto   coarse = box_cells<2>(10, 10., 0.),
             fine     = box_cells<2>(40, 10., 0.),
             bent     = box_cells<2>(40, 10., 0.2);
  EXPECT_LT(relative_error<2>(*circle, coarse, 2, exact), 1e-4);
  EXPECT_LT(relative_error<2>(*circle, coarse, 3, exact), 2e-6);
  EXPECT_LT(relative_error<2>(*circle, fine, 2, exact), 1e-6);
  EXPECT_LT(relative_error<2>(*circle, fine, 3, exact), 1e-9);
  EXPECT_LT(relative_error<2>(*circle, bent, 3, exact), 2e-6);
}

TEST(Sphere, Area)
{
  const auto   ball    = make_ball<3>({1.03, 0.96, 1.01}, 0.7);
  const auto   surface = face<3>(*ball, "", false);
  const auto  &sphere  = *surface;
  const double exact   = 4. * pi * 0.49;
  EXPECT_LT(relative_error<3>(sphere, box_cells<3>(6, 2., 0.), 2, exact), 3e-3);
  EXPECT_LT(relative_error<3>(sphere, box_cells<3>(6, 2., 0.), 3, exact), 4e-4);
  EXPECT_LT(relative_error<3>(sphere, box_cells<3>(10, 2., 0.1), 3, exact),
            1e-5);
  EXPECT_DOUBLE_EQ(sphere.level({1.03, 0.96, 2.01}), 0.3);
  for (const auto &p : all_pieces<3>(sphere, box_cells<3>(6, 2., 0.1), 3))
    {
      EXPECT_NEAR(sphere.level(p.x), 0., 1e-11);
      EXPECT_NEAR((p.normal - sphere.normal(p.x)).norm(), 0., 1e-12);
    }
}

TEST(Cylinder, Area)
{
  // ends exact where the axis follows the mesh, else chosen point by point
  const double exact = 2. * pi * 0.6 * 1.1;
  const auto   cells = box_cells<3>(6, 2., 0.);
  const auto   upright =
    make_cylinder({1.03, 0.96, 0.37}, {1.03, 0.96, 1.47}, 0.6);
  const Tensor<1, 3> axis = Point<3>(1., 2., 3.) / std::sqrt(14.);
  const Point<3>     middle(1.01, .99, 1.02);
  const auto         slanted =
    make_cylinder(middle - .55 * axis, middle + .55 * axis, 0.6);
  const auto  sides  = face<3>(*upright, "side", true);
  const auto  around = face<3>(*slanted, "side", false);
  const auto &along = *sides, &tilted = *around;
  EXPECT_LT(relative_error<3>(along, cells, 3, exact), 2e-4);
  EXPECT_LT(relative_error<3>(tilted, cells, 2, exact), 2e-3);
  EXPECT_TRUE(tilted.in_extent(middle + .54 * axis));
  EXPECT_FALSE(tilted.in_extent(middle + .56 * axis));
  EXPECT_NEAR(tilted.level(middle + .3 * axis), -.6, 1e-15);
}

TEST(ExpressionSurface, AgreesWithTheCircle)
{
  const std::string text   = "3.3 - sqrt((x-5.03)^2 + (y-4.96)^2)";
  const auto        circle = zero_of<2>(text),
             half =
               zero_of<2>(text,
                          {{{make_half_space<2>({0., 4.96}, Point<2>(0., -1.)),
                             true,
                             Extent<2>::Along::inner}}});
  const auto cells = box_cells<2>(10, 10., 0.);
  EXPECT_LT(relative_error<2>(*circle, cells, 3, 2. * pi * 3.3), 2e-6);
  EXPECT_LT(relative_error<2>(*half, cells, 3, pi * 3.3), 2e-6);
  EXPECT_LT(relative_error<2>(*half, box_cells<2>(10, 10., .2), 3, pi * 3.3),
            1e-3);
  EXPECT_NEAR(circle->level({5.03, 7.96}), 0.3, 1e-9);
  EXPECT_NEAR((circle->normal({5.03, 7.96}) - Point<2>(0, 1)).norm(), 0., 1e-9);
  EXPECT_FALSE(half->in_extent({5.03, 2.}));
  EXPECT_THROW(zero_of<2>("x + "), InputError);
  EXPECT_THROW(zero_of<2>("x + z"), InputError);
  EXPECT_THROW(zero_of<2>("x + t"), InputError);
  EXPECT_THROW(zero_of<2>("sqrt(x)")->level({-1., 0.}), InputError);
}

TEST(ExpressionSurface, OnAFaceBelongsToTheBodySide)
{
  // y = 0.5 is a mesh line of both meshes; the text is not a distance
  for (const double sign : {-1., 1.})
    {
      const auto line =
        zero_of<2>((sign > 0. ? "" : "-") + std::string("(3*y - 1.5)"));
      double sum = 0.;
      for (const auto &cell : box_cells<2>(4, 1., 0.))
        {
          std::vector<SurfacePoint<2>> points;
          line->pieces(cell, 2, points);
          if (!points.empty())
            {
              EXPECT_GT(line->level(centre<2>(cell)), 0.);
            }
          for (const auto &p : points)
            EXPECT_NEAR(p.x[1], .5, 1e-15);
          sum += measure(points);
        }
      EXPECT_NEAR(sum, 1., 1e-9);
    }
}

namespace
{
  /** A surface of known area whose normals cancel. */
  template <int dim>
  struct Closed
  {
    std::string         name;
    SurfacePointer<dim> surface;
    double              area;
  };

  /** Radius minus distance, or its square, from a point or an axis. */
  std::string
  round_text(const Point<3>     &c,
             const Tensor<1, 3> &axis,
             const double        radius,
             const bool          distance)
  {
    std::ostringstream text;
    text.precision(17);
    const auto from_centre = [&](const unsigned int d) {
      text << "("
           << "xyz"[d] << "-(" << c[d] << "))";
    };
    const auto square = [&]() {
      for (unsigned int d = 0; d < 3; ++d)
        {
          text << (d > 0 ? "+" : "");
          from_centre(d);
          text << "^2";
        }
      text << "-(";
      for (unsigned int d = 0; d < 3; ++d)
        {
          text << (d > 0 ? "+" : "") << "(" << axis[d] << ")*";
          from_centre(d);
        }
      text << ")^2";
    };
    text << radius << (distance ? "-sqrt(" : "^2-(");
    square();
    text << ")";
    return text.str();
  }

  std::vector<Closed<3>>
  closed_surfaces(const double radius, Numbers &random)
  {
    const Point<3>     c    = random.point<3>(2.9, 4.1);
    const Tensor<1, 3> axis = random.direction<3>();
    const Tensor<1, 3> up   = Point<3>::unit_vector(2);
    const Point<3>     on_line(3., 3., c[2]);
    const double       ball = 4. * pi * radius * radius, length = 1.6,
                 discs  = 2. * pi * radius * radius,
                 side   = 2. * pi * radius * length;
    const auto cylinder = [&](const Point<3> &p, const Tensor<1, 3> &a) {
      return make_cylinder(p - .5 * length * a, p + .5 * length * a, radius)
        ->rim();
    };
    const auto      tube = make_cylinder(c - .5 * length * axis,
                                    c + .5 * length * axis,
                                    1.5 * radius,
                                    radius);
    const Extent<3> between{{{make_half_space<3>(c - .5 * length * axis, -axis),
                              true,
                              Extent<3>::Along::inner},
                             {make_half_space<3>(c + .5 * length * axis, axis),
                              true,
                              Extent<3>::Along::inner}}};
    return {{"sphere", make_ball<3>(c, radius)->rim(), ball},
            {"sphere about a vertex",
             make_ball<3>({3., 3., 3.}, radius)->rim(),
             ball},
            {"around a sphere", make_ball<3>(c, radius)->rim("", false), ball},
            {"cylinder", cylinder(c, axis), side + discs},
            {"upright cylinder", cylinder(c, up), side + discs},
            {"cylinder about a mesh line", cylinder(on_line, up), side + discs},
            {"tube", tube->rim(), 2.5 * side + 1.25 * discs},
            {"inner wall", tube->rim("inner"), side},
            {"quadratic expression",
             zero_of<3>(round_text(c, {}, radius, false)),
             ball},
            {"distance expression",
             zero_of<3>(round_text(c, {}, radius, true)),
             ball},
            {"cylinder expression",
             zero_of<3>(round_text(c, axis, radius, false), between),
             side}};
  }

  /** Area to 1 %, normals that cancel, all points on the surface; with the
   * points that loads have. */
  template <int dim>
  void
  expect_closed(const Closed<dim> &closed,
                const Cells<dim>  &cells,
                const std::string &message)
  {
    Tensor<1, dim> sum;
    double         area = 0.;
    for (const auto &p : all_pieces<dim>(*closed.surface, cells, 3))
      {
        area += p.JxW;
        sum += p.JxW * p.normal;
        EXPECT_NEAR(closed.surface->level(p.x), 0., 1e-3) << message;
        EXPECT_NEAR(p.normal.norm(), 1., 1e-12) << message;
      }
    EXPECT_NEAR(area / closed.area, 1., 1e-2) << message;
    EXPECT_LT(sum.norm() / closed.area, 1e-2) << message;
  }
} // namespace

TEST(SmallSurfaces, AreaAndNormals)
{
  // cells of size 1; a surface may enter a cell through one face only
  Numbers    random(5);
  const auto even = box_cells<3>(7, 7., 0.), bent = box_cells<3>(7, 7., 0.15);
  bool       is_even = false;
#ifdef DEBUG // which is ten times as slow
  const std::vector<double> radii = {.15, .4, 1.2};
#else
  const std::vector<double> radii = {
    .1, .15, .2, .3, .4, .55, .7, .9, 1.2, 1.5, 1.9};
#endif
  for (const double radius : radii)
    {
      is_even = !is_even;
      for (const auto &closed : closed_surfaces(radius, random))
        expect_closed<3>(closed,
                         is_even ? even : bent,
                         closed.name + " of radius " + std::to_string(radius));
    }
}

TEST(SmallSurfaces, LengthOfExpressions)
{
  Numbers random(6);
  for (const double distortion : {0., 0.15})
    {
      const auto cells = box_cells<2>(7, 7., distortion);
      for (const double radius : {.1, .15, .2, .3, .4, .55, .7, .9, 1.2, 2.8})
        for (const bool distance : {false, true})
          {
            const Point<2> c = random.point<2>(2.9, 4.1);
            const auto     x = std::to_string(c[0]), y = std::to_string(c[1]),
                       r      = std::to_string(radius);
            const auto square = "((x-" + x + ")^2+(y-" + y + ")^2)";
            expect_closed<2>({"circle",
                              zero_of<2>(distance ? r + "-sqrt" + square :
                                                    r + "^2-" + square),
                              2. * pi * radius},
                             cells,
                             "circle of radius " + r);
          }
    }
}

TEST(SmallSurfaces, CoarserThanTheLimitIsRefused)
{
  const auto cells = box_cells<3>(3, 3., 0.);
  const auto ball  = make_ball<3>({1.4, 1.3, 1.6}, 0.03)->rim();
  EXPECT_THROW(all_pieces<3>(*ball, cells, 2), InputError);
}
