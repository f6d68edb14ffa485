// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Volumes of points fitted to the cells that they have moved to.

#include <moraine/state/fitted_weights.h>

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <optional>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  /** The scene's points after a shift, in cells that are no parallelograms. */
  template <int dim>
  struct ShiftedScene : SmallScene<dim>
  {
    ShiftedScene(const unsigned int n, const double shift)
      : SmallScene<dim>(false, n)
    {
      this->mesh.move_vertices([](const Point<dim> &X) {
        Point<dim> x = X;
        x[0] += 0.005 * X[0] * (4 - X[0]) * X[1];
        return x;
      });
      this->points.find_cells();
      fitted.emplace(this->points);
      Tensor<1, dim> u;
      for (unsigned int d = 0; d < dim; ++d)
        u[d] = (d + 1) * shift;
      for (unsigned int p = 0; p < this->points.n_local(); ++p)
        this->points.set_position(p, this->points.position(p) + u);
      this->points.find_cells();
      activate({});
    }

    std::vector<double>
    factors() const
    {
      return fitted->factors(this->space, this->points);
    }

    void
    activate(const std::vector<unsigned int> &but)
    {
      std::vector<unsigned char> active(
        this->mesh.triangulation().n_active_cells(), 1);
      for (const unsigned int cell : but)
        active[cell] = 0;
      this->space.set_active_cells(active);
    }

    /** Σ f v (1, ξ - middle) less ∫ (1, ξ - middle) dV of a cell. */
    Vector<double>
    misfit(const typename PointSet<dim>::CellPoints &in_cell,
           const std::vector<double>                &factors) const
    {
      Vector<double> sum(dim + 1);
      const auto     add = [&sum](const double w, const Point<dim> &xi) {
        sum[0] += w;
        for (unsigned int d = 0; d < dim; ++d)
          sum[d + 1] += w * (xi[d] - 0.5);
      };
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        add(factors[p] * this->points.volume(p),
            this->points.reference_position(p));
      const auto         corners = vertices_of<dim>(in_cell.cell);
      const CellMap<dim> map(corners);
      const QGauss<dim>  rule(3);
      for (unsigned int q = 0; q < rule.size(); ++q)
        add(-rule.weight(q) * determinant(map.jacobian(rule.point(q))),
            rule.point(q));
      return sum;
    }

    std::optional<FittedWeights<dim>> fitted;
  };

  template <int dim>
  bool
  at_edge_of_mesh(const typename PointSet<dim>::CellPoints &in_cell)
  {
    return in_cell.cell->at_boundary();
  }

  template <int dim>
  void
  expect_linear_exactness()
  {
    const ShiftedScene<dim>   scene(3, 0.03);
    const std::vector<double> factors = scene.factors();
    for (const auto &in_cell : scene.points.cells())
      if (!at_edge_of_mesh<dim>(in_cell))
        {
          EXPECT_LT(scene.misfit(in_cell, factors).linfty_norm(), 1e-13);
          EXPECT_GT(scene
                      .misfit(in_cell, std::vector<double>(factors.size(), 1.))
                      .linfty_norm(),
                    1e-2);
        }
      else // where the body is not the whole cell
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          EXPECT_EQ(factors[p], 1.);
  }
} // namespace



TEST(FittedWeights, IntegrateLinearFunctionsExactly)
{
  expect_linear_exactness<2>();
  expect_linear_exactness<3>();
}



TEST(FittedWeights, AreNeverNegative)
{
  // The one row that is left in a cell cannot stand for both.
  for (const double shift : {0.24, 0.3, 0.4})
    {
      const ShiftedScene<2> scene(2, shift);
      const auto            factors = scene.factors();
      for (const double f : factors)
        EXPECT_GT(f, 0.);
      for (const auto &in_cell : scene.points.cells())
        if (!at_edge_of_mesh<2>(in_cell))
          {
            EXPECT_LT(std::abs(scene.misfit(in_cell, factors)[0]), 1e-13);
          }
    }
}



TEST(FittedWeights, OnePointTakesTheVolumeOfItsCell)
{
  const ShiftedScene<2> scene(1, 0.1);
  const auto            factors = scene.factors();
  for (const auto &in_cell : scene.points.cells())
    if (!at_edge_of_mesh<2>(in_cell))
      {
        EXPECT_NEAR(factors[in_cell.first] * scene.points.volume(in_cell.first),
                    in_cell.cell->measure(),
                    1e-13);
      }
}



TEST(FittedWeights, BesideEmptyCellsAreOne)
{
  ShiftedScene<2> scene(2, 0.05);
  for (const auto &cell : scene.mesh.triangulation().active_cell_iterators())
    if (cell->vertex_index(0) == 0)
      scene.activate({cell->active_cell_index()});
  const auto factors = scene.factors();
  for (const auto &in_cell : scene.points.cells())
    {
      const bool beside = in_cell.cell->vertex(0).norm() < 1.5;
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        if (beside || at_edge_of_mesh<2>(in_cell))
          EXPECT_EQ(factors[p], 1.);
        else
          EXPECT_NE(factors[p], 1.);
    }
}



TEST(FittedWeights, OfTwoBodiesOrHalfACellAreOne)
{
  ShiftedScene<2> scene(2, 0.05);
  const auto      body   = scene.points.fields().find(FieldNames<2>::body);
  unsigned int    inside = 0;
  for (const auto &in_cell : scene.points.cells())
    if (!at_edge_of_mesh<2>(in_cell) && inside++ < 2)
      {
        if (inside == 1)
          body.store(1, scene.points.values(in_cell.first));
        else
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            scene.points.set_volume(p, 0.45 * scene.points.volume(p));
      }
  const auto factors = scene.factors();
  inside             = 0;
  for (const auto &in_cell : scene.points.cells())
    if (!at_edge_of_mesh<2>(in_cell))
      {
        ++inside;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          if (inside <= 2)
            EXPECT_EQ(factors[p], 1.);
          else
            EXPECT_NE(factors[p], 1.);
      }
}
