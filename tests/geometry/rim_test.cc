// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>

#include <moraine/geometry/shapes.h>

#include <gtest/gtest.h>

#include "surface_cases.h"

using namespace dealii;
using namespace moraine;
using namespace moraine_tests;

namespace
{
  template <int dim>
  using ShapePtr = std::shared_ptr<const Shape<dim>>;

  template <int dim>
  ShapePtr<dim>
  box_shape(const Point<dim> &lower, const Point<dim> &upper)
  {
    return make_box<dim>(lower, upper);
  }

  template <int dim>
  ShapePtr<dim>
  turned(const ShapePtr<dim> &shape, const double degrees)
  {
    Point<dim> middle;
    for (unsigned int d = 0; d < dim; ++d)
      middle[d] = 1.;
    Tensor<1, dim> axis;
    for (unsigned int d = 0; d < dim; ++d)
      axis[d] = d + 1.;
    return make_moved<dim>(
      shape, Placement<dim>(degrees, middle, axis, Tensor<1, dim>()));
  }

  template <int dim>
  ShapePtr<dim>
  combination(const Operation      operation,
              const ShapePtr<dim> &a,
              const ShapePtr<dim> &b)
  {
    return combine<dim>(operation,
                        a,
                        b,
                        std::array<std::string, 2>{{"a", "b"}});
  }

  template <int dim>
  struct Case
  {
    ShapePtr<dim>                 shape;
    std::map<std::string, double> parts; ///< length or area of each; "": whole
    double                        tolerance;
  };

  /**
   * The parts have the measures given and end where the body ends, the normals
   * point out of the body, and the divergence theorem holds:
   * int n = 0, int x . n = dim volume.
   */
  template <int dim>
  void
  expect_rims(const std::vector<Case<dim>> &cases, const unsigned int n)
  {
    for (unsigned int i = 0; i < cases.size(); ++i)
      for (const double distortion : {0., 0.15})
        for (const auto &[part, exact] : cases[i].parts)
          {
            const auto &[shape, parts, tolerance] = cases[i];
            // rims that are approximate may end by so much too far or too near
            const double slack   = tolerance < 1e-11 ? 1e-9 : 1e-3;
            const auto   cells   = box_cells<dim>(n, 2., distortion);
            const auto   surface = shape->rim(part);
            ASSERT_TRUE(surface) << i << part;
            const auto     points = all_pieces(*surface, cells, 6);
            Tensor<1, dim> closed;
            double         volume = 0.;
            for (const auto &p : points)
              {
                EXPECT_LT(std::abs(shape->level(p.x)), slack)
                  << i << part << ' ' << p.x;
                EXPECT_GT(shape->level(p.x - 10. * slack * p.normal),
                          shape->level(p.x + 10. * slack * p.normal))
                  << i << part << ' ' << p.x;
                if (slack < 1e-6)
                  {
                    EXPECT_NEAR(surface->level(p.x), 0., slack);
                  }
                EXPECT_GT(p.JxW, 0.);
                closed += p.JxW * p.normal;
                volume += p.JxW * (p.x * p.normal) / dim;
              }
            EXPECT_NEAR(measure(points) / exact, 1., tolerance) << i << part;
            if (!part.empty())
              continue;
            double clipped = 0.;
            for (const auto &cell : cells)
              clipped += shape->clip(ConvexPolytope<dim>(cell)).volume;
            EXPECT_NEAR(volume / clipped, 1., tolerance) << i;
            EXPECT_LT(closed.norm(), tolerance * exact) << i;
          }
  }
} // namespace

TEST(Rim, OfEveryShapeInTwoDimensions)
{
  const std::vector<Point<2>> l{
    {.31, .32}, {1.61, .32}, {1.61, .83}, {.74, .83}, {.74, 1.52}, {.31, 1.52}};
  const std::vector<Point<2>> backwards(l.rbegin(), l.rend());
  const auto                  wide    = box_shape<2>({.21, .33}, {1.62, 1.04});
  const auto                  tall    = box_shape<2>({.63, .12}, {1.11, 1.83});
  const auto                  disc    = make_ball<2>(Point<2>(1., 1.), .7);
  const auto                  hole    = make_ball<2>(Point<2>(1., 1.), .3);
  const auto                  quarter = box_shape<2>({1., 1.}, {1.95, 1.95});
  const auto   ring  = combination<2>(Operation::hollow_out, disc, hole);
  const double exact = 1e-12;
  expect_rims<2>(
    {{wide,
      {{"", 4.24},
       {"left", .71},
       {"right", .71},
       {"bottom", 1.41},
       {"top", 1.41}},
      exact},
     {turned<2>(wide, 33.), {{"", 4.24}, {"left", .71}, {"top", 1.41}}, exact},
     {make_polygon<2>(l),
      {{"", 5.}, {"1", 1.3}, {"2", .51}, {"3", .87}, {"4", .69}, {"6", 1.2}},
      exact},
     {make_polygon<2>(backwards),
      {{"", 5.}, {"1", .43}, {"2", .69}, {"4", .51}, {"5", 1.3}, {"6", 1.2}},
      exact},
     {disc, {{"", 1.4 * numbers::PI}}, exact},
     {ring,
      {{"", 2. * numbers::PI},
       {"a", 1.4 * numbers::PI},
       {"b", .6 * numbers::PI}},
      exact},
     {combination<2>(Operation::unite, wide, tall),
      {{"", 6.24}, {"a", 4.24 - .96}, {"b", 4.38 - 1.42}},
      exact},
     {combination<2>(Operation::intersect, wide, tall),
      {{"", 2.38}, {"a", .96}, {"b", 1.42}, {"a/bottom", .48}, {"b/left", .71}},
      exact},
     {combination<2>(Operation::subtract, wide, tall),
      {{"", 4.24 - .96 + 1.42}, {"a", 4.24 - .96}, {"b", 1.42}},
      exact},
     {turned<2>(combination<2>(Operation::intersect, ring, quarter), 20.),
      {{"", .5 * numbers::PI + .8},
       {"a/a", .35 * numbers::PI},
       {"a/b", .15 * numbers::PI},
       {"b/left", .4},
       {"b/bottom", .4}},
      exact}},
    9);
}

TEST(Rim, SharedByTwoOperandsIsCountedOnce)
{
  // flush sides that look alike, and sides that touch from both sides
  const auto left  = box_shape<2>({.2, .4}, {.8, 1.2}),
             right = box_shape<2>({.8, .4}, {1.5, .9}),
             over  = box_shape<2>({.5, .4}, {1.5, .9});
  expect_rims<2>({{combination<2>(Operation::unite, left, right),
                   {{"", 4.2}, {"a/right", .3}, {"a/bottom", .6}},
                   1e-12},
                  {combination<2>(Operation::unite, left, over),
                   {{"", 4.2}, {"a/bottom", .6}, {"b/bottom", .7}},
                   1e-12},
                  {combination<2>(Operation::intersect, left, over),
                   {{"", 1.6}, {"a/bottom", .3}},
                   1e-12},
                  {combination<2>(Operation::subtract, left, over),
                   {{"", 2.8}, {"a/bottom", .3}, {"b/left", .5}},
                   1e-12},
                  {combination<2>(Operation::subtract, left, right),
                   {{"", 2.8}, {"a/right", .8}},
                   1e-12}},
                 10);
  expect_rims<3>({{combination<3>(Operation::unite,
                                  box_shape<3>({.2, .4, .1}, {.8, 1.2, .9}),
                                  box_shape<3>({.8, .4, .1}, {1.5, .9, .9})),
                   {{"", 2. * (.48 + .35) + .8 * 4.2}, {"a/right", .3 * .8}},
                   1e-5}},
                 5);
}

TEST(Rim, OfStraightShapesInThreeDimensions)
{
  const std::vector<Point<2>> l{
    {.31, .32}, {1.61, .32}, {1.61, .83}, {.74, .83}, {.74, 1.52}, {.31, 1.52}};
  const double l_area = 1.3 * .51 + .43 * .69;
  const auto   a      = box_shape<3>({.21, .33, .42}, {1.62, 1.04, 1.51});
  const auto   b      = box_shape<3>({.63, .12, .23}, {1.11, 1.83, .97});
  const double a_area = 2. * (1.41 * .71 + 1.41 * 1.09 + .71 * 1.09);
  const double b_area = 2. * (.48 * 1.71 + .48 * .74 + 1.71 * .74);
  // b goes through a from front to back and ends inside it at the top
  const double b_in_a = .48 * .71 + 2. * .71 * .55;
  const double a_in_b = .48 * .71 + 2. * .48 * .55;
  expect_rims<3>(
    {{a,
      {{"", a_area},
       {"left", .71 * 1.09},
       {"right", .71 * 1.09},
       {"front", 1.41 * 1.09},
       {"back", 1.41 * 1.09},
       {"bottom", 1.41 * .71},
       {"top", 1.41 * .71}},
      1e-12},
     {turned<3>(a, 25.), {{"", a_area}, {"front", 1.41 * 1.09}}, 1e-12},
     {make_polygon<3>(l, std::make_pair(.3, 1.7)),
      {{"", 2. * l_area + 1.4 * 5.},
       {"1", 1.4 * 1.3},
       {"bottom", l_area},
       {"top", l_area}},
      1e-12},
     {combination<3>(Operation::subtract, a, b),
      {{"", a_area - a_in_b + b_in_a},
       {"a", a_area - a_in_b},
       {"b/top", .48 * .71}},
      1e-5},
     {combination<3>(Operation::unite, a, b),
      {{"", a_area - a_in_b + b_area - b_in_a}, {"b", b_area - b_in_a}},
      1e-5}},
    4);
}

TEST(Rim, OfRoundShapesInThreeDimensions)
{
  const auto ball = make_ball<3>(Point<3>(1., 1., 1.), .7);
  const auto hole = make_ball<3>(Point<3>(1., 1., 1.), .4);
  const auto cylinder =
    make_cylinder(Point<3>(1., 1., .31), Point<3>(1., 1., 1.62), .6);
  const auto tube =
    make_cylinder(Point<3>(1., 1., .31), Point<3>(1., 1., 1.62), .6, .35);
  expect_rims<3>({{ball, {{"", 4. * numbers::PI * .49}}, 1e-4},
                  {combination<3>(Operation::hollow_out, ball, hole),
                   {{"", 4. * numbers::PI * .65},
                    {"a", 4. * numbers::PI * .49},
                    {"b", 4. * numbers::PI * .16}},
                   5e-4},
                  {cylinder,
                   {{"bottom", numbers::PI * .36}, {"top", numbers::PI * .36}},
                   1e-4},
                  {tube,
                   {{"bottom", numbers::PI * (.36 - .1225)},
                    {"top", numbers::PI * (.36 - .1225)}},
                   1e-4}},
                 10);
  // the ends of the sides are exact on a regular mesh only
  const auto cells = box_cells<3>(12, 2., 0.);
  for (const auto &[shape, part, exact] :
       std::vector<std::tuple<ShapePtr<3>, std::string, double>>{
         {cylinder, "side", 2. * numbers::PI * .6 * 1.31},
         {tube, "outer", 2. * numbers::PI * .6 * 1.31},
         {tube, "inner", 2. * numbers::PI * .35 * 1.31}})
    EXPECT_NEAR(measure(all_pieces(*shape->rim(part), cells, 4)) / exact,
                1.,
                2e-4)
      << part;
}

TEST(Rim, OfAnExpressionAndOfNone)
{
  const auto disc  = make_expression<2>("0.49 - (x-1)^2 - (y-1)^2", "here");
  const auto cells = box_cells<2>(20, 2., 0.);
  EXPECT_NEAR(measure(all_pieces(*disc->rim(), cells, 3)),
              1.4 * numbers::PI,
              1e-6);
  EXPECT_TRUE(disc->parts().empty());
  EXPECT_FALSE(make_space<2>()->rim());
  const auto half = make_half_space<2>({1., .3}, Point<2>(0., 2.));
  EXPECT_NEAR(measure(all_pieces(*half->rim(), cells, 2)), 2., 1e-12);
}

TEST(Rim, EndsWhereTheBodyEnds)
{
  const auto ring    = combination<2>(Operation::hollow_out,
                                   make_ball<2>(Point<2>(), .7),
                                   make_ball<2>(Point<2>(), .3));
  const auto quarter = combination<2>(Operation::intersect,
                                      ring,
                                      box_shape<2>({0., 0.}, {1., 1.}));
  EXPECT_EQ(
    quarter->parts(),
    (std::vector<std::string>{
      "a", "a/a", "a/b", "b", "b/left", "b/right", "b/bottom", "b/top"}));
  const auto inner = quarter->rim("a/b");
  EXPECT_TRUE(inner->in_extent({.2, .1}));
  EXPECT_FALSE(inner->in_extent({-.2, .1}));
  EXPECT_NEAR(inner->level({.6, 0.}), .3, 1e-15);
  EXPECT_NEAR((inner->normal({.3, 0.}) - Point<2>(-1., 0.)).norm(), 0., 1e-15);
  const auto bottom = quarter->rim("b/bottom");
  EXPECT_TRUE(bottom->in_extent({.5, .1}));
  EXPECT_FALSE(bottom->in_extent({.2, .1}));
  EXPECT_FALSE(bottom->in_extent({.8, .1}));
  const auto whole = quarter->rim();
  EXPECT_TRUE(whole->in_extent({.5, .01}));
  EXPECT_NEAR(whole->level({.5, .01}), .01, 1e-15);
  EXPECT_NEAR(whole->level({.31, .31}), .31 * std::sqrt(2.) - .3, 1e-15);
}
