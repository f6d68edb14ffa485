// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/mesh/cell_shapes.h>
#include <moraine/points/bodies.h>
#include <moraine/geometry/shapes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../core/message.h"

using namespace moraine;
using dealii::Point;
using dealii::Tensor;

namespace
{
  /** Cells that are neither boxes nor parallelepipeds; seen as 3 layers in 3D,
   * bent further so that no face is plane. */
  template <int dim>
  std::unique_ptr<BackgroundMesh<dim>>
  distorted_mesh()
  {
    MeshParameters<dim> parameters;
    parameters.type      = "generator";
    parameters.generator = "concentric_hyper_shells";
    parameters.arguments = "0, 0 : 5 : 10 : 3 : 0 : 12 : true";
    if (dim == 3)
      {
        parameters.extrusion_layers = 3;
        parameters.extrusion_height = 6;
      }
    auto mesh =
      std::make_unique<BackgroundMesh<dim>>(parameters, MPI_COMM_WORLD);
    mesh->move_vertices([](const Point<dim> &x) {
      Point<dim> y = x;
      y[0] += 0.3 * std::sin(x[1]);
      y[1] += 0.2 * std::cos(3 * x[0]);
      if (dim == 3)
        y[2] += 0.2 * std::sin(x[0] + 2 * x[1]);
      return y;
    });
    return mesh;
  }

  template <int dim>
  std::shared_ptr<const Shape<dim>>
  whole_mesh()
  {
    return make_space<dim>();
  }

  /** Sum of v_p and v_p x_p over all ranks. */
  template <int dim>
  std::array<double, dim + 1>
  moments(const PointSet<dim> &points)
  {
    std::vector<double> sums(dim + 1, 0.);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        sums[dim] += points.volume(p);
        for (unsigned int d = 0; d < dim; ++d)
          sums[d] += points.volume(p) * points.position(p)[d];
      }
    dealii::Utilities::MPI::sum(sums, MPI_COMM_WORLD, sums);
    std::array<double, dim + 1> result;
    std::copy(sums.begin(), sums.end(), result.begin());
    return result;
  }

  /** The same by a Gauss rule that is exact. */
  template <int dim>
  std::array<double, dim + 1>
  exact_moments(const BackgroundMesh<dim> &mesh)
  {
    const dealii::FE_Q<dim>     fe(1);
    dealii::FEValues<dim>       values(mesh.mapping(),
                                 fe,
                                 dealii::QGauss<dim>(4),
                                 dealii::update_JxW_values |
                                   dealii::update_quadrature_points);
    std::array<double, dim + 1> sums{};
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      {
        values.reinit(cell);
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          {
            sums[dim] += values.JxW(q);
            for (unsigned int d = 0; d < dim; ++d)
              sums[d] += values.JxW(q) * values.quadrature_point(q)[d];
          }
      }
    return sums;
  }

  template <int dim>
  void
  fill_mesh(const PointLayout layout, const unsigned int n, const double limit)
  {
    const auto    mesh = distorted_mesh<dim>();
    PointSet<dim> points(*mesh, {});
    const auto    volumes = seed_bodies<dim>({{"all", whole_mesh<dim>()}},
                                          CellSeeder<dim>(n, layout),
                                          points);
    const auto    exact   = exact_moments(*mesh);
    EXPECT_EQ(points.n_global(),
              mesh->triangulation().n_global_active_cells() *
                dealii::Utilities::pow(n, dim));
    EXPECT_NEAR(volumes[0] / exact[dim], 1, 1e-13);
    const auto found = moments(points);
    for (unsigned int d = 0; d < dim; ++d)
      EXPECT_NEAR(found[d] / exact[dim], exact[d] / exact[dim], limit);
  }
} // namespace



TEST(SeedAnyMesh, VolumesAndCentroids)
{
  for (const unsigned int n : {1, 2, 3})
    {
      // Points at the middle of a part in the unit cell miss the centroid by
      // second order; that of all cells shows what is left.
      fill_mesh<2>(PointLayout::equal, n, 0.1 / (n * n));
      fill_mesh<3>(PointLayout::equal, n, 0.005 / (n * n));
      if (n > 1)
        {
          fill_mesh<2>(PointLayout::gauss, n, 1e-13);
          fill_mesh<3>(PointLayout::gauss, n, 1e-13);
        }
    }
}



TEST(SeedAnyMesh, GradientsOfCutQuadrilateralsAreIntegrated)
{
  // sum v_p grad N_a(x_p) = int grad N_a dV = boundary integral of N_a n, which
  // summed over all functions weighted with the nodes' x is the area.
  const CellVertices<2> cell{{{0., 0.}, {1., 0.2}, {-0.2, 0.9}, {1.4, 1.5}}};
  const auto            body =
    make_half_space<2>(Point<2>(0.6, 0.5), Tensor<1, 2>({1., 0.4}));
  const auto                  all = make_space<2>();
  std::array<Tensor<1, 2>, 4> reference;
  for (const unsigned int n : {1, 2, 3, 40})
    for (const Shape<2> *shape :
         std::vector<const Shape<2> *>{body.get(), all.get()})
      {
        std::vector<SeededPoint<2>> points;
        CellSeeder<2>(n, PointLayout::equal).seed(cell, *shape, points);
        std::array<Tensor<1, 2>, 4> sums;
        for (const auto &point : points)
          {
            double       N[4];
            Tensor<1, 2> grad_N[4];
            CellShapes<2, 1>::evaluate(CellShapes<2, 1>::inverse(point.position,
                                                                 cell.data()),
                                       cell.data(),
                                       N,
                                       grad_N);
            for (unsigned int a = 0; a < 4; ++a)
              sums[a] += point.volume * grad_N[a];
          }
        if (shape == body.get())
          {
            if (n == 1)
              reference = sums;
            for (unsigned int a = 0; a < 4; ++a)
              EXPECT_LT((sums[a] - reference[a]).norm(), 1e-11);
          }
        else
          // int grad N_0 = half the diagonal turned by 90 degrees
          EXPECT_LT((sums[0] -
                     Tensor<1, 2>({0.5 * (0.2 - 0.9), 0.5 * (-0.2 - 1.)}))
                      .norm(),
                    1e-14);
      }
}



TEST(SeedAnyMesh, BodyMustLieInTheMesh)
{
  MeshParameters<2> parameters;
  parameters.type      = "generator";
  parameters.generator = "hyper_shell";
  parameters.arguments = "0, 0 : 5 : 10 : 18 : true";
  const BackgroundMesh<2> mesh(parameters, MPI_COMM_WORLD);
  const auto              seed = [&](const Point<2> &a, const Point<2> &b) {
    return message_of<InputError>([&] {
      PointSet<2> points(mesh, {});
      seed_bodies<2>({{"block", make_box<2>(a, b)}},
                     CellSeeder<2>(2, PointLayout::equal),
                     points);
    });
  };
  EXPECT_EQ(seed(Point<2>(5.2, -1), Point<2>(8, 1)), "");
  // a quarter of it is in the hole, within the box around the mesh
  EXPECT_NE(
    seed(Point<2>(4., -0.1), Point<2>(8, 0.1)).find("body 'block': found 24.7"),
    std::string::npos)
    << seed(Point<2>(4., -0.1), Point<2>(8, 0.1));
}



TEST(PointsOnMovedMesh, AreFoundInTheRightCells)
{
  const auto  mesh = distorted_mesh<2>();
  PointSet<2> points(*mesh, {});
  const auto  ring = make_box<2>(Point<2>(6., -1.), Point<2>(8., 2.));
  seed_bodies<2>({{"block", ring}},
                 CellSeeder<2>(2, PointLayout::equal),
                 points);
  const auto n      = points.n_global();
  const auto before = moments(points);
  for (unsigned int step = 0; step < 20; ++step)
    {
      mesh->move_vertices([](const Point<2> &x) {
        const double c = std::cos(5 * dealii::numbers::PI / 180);
        const double s = std::sin(5 * dealii::numbers::PI / 180);
        return Point<2>(c * x[0] - s * x[1], s * x[0] + c * x[1]);
      });
      points.find_cells();
      ASSERT_EQ(points.n_global(), n);
      for (const auto &in_cell : points.cells())
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          {
            EXPECT_TRUE(in_cell.cell->is_locally_owned());
            EXPECT_LT(mesh->mapping()
                        .transform_unit_to_real_cell(
                          in_cell.cell, points.reference_position(p))
                        .distance(points.position(p)),
                      1e-10);
            for (unsigned int d = 0; d < 2; ++d)
              {
                EXPECT_GT(points.reference_position(p)[d], -1e-9);
                EXPECT_LT(points.reference_position(p)[d], 1 + 1e-9);
              }
          }
    }
  const auto after = moments(points);
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(after[d], before[d], 1e-11);
}



TEST(PointsOnMovedMesh, APointOutsideIsNamed)
{
  const auto  mesh = distorted_mesh<2>();
  PointSet<2> points(*mesh, {});
  seed_bodies<2>({{"block", make_box<2>(Point<2>(6., -1.), Point<2>(8., 2.))}},
                 CellSeeder<2>(2, PointLayout::equal),
                 points);
  mesh->move_vertices([](const Point<2> &x) { return x * 0.5; });
  EXPECT_NE(message_of<ComputationError>([&] {
              points.find_cells();
            }).find(" left the mesh at ("),
            std::string::npos);
}
