// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/convex_polytope.h>
#include <moraine/geometry/shapes.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace moraine;
using dealii::Point;
using dealii::Tensor;
using dealii::numbers::PI;

namespace
{
  template <int dim>
  using ShapePtr = std::shared_ptr<const Shape<dim>>;

  template <int dim>
  ShapePtr<dim>
  box(const Point<dim> &lower, const Point<dim> &upper)
  {
    return make_box<dim>(lower, upper);
  }

  template <int dim>
  ShapePtr<dim>
  rotated(const ShapePtr<dim>  &shape,
          const double          degrees,
          const Point<dim>     &centre,
          const Tensor<1, dim> &axis        = Tensor<1, dim>(),
          const Tensor<1, dim> &translation = Tensor<1, dim>())
  {
    return make_moved<dim>(shape,
                           Placement<dim>(degrees, centre, axis, translation));
  }

  struct Total
  {
    double       volume = 0.;
    Tensor<1, 3> centroid;
  };

  // Sum over n^dim cells of a mesh of this size whose lower corner is off by
  // odd amounts; 2D cells may be sheared and tapered.
  template <int dim>
  Total
  total_over_mesh(const Shape<dim>  &shape,
                  const double       lower,
                  const double       upper,
                  const unsigned int n,
                  const bool         bent = false)
  {
    const double h = (upper - lower) / n;
    Total        total;
    unsigned int n_cells = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_cells *= n;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        CellVertices<dim> vertices;
        for (unsigned int v = 0; v < vertices.size(); ++v)
          {
            unsigned int rest = c;
            for (unsigned int d = 0; d < dim; ++d, rest /= n)
              vertices[v][d] =
                lower + 0.0137 * (d + 1) * h + h * (rest % n + ((v >> d) & 1));
            if (bent)
              {
                const Point<dim> x = vertices[v];
                for (unsigned int d = 0; d < dim; ++d)
                  vertices[v][d] += 0.15 * h * std::sin(9. * x[(d + 1) % dim]);
              }
          }
        const auto part = shape.clip(ConvexPolytope<dim>(vertices));
        total.volume += part.volume;
        for (unsigned int d = 0; d < dim; ++d)
          total.centroid[d] += part.volume * part.centroid[d];
      }
    total.centroid /= total.volume;
    return total;
  }

  void
  expect_total(const Total        &total,
               const double        volume,
               const Tensor<1, 3> &centroid,
               const double        tolerance)
  {
    EXPECT_NEAR(total.volume / volume, 1., tolerance);
    EXPECT_LT((total.centroid - centroid).norm(), tolerance);
  }

  constexpr double exact = 1e-13;
} // namespace



TEST(StraightShapes, RotatedBoxes)
{
  const auto flat  = box(Point<2>(0.2, 0.3), Point<2>(0.9, 0.7));
  const auto solid = box(Point<3>(0.2, 0.3, 0.1), Point<3>(0.9, 0.7, 0.6));
  for (const double degrees : {0., 17., 30., 45., 90., 211.})
    for (const bool bent : {false, true})
      {
        expect_total(total_over_mesh(*rotated(flat, degrees, {0.55, 0.5}),
                                     -0.5,
                                     1.5,
                                     13,
                                     bent),
                     0.28,
                     Tensor<1, 3>({0.55, 0.5, 0.}),
                     exact);
        expect_total(total_over_mesh(*rotated(solid,
                                              degrees,
                                              {0.55, 0.5, 0.35},
                                              Tensor<1, 3>({1., 2., 3.})),
                                     -0.5,
                                     1.5,
                                     7,
                                     bent),
                     0.14,
                     Tensor<1, 3>({0.55, 0.5, 0.35}),
                     exact);
      }
}



TEST(StraightShapes, RotationAboutACentreThenTranslation)
{
  const Placement<2> motion(90., {1., 0.}, {}, Tensor<1, 2>({0., 5.}));
  EXPECT_EQ(motion.map(Point<2>(2., 0.)), Point<2>(1., 6.));
  EXPECT_EQ(motion.inverse(Point<2>(1., 6.)), Point<2>(2., 0.));
  const Placement<3> about_x(90., {}, Tensor<1, 3>({2., 0., 0.}), {});
  EXPECT_EQ(about_x.map(Point<3>(1., 1., 0.)), Point<3>(1., 0., 1.));
}



TEST(StraightShapes, NonConvexPolygon)
{
  // an L, both ways round, upright and turned; in 3D the prism over it
  std::vector<Point<2>> l{
    {0., 0.}, {0.9, 0.}, {0.9, 0.3}, {0.4, 0.3}, {0.4, 0.8}, {0., 0.8}};
  const double       area = 0.27 + 0.2;
  const Tensor<1, 3> centroid(
    {(0.27 * 0.45 + 0.2 * 0.2) / area, (0.27 * 0.15 + 0.2 * 0.55) / area, 0.});
  for (unsigned int turn = 0; turn < 2; ++turn)
    {
      const auto polygon = make_polygon<2>(l);
      const auto prism   = make_polygon<3>(l, std::make_pair(0.1, 0.55));
      for (const bool bent : {false, true})
        {
          expect_total(total_over_mesh(*polygon, -0.2, 1.1, 11, bent),
                       area,
                       centroid,
                       exact);
          expect_total(total_over_mesh<2>(
                         *rotated<2>(polygon, 33., {}), -1.2, 1.2, 11, bent),
                       area,
                       std::cos(33. * PI / 180.) * centroid +
                         std::sin(33. * PI / 180.) *
                           Tensor<1, 3>({-centroid[1], centroid[0], 0.}),
                       exact);
          expect_total(total_over_mesh(*prism, -0.3, 1.2, 6, bent),
                       0.45 * area,
                       centroid + Tensor<1, 3>({0., 0., 0.325}),
                       exact);
        }
      EXPECT_NEAR(polygon->level(Point<2>(0.2, 0.6)), 0.2, 1e-15);
      EXPECT_NEAR(polygon->level(Point<2>(0.7, 0.7)), -0.3, 1e-15);
      EXPECT_NEAR(polygon->level(Point<2>(-3., -4.)), -5., 1e-15);
      EXPECT_TRUE(prism->contains(Point<3>(0.2, 0.6, 0.5)));
      EXPECT_FALSE(prism->contains(Point<3>(0.2, 0.6, 0.6)));
      std::reverse(l.begin(), l.end());
    }
}



TEST(StraightShapes, Crossings)
{
  const auto n = [](const unsigned int i) { return std::make_pair(i, i); };
  EXPECT_EQ(first_crossing({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}), n(4));
  EXPECT_EQ(first_crossing({{0., 0.}, {1., 1.}, {1., 0.}, {0., 1.}}),
            std::make_pair(0u, 2u));
  EXPECT_EQ(first_crossing({{0., 0.}, {0., 0.}, {1., 0.}, {0., 1.}}), n(0));
  // a vertex on another edge, and an edge that folds back
  EXPECT_EQ(first_crossing({{0., 0.}, {2., 0.}, {2., 2.}, {1., 0.}, {0., 2.}}),
            std::make_pair(0u, 2u));
  EXPECT_EQ(first_crossing({{0., 0.}, {2., 0.}, {1., 0.}, {1., 1.}}),
            std::make_pair(0u, 1u));
}



TEST(CombinedShapes, BoxWithoutRotatedBox)
{
  const auto         outer = box(Point<2>(), Point<2>(1., 1.));
  const auto         hole = rotated(box(Point<2>(0.3, 0.4), Point<2>(0.7, 0.6)),
                            30.,
                            Point<2>(0.4, 0.5));
  const double       c = std::cos(PI / 6.), s = std::sin(PI / 6.);
  const Tensor<1, 3> hole_centre({0.4 + 0.1 * c, 0.5 + 0.1 * s, 0.});
  const Tensor<1, 3> rest =
    (Tensor<1, 3>({0.5, 0.5, 0.}) - 0.08 * hole_centre) / 0.92;
  for (const bool bent : {false, true})
    expect_total(total_over_mesh(*combine<2>(Operation::subtract, outer, hole),
                                 -0.2,
                                 1.3,
                                 9,
                                 bent),
                 0.92,
                 rest,
                 exact);

  const auto         cube = box(Point<3>(), Point<3>(1., 1., 1.));
  const Point<3>     middle(0.5, 0.45, 0.6);
  const Tensor<1, 3> half({0.2, 0.15, 0.1});
  const auto         turned = rotated(box(middle - half, middle + half),
                              40.,
                              middle,
                              Tensor<1, 3>({1., 2., 3.}));
  const double       cut    = 0.4 * 0.3 * 0.2;
  for (const bool bent : {false, true})
    expect_total(
      total_over_mesh(
        *combine<3>(Operation::subtract, cube, turned), -0.2, 1.3, 6, bent),
      1. - cut,
      (Tensor<1, 3>({0.5, 0.5, 0.5}) - cut * Tensor<1, 3>(middle)) / (1. - cut),
      exact);
}



TEST(CombinedShapes, OverlappingBoxes)
{
  const auto a = box(Point<2>(), Point<2>(1., 1.));
  const auto b = box(Point<2>(0.7, 0.4), Point<2>(1.7, 0.9));
  expect_total(
    total_over_mesh(*combine<2>(Operation::unite, a, b), -0.2, 2.1, 8),
    1.35,
    Tensor<1, 3>({(0.5 + 0.5 * 1.2 - 0.15 * 0.85) / 1.35,
                  (0.5 + 0.5 * 0.65 - 0.15 * 0.65) / 1.35,
                  0.}),
    exact);
  expect_total(
    total_over_mesh(*combine<2>(Operation::intersect, a, b), -0.2, 2.1, 8),
    0.15,
    Tensor<1, 3>({0.85, 0.65, 0.}),
    exact);

  // all three together: (a + b) - a = b - ab, after a common rotation
  const auto both = combine<2>(Operation::unite, a, b);
  const auto rest = rotated<2>(combine<2>(Operation::subtract, both, a),
                               20.,
                               Point<2>(1.35, 0.65));
  expect_total(total_over_mesh(*rest, -0.2, 2.1, 8, true),
               0.35,
               Tensor<1, 3>({1.35, 0.65, 0.}),
               exact);

  const auto c = box(Point<3>(), Point<3>(1., 1., 1.));
  const auto d = box(Point<3>(0.5, 0.5, 0.5), Point<3>(1.5, 1.5, 1.5));
  for (const bool bent : {false, true})
    expect_total(
      total_over_mesh(*combine<3>(Operation::unite, c, d), -0.2, 1.8, 6, bent),
      1.875,
      Tensor<1, 3>({0.75, 0.75, 0.75}),
      exact);
}



TEST(CombinedShapes, BoundingBoxes)
{
  const auto a = box(Point<2>(), Point<2>(1., 1.));
  const auto half =
    make_half_space<2>(Point<2>(0.5, 0.), Tensor<1, 2>({2., 0.}));
  EXPECT_FALSE(is_finite(half->bounding_box()));
  EXPECT_FALSE(is_finite(rotated<2>(half, 30., {})->bounding_box()));
  const auto common = combine<2>(Operation::intersect, half, a);
  EXPECT_TRUE(is_finite(common->bounding_box()));
  EXPECT_EQ(common->bounding_box().upper_bound(0), 1.);
  expect_total(total_over_mesh(*common, -0.1, 1.2, 7),
               0.5,
               Tensor<1, 3>({0.25, 0.5, 0.}),
               exact);
  const auto turned = rotated(a, 45., Point<2>(0.5, 0.5))->bounding_box();
  EXPECT_NEAR(turned.upper_bound(1), 0.5 + std::sqrt(0.5), 1e-15);
}



TEST(CurvedShapes, DiscAndRingAreExact)
{
  const Point<2>     centre(0.31, 0.27);
  const Tensor<1, 3> at({0.31, 0.27, 0.});
  const auto         disc  = make_ball<2>(centre, 0.9);
  const auto         inner = make_ball<2>(centre, 0.4);
  const auto         ring  = combine<2>(Operation::hollow_out, disc, inner);
  for (const unsigned int n : {1, 3, 20})
    for (const bool bent : {false, true})
      {
        expect_total(total_over_mesh(*disc, -1., 1.6, n, bent),
                     PI * 0.81,
                     at,
                     exact);
        expect_total(total_over_mesh(*ring, -1., 1.6, n, bent),
                     PI * 0.65,
                     at,
                     exact);
      }
  EXPECT_NEAR(ring->level(Point<2>(0.31, 0.8)), 0.13, 1e-15);

  // half a disc, and a box with a round hole in its corner
  const auto half = make_half_space<2>(centre, Tensor<1, 2>({1., 0.}));
  expect_total(
    total_over_mesh(*combine<2>(Operation::intersect, disc, half), -1., 1.6, 9),
    PI * 0.405,
    Tensor<1, 3>({0.31 - 4. * 0.9 / (3. * PI), 0.27, 0.}),
    exact);
  const auto plate = box(centre, centre + Tensor<1, 2>({1., 1.}));
  EXPECT_NEAR(
    total_over_mesh(*combine<2>(Operation::subtract, plate, disc), -1., 1.6, 9)
      .volume,
    1. - PI * 0.81 / 4.,
    exact);
}



TEST(CurvedShapes, SphereIsExact)
{
  const Point<3> centre(0.31, 0.27, 0.29);
  const auto     sphere = make_ball<3>(centre, 0.9);
  for (const unsigned int n : {1, 3, 8})
    for (const bool bent : {false, true})
      expect_total(total_over_mesh(*sphere, -1., 1.6, n, bent),
                   4. / 3. * PI * std::pow(0.9, 3),
                   Tensor<1, 3>(centre),
                   exact);

  // faces through the centre, and a corner there
  const auto eighth = sphere->clip(
    ConvexPolytope<3>(centre, centre + Tensor<1, 3>({1., 1., 1.})));
  EXPECT_NEAR(eighth.volume / (PI / 6. * std::pow(0.9, 3)), 1., exact);
  const double arm = 3. / 8. * 0.9;
  EXPECT_LT((eighth.centroid - centre - Tensor<1, 3>({arm, arm, arm})).norm(),
            exact);
  // a cap of height 0.1
  const auto cap =
    sphere->clip(ConvexPolytope<3>(centre + Tensor<1, 3>({0.8, -1., -1.}),
                                   centre + Tensor<1, 3>({1., 1., 1.})));
  EXPECT_NEAR(cap.volume / (PI * 0.01 / 3. * 2.6), 1., 1e-11);
}



TEST(CurvedShapes, Cylinder)
{
  const Point<3> start(0.3, 0.2, -0.4);
  const auto     upright =
    make_cylinder(start, start + Tensor<1, 3>({0., 0., 1.2}), 0.5);
  const auto bore =
    make_cylinder(start, start + Tensor<1, 3>({0., 0., 1.2}), 0.2);
  expect_total(total_over_mesh(*upright, -1., 1.6, 6),
               PI * 0.25 * 1.2,
               Tensor<1, 3>({0.3, 0.2, 0.2}),
               exact);
  expect_total(
    total_over_mesh(
      *combine<3>(Operation::hollow_out, upright, bore), -1., 1.6, 6),
    PI * 0.21 * 1.2,
    Tensor<1, 3>({0.3, 0.2, 0.2}),
    exact);
  const Tensor<1, 3> way({0.3, 0.5, 1.});
  const auto         inclined = make_cylinder(start, start + way, 0.5);
  expect_total(total_over_mesh(*inclined, -1.2, 1.6, 5),
               PI * 0.25 * way.norm(),
               Tensor<1, 3>(start + way / 2.),
               exact);
  // faces that are nearly along the axis
  for (const double tilt : {1e-2, 1e-5, 1e-8, 1e-11})
    {
      const Tensor<1, 3> axis({tilt, 2. * tilt, 1.2});
      expect_total(
        total_over_mesh(*make_cylinder(start, start + axis, 0.5), -1., 1.6, 6),
        PI * 0.25 * axis.norm(),
        Tensor<1, 3>(start + axis / 2.),
        exact);
    }
  const auto box = inclined->bounding_box();
  EXPECT_NEAR(box.upper_bound(2),
              0.6 + 0.5 * std::sqrt(0.34) / way.norm(),
              1e-14);
}



TEST(CurvedShapes, TwoCurvedOperands)
{
  // lens of two discs of radius 1 at distance 1
  const auto   a    = make_ball<2>(Point<2>(0., 0.), 1.);
  const auto   b    = make_ball<2>(Point<2>(1., 0.), 1.);
  const double lens = 2. * PI / 3. - std::sqrt(3.) / 2.;
  expect_total(
    total_over_mesh(*combine<2>(Operation::intersect, a, b), -1., 2., 15),
    lens,
    Tensor<1, 3>({0.5, 0., 0.}),
    1e-7);
  expect_total(
    total_over_mesh(*combine<2>(Operation::unite, a, b), -2.1, 2.1, 21),
    2. * PI - lens,
    Tensor<1, 3>({0.5, 0., 0.}),
    1e-7);
}



// What takes twice as long with each operand does not end.
TEST(CombinedShapes, ManyOperands)
{
  constexpr unsigned int n = 40;
  ShapePointer<2>        boxes;
  for (unsigned int i = 0; i < n; ++i)
    {
      const auto box =
        make_box<2>(Point<2>(i + 0.25, 0.25), Point<2>(i + 0.75, 1.));
      boxes = boxes ? combine<2>(Operation::unite, boxes, box) : box;
    }
  const ConvexPolytope<2> all(Point<2>(0, 0), Point<2>(n, 1));
  EXPECT_NEAR(boxes->clip(all).volume, n * 0.375, 1e-12 * n);

  auto rest = make_box<2>(Point<2>(0, 0), Point<2>(n, 0.5));
  rest      = combine<2>(Operation::subtract, rest, boxes);
  EXPECT_NEAR(rest->clip(all).volume, n * (0.5 - 0.125), 1e-12 * n);
}



TEST(CurvedShapes, ExpressionsCoverByLengths)
{
  for (const std::string scale : {"1", "1e-4", "1e4"})
    {
      const auto disc  = make_expression<2>(scale + " * (1 - x^2 - y^2)", "");
      const auto moved = make_moved<2>(disc, {0., {}, {}, Point<2>(1., 0.)});
      const auto lens  = combine<2>(Operation::intersect, disc, moved);
      const auto moon  = combine<2>(Operation::subtract, disc, moved);
      EXPECT_TRUE(disc->covers({1.0005, 0.}, 1e-3));
      EXPECT_FALSE(disc->covers({1.002, 0.}, 1e-3));
      EXPECT_FALSE(disc->covers({0.9995, 0.}, -1e-3));
      EXPECT_TRUE(disc->covers({0.998, 0.}, -1e-3));
      EXPECT_TRUE(lens->covers({-0.0005, 0.}, 1e-3));
      EXPECT_FALSE(lens->covers({-0.002, 0.}, 1e-3));
      EXPECT_TRUE(moon->covers({0.0005, 0.}, 1e-3));
      EXPECT_FALSE(moon->covers({0.002, 0.}, 1e-3));
    }
}



TEST(CurvedShapes, Expressions)
{
  const auto disc = make_expression<2>("1 - x^2 - y^2", "");
  expect_total(total_over_mesh(*disc, -1.2, 1.2, 20), PI, {}, 1e-7);
  const auto square = make_expression<2>("min(1 - abs(x), 1 - abs(y))", "");
  expect_total(total_over_mesh(*square, -1.2, 1.2, 10), 4., {}, 1e-6);
  const auto sphere = make_expression<3>("1 - x^2 - y^2 - z^2", "");
  expect_total(total_over_mesh(*sphere, -1.2, 1.2, 8), 4. / 3. * PI, {}, 1e-6);

  EXPECT_THROW(make_expression<2>("1 - x^^2", "key 'Expression'"), InputError);
  EXPECT_THROW(make_expression<2>("1/x", "")->level({0., 1.}), InputError);
}
