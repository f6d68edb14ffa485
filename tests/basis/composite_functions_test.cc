// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/composite_functions.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "../small_scene.h"

namespace composite_functions_test
{
  using namespace dealii;
  using namespace moraine;

  void
  expect_line(const double               xi,
              const bool                 below,
              const bool                 above,
              const std::vector<double> &N_wanted,
              const std::vector<double> &dN_wanted)
  {
    double N[4], dN[4];
    ASSERT_EQ(composite_functions(xi, below, above, N, dN), dN_wanted.size());
    for (unsigned int a = 0; a < N_wanted.size(); ++a)
      EXPECT_NEAR(N[a], N_wanted[a], 1e-15) << xi << " node " << a;
    for (unsigned int a = 0; a < dN_wanted.size(); ++a)
      EXPECT_NEAR(dN[a], dN_wanted[a], 1e-15) << xi << " node " << a;
  }



  TEST(CompositeFunctions, HaveTheValuesOfTheirClosedForms)
  {
    expect_line(0,
                true,
                true,
                {-1. / 16, 9. / 16, 9. / 16, -1. / 16},
                {1. / 48, -27. / 48, 27. / 48, -1. / 48});
    expect_line(
      1, true, true, {0, 0, 1, 0}, {1. / 12, -1. / 2, 1. / 4, 1. / 6});
    expect_line(
      -1, true, true, {0, 1, 0, 0}, {-1. / 6, -1. / 4, 1. / 2, -1. / 12});
    expect_line(-1, false, true, {1, 0, 0}, {-3. / 4, 1, -1. / 4});
    expect_line(1, true, false, {0, 0, 1}, {1. / 4, -1, 3. / 4});
    expect_line(0.5, false, false, {0.25, 0.75}, {-0.5, 0.5});
  }



  /** Batch the points of a scene where they are now. */
  template <int dim>
  void
  prepare(SmallScene<dim> &scene)
  {
    std::vector<unsigned char> active(
      scene.mesh.triangulation().n_active_cells(), 0);
    scene.basis->mark_cells(active);
    scene.space.set_active_cells(std::move(active));
    scene.basis->batch_points();
  }



  /** A polynomial with a derivative: cubic in the cells 1 and 2 of 4, which
   * have two neighbours, quadratic in those at the edge. */
  std::array<double, 2>
  polynomial(const double x, const unsigned int cell)
  {
    const double c = cell == 1 || cell == 2 ? 0.1 : 0.;
    return {{1 - 0.5 * x + 0.3 * x * x + c * x * x * x,
             -0.5 + 0.6 * x + 3 * c * x * x}};
  }



  template <int dim>
  void
  check_reproduction()
  {
    SmallScene<dim> scene;
    prepare(scene);
    CompositeBasis<dim> composite(scene.space, scene.points);
    EXPECT_FALSE(composite.batch_points());
    StencilBlock<dim> block;
    unsigned int      n_points = 0, n_interior = 0;
    for (unsigned int g = 0; g < composite.n_batches(); ++g)
      {
        composite.evaluate(g, block);
        n_interior += block.n_nodes == Utilities::pow(4u, dim);
        for (unsigned int p = 0; p < block.n_points; ++p, ++n_points)
          {
            const Point<dim> &x     = scene.points.position(block.points[p]);
            const auto        cell  = place_in(*scene.mesh.box_grid(), x);
            double            value = 0, exact = 1;
            Tensor<1, dim>    gradient, exact_gradient;
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              {
                double of_node = 1;
                for (unsigned int d = 0; d < dim; ++d)
                  of_node *=
                    polynomial(scene.space.node_position(block.nodes[a])[d],
                               cell[d])[0];
                value += block.N(p)[a] * of_node;
                gradient += block.grad_N(p)[a] * of_node;
              }
            for (unsigned int d = 0; d < dim; ++d)
              {
                exact *= polynomial(x[d], cell[d])[0];
                exact_gradient[d] = 1;
                for (unsigned int e = 0; e < dim; ++e)
                  exact_gradient[d] *= polynomial(x[e], cell[e])[e == d];
              }
            EXPECT_NEAR(value, exact, 1e-12 * std::abs(exact) + 1e-12);
            EXPECT_LT((gradient - exact_gradient).norm(), 1e-10);
          }
      }
    EXPECT_EQ(Utilities::MPI::sum(n_interior, MPI_COMM_WORLD),
              Utilities::pow(2, dim));
    EXPECT_EQ(n_points, scene.points.n_local());
  }



  TEST(CompositeBasis, ReproducesCubicsInsideAndQuadraticsAtTheEdge)
  {
    check_reproduction<2>();
    check_reproduction<3>();
  }



  TEST(CompositeBasis, TakesNoNodeOfACellWithoutPoints)
  {
    // The cells (0, 0), (1, 0) and (0, 1) have points, (1, 1) has none.
    PointFields         layout;
    BackgroundMesh<2>   mesh(unit_cells<2>(3), MPI_COMM_WORLD);
    GridSpace<2>        space(mesh, 1);
    PointSet<2>         points(mesh, layout);
    const CellSeeder<2> seeder(2, PointLayout::equal);
    seed_bodies({{"below", make_box<2>(Point<2>(0, 0), Point<2>(2, 1))},
                 {"above", make_box<2>(Point<2>(0, 1), Point<2>(1, 2))}},
                seeder,
                points);
    WithCompositeStrain<2, CellBasis<2, 1>> basis(space, points);
    std::vector<unsigned char>              active(9, 0);
    basis.mark_cells(active);
    space.set_active_cells(std::move(active));
    basis.batch_points();
    const Basis<2> &composite = basis.strain_basis();
    StencilBlock<2> block;
    unsigned int    n_cells = 0;
    for (unsigned int g = 0; g < composite.n_batches(); ++g, ++n_cells)
      {
        composite.evaluate(g, block);
        const auto cell =
          place_in(*mesh.box_grid(), points.position(block.points[0]));
        EXPECT_EQ(block.n_nodes, cell[0] + cell[1] == 0 ? 4u : 6u);
      }
    EXPECT_EQ(Utilities::MPI::sum(n_cells, MPI_COMM_WORLD), 3u);
  }



  /** The local functions of all points, summed by node, are the functions of
   * the basis. */
  template <int dim>
  void
  check_local_functions(const bool gimp)
  {
    SmallScene<dim> scene(gimp);
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        Point<dim> x = scene.points.position(p);
        x[0] += 0.17;
        x[dim - 1] -= 0.12;
        scene.points.set_position(p, x);
      }
    scene.points.find_cells();
    prepare(scene);
    const LocalFunctions<dim> local(scene.space, scene.points);
    const CellNeighbours<dim> neighbours(scene.mesh);
    StencilBlock<dim>         block;
    std::vector<double>       sums(scene.space.n_nodes());
    unsigned int              n_cut = 0;
    for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
      {
        scene.basis->evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            std::fill(sums.begin(), sums.end(), 0.);
            const unsigned int point  = block.points[p];
            const auto         place  = place_in(*scene.mesh.box_grid(),
                                        scene.points.cell_of(point)->center());
            const auto         window = local.cells(place, point);
            n_cut += window.n_cells() > 1;
            window.for_each_cell([&](const auto &ijk) {
              const auto          S = local.values(ijk, point);
              const unsigned int *nodes =
                scene.space.cell_nodes(neighbours.box_cell(ijk));
              for (unsigned int a = 0; a < 1 << dim; ++a)
                {
                  double product = 1;
                  for (unsigned int d = 0; d < dim; ++d)
                    product *= S[d][(a >> d) & 1];
                  sums[nodes[a]] += product;
                }
            });
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              EXPECT_NEAR(sums[block.nodes[a]], block.N(p)[a], 1e-14);
          }
      }
    EXPECT_EQ(Utilities::MPI::sum(n_cut, MPI_COMM_WORLD) > 0, gimp);
  }



  TEST(LocalFunctions, SumUpToTheFunctionsOfPoints)
  {
    for (const bool gimp : {false, true})
      {
        check_local_functions<2>(gimp);
        check_local_functions<3>(gimp);
      }
  }



  TEST(LocalFunctions, AreTheIntegralsOverThePartInTheCell)
  {
    // [0.875, 1.375]: 3/4 of it are in the second cell, centred at 0.1875.
    const LineOfBox line(1.125, 0.25, 3);
    EXPECT_NEAR(line.hats(1)[1], 0.75 * 0.1875, 1e-16);
    EXPECT_NEAR(line.hats(1)[0], 0.75 * 0.8125, 1e-16);
    for (const double beyond : line.hats(2))
      EXPECT_EQ(beyond, 0.);
  }
} // namespace composite_functions_test
