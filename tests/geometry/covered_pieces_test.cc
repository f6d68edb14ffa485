// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/covered_pieces.h>
#include <moraine/geometry/shapes.h>

#include <gtest/gtest.h>

#include <cmath>

#include "surface_cases.h"

using namespace dealii;
using namespace moraine;
using namespace moraine_tests;

namespace
{
  /** The area of a plane across a box of cells that is kept where a half-space,
   * which ends along the normal @p edge at the distance @p d of the plane's @p
   * middle, has it. */
  template <int dim>
  double
  kept_area(const Tensor<1, dim> &normal,
            const Point<dim>     &middle,
            const Tensor<1, dim> &edge,
            const double          d,
            double               &all)
  {
    const auto plane =
      make_plane<dim>(HalfSpace<dim>{middle, normal}, Extent<dim>(), {});
    const auto body =
      make_half_space<dim>(middle + d * edge / edge.norm(), edge);
    const auto   covers = covers_of<dim>({body});
    const double h      = 10. / 5;
    double       area   = 0;
    all                 = 0;
    for (const auto &cell : box_cells<dim>(5, 10., 0.))
      {
        std::vector<SurfacePoint<dim>> kept, whole;
        plane->pieces(cell, 4, whole);
        add_kept_pieces<dim>(
          *plane,
          cell,
          4,
          [&](const SurfacePoint<dim> &p) {
            return is_at_body(covers, p.x, p.normal, h);
          },
          kept);
        for (const auto &p : kept)
          area += p.JxW;
        for (const auto &p : whole)
          all += p.JxW;
      }
    return area;
  }
} // namespace

TEST(CoveredPieces, AreaUpToTheEdgeOfABody)
{
  // Along y, so that areas are known.
  for (const double d : {-3.1, -0.4, 0., 0.77, 2.9})
    {
      Tensor<1, 2> normal, edge;
      normal[0] = 1;
      edge[1]   = 1;
      double       all;
      const double area = kept_area<2>(normal, Point<2>(4.3, 5), edge, d, all);
      EXPECT_NEAR(all, 10., 1e-12);
      EXPECT_NEAR(area, 5. + d, 0.07 * 2) << d;
    }
  for (const double d : {-3.1, -0.4, 0., 0.77, 2.9})
    {
      Tensor<1, 3> normal, edge;
      normal[0] = 1;
      edge[1]   = 1;
      double       all;
      const double area =
        kept_area<3>(normal, Point<3>(4.3, 5, 5), edge, d, all);
      EXPECT_NEAR(all, 100., 1e-11);
      EXPECT_NEAR(area, 10 * (5. + d), 10 * 0.07 * 2) << d;
    }
}

TEST(CoveredPieces, BodiesWithoutShapeAreEverywhere)
{
  EXPECT_FALSE(covers_of<2>({nullptr}));
}
