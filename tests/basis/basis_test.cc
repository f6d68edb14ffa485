// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/basis.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

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



  /**
   * Sum N = 1, sum grad N = 0, sum N x_a = x_p and sum x_a (x) grad N = 1 at
   * every point, and every local point occurs once.
   */
  template <int dim>
  void
  check_completeness(const bool gimp)
  {
    SmallScene<dim> scene(gimp);
    prepare(scene);
    std::vector<unsigned int> seen(scene.points.n_local(), 0);
    StencilBlock<dim>         block;
    for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
      {
        scene.basis->evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            ++seen[block.points[p]];
            double         sum = 0;
            Tensor<1, dim> sum_gradient, place;
            Tensor<2, dim> gradient_of_place;
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              {
                const Tensor<1, dim> x =
                  scene.space.node_position(block.nodes[a]);
                sum += block.N(p)[a];
                sum_gradient += block.grad_N(p)[a];
                place += block.N(p)[a] * x;
                gradient_of_place += outer_product(x, block.grad_N(p)[a]);
              }
            EXPECT_NEAR(sum, 1., 1e-14);
            EXPECT_NEAR(sum_gradient.norm(), 0., 1e-13);
            EXPECT_NEAR((place -
                         Tensor<1, dim>(scene.points.position(block.points[p])))
                          .norm(),
                        0.,
                        1e-13);
            EXPECT_NEAR((gradient_of_place -
                         Tensor<2, dim>(unit_symmetric_tensor<dim>()))
                          .norm(),
                        0.,
                        1e-12);
          }
      }
    for (const unsigned int count : seen)
      EXPECT_EQ(count, 1u);
  }



  TEST(Basis, CellBasisIsComplete)
  {
    check_completeness<2>(false);
    check_completeness<3>(false);
  }



  TEST(Basis, GimpIsComplete)
  {
    check_completeness<2>(true);
    check_completeness<3>(true);
  }



  /** The published five-branch function of a node, for l <= h/2, h = 1. */
  double
  gimp_function(const double d, const double l)
  {
    const double s = std::abs(d);
    if (s < l)
      return 1 - (d * d + l * l) / (2 * l);
    if (s < 1 - l)
      return 1 - s;
    if (s < 1 + l)
      return (1 + l - s) * (1 + l - s) / (4 * l);
    return 0;
  }



  TEST(Basis, GimpAgreesWithThePublishedFunctions)
  {
    // Bardenhagen and Kober (2004); half lengths of full points are 1/4.
    SmallScene<2> scene(true);
    prepare(scene);
    StencilBlock<2> block;
    unsigned int    compared = 0;
    for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
      {
        scene.basis->evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          if (std::abs(scene.points.volume(block.points[p]) - 0.25) < 1e-12)
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              {
                const auto d = scene.points.position(block.points[p]) -
                               scene.space.node_position(block.nodes[a]);
                EXPECT_NEAR(block.N(p)[a],
                            gimp_function(d[0], 0.25) *
                              gimp_function(d[1], 0.25),
                            1e-14);
                ++compared;
              }
      }
    EXPECT_GE(Utilities::MPI::sum(compared, MPI_COMM_WORLD), 100u);
  }
} // namespace
