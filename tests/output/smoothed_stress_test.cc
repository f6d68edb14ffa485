// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/smoothed_stress.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <type_traits>

#include "scene.h"

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** 8 x 4 (x 2) cells of size 1/2, each with 2^dim points at the middles of
     * its parts, of body 1 right of x = 2. */
    template <int dim>
    class FilledCells
    {
    public:
      const BackgroundMesh<dim> mesh;
      PointSet<dim>             points;

      explicit FilledCells(
        const std::function<double(const Point<dim> &, const unsigned int)>
          &mean_stress)
        : mesh(parameters(), MPI_COMM_WORLD)
        , points(mesh, {})
      {
        constexpr unsigned int n  = 1 << dim;
        unsigned int           id = 0;
        for (const auto &cell : mesh.triangulation().active_cell_iterators())
          {
            id += n;
            if (cell->is_locally_owned())
              for (unsigned int i = 0; i < n; ++i)
                {
                  Point<dim> unit;
                  for (unsigned int d = 0; d < dim; ++d)
                    unit[d] = i & (1u << d) ? 0.75 : 0.25;
                  const Point<dim> x = cell->vertex(0) + 0.5 * unit;
                  points.insert(
                    cell, x, unit, id + i, x[0] > 2, cell->measure() / n);
                }
          }
        points.finish_insertion();
        for (unsigned int p = 0; p < points.n_local(); ++p)
          for (unsigned int c = 0; c < 3; ++c)
            points.values(p)[points.stress_offset() + c] =
              mean_stress(points.position(p), points.body(p)) + c - 1.;
      }

    private:
      static MeshParameters<dim>
      parameters()
      {
        MeshParameters<dim> parameters = mesh_parameters<dim>();
        for (auto &n : parameters.cells)
          n *= 2;
        return parameters;
      }
    };



    /** Whether @p x is more than a cell away from the rim and from x = 2. */
    template <int dim>
    bool
    is_inside(const Point<dim> &x)
    {
      return x[0] > 0.5 && x[0] < 3.5 && std::abs(x[0] - 2) > 0.5 &&
             x[1] > 0.5 && x[1] < 1.5;
    }
  } // namespace



  template <typename T>
  struct Smoothed : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>,
                                    std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(Smoothed, Dimensions);



  TYPED_TEST(Smoothed, linear_stress_stays_inside_of_bodies)
  {
    constexpr int          dim = TypeParam::value;
    const FilledCells<dim> scene([](const auto &x, const unsigned int body) {
      return body == 0 ? 3 * x[0] - x[1] : 1e6 + x[1];
    });
    const auto             smoothed = smoothed_mean_stress(scene.points);
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        const Point<dim> &x   = scene.points.position(p);
        const bool        low = scene.points.body(p) == 0;
        if (is_inside(x))
          {
            EXPECT_NEAR(smoothed[p],
                        low ? 3 * x[0] - x[1] : 1e6 + x[1],
                        low ? 1e-12 : 1e-8)
              << x;
          }
        EXPECT_GT(smoothed[p], low ? -2. : 1e6) << x;
        EXPECT_LT(smoothed[p], low ? 6. : 1e6 + 2) << x;
      }

    const SmoothedStress<dim> stress(scene.points);
    const auto               &tria = scene.mesh.triangulation();
    for (unsigned int v = 0; v < tria.n_vertices(); ++v)
      {
        const Point<dim> &x    = tria.get_vertices()[v];
        const auto        here = stress.at_vertex(v);
        ASSERT_TRUE(here.has_value());
        for (unsigned int c = 0; c < 3 && is_inside(x) && x[0] < 2; ++c)
          EXPECT_NEAR((*here)[c], 3 * x[0] - x[1] + c - 1., 1e-12) << x;
        // Half of each body there.
        if (std::abs(x[0] - 2) < 1e-9)
          {
            EXPECT_NEAR((*here)[1], 0.5e6, 10) << x;
          }
      }
  }



  TYPED_TEST(Smoothed, what_alternates_between_cells_goes)
  {
    constexpr int          dim = TypeParam::value;
    const FilledCells<dim> scene([](const auto &x, const unsigned int) {
      int sum = 0;
      for (unsigned int d = 0; d < dim; ++d)
        sum += static_cast<int>(std::floor(2 * x[d]));
      return sum % 2 ? 1. : -1.;
    });
    const auto             smoothed = smoothed_mean_stress(scene.points);
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      if (is_inside(scene.points.position(p)))
        {
          EXPECT_NEAR(smoothed[p], 0., 1e-13) << scene.points.position(p);
        }
  }



  TEST(SmoothedStress, no_value_away_from_points)
  {
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    const auto              cell = mesh.triangulation().begin_active();
    if (cell->is_locally_owned())
      points.insert(cell, cell->center(), {0.5, 0.5}, 0, 0, 1.);
    points.finish_insertion();
    const SmoothedStress<2> stress(points);
    const auto             &tria = mesh.triangulation();
    for (unsigned int v = 0; v < tria.n_vertices(); ++v)
      {
        const Point<2> &x = tria.get_vertices()[v];
        EXPECT_EQ(stress.at_vertex(v).has_value(), x[0] < 1.5 && x[1] < 1.5);
      }
    EXPECT_EQ(smoothed_mean_stress(points).size(), points.n_local());
  }
} // namespace moraine
