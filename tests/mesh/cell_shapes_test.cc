// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>


namespace
{
  using namespace dealii;

  /** Shape functions and gradients of a bent cell agree with FEValues. */
  template <int dim, int degree>
  void
  compare_with_fe_values()
  {
    Triangulation<dim> triangulation;
    GridGenerator::hyper_cube(triangulation);
    // An off-centre vertex makes the cell neither a box nor affine.
    const auto cell = triangulation.begin_active();
    cell->vertex(cell->n_vertices() - 1)[0] += 0.3;
    cell->vertex(1)[1] += 0.1;

    const FE_Q<dim>      fe(degree);
    const MappingQ1<dim> mapping;
    Point<dim>           xi;
    for (unsigned int d = 0; d < dim; ++d)
      xi[d] = 0.2 + 0.25 * d;
    FEValues<dim>   fe_values(mapping,
                            fe,
                            Quadrature<dim>(xi),
                            update_values | update_gradients |
                              update_quadrature_points);
    DoFHandler<dim> dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);
    fe_values.reinit(dof_handler.begin_active());

    using Shapes                 = moraine::CellShapes<dim, degree>;
    const auto     lexicographic = fe.get_poly_space_numbering_inverse();
    Point<dim>     X[Shapes::n_nodes];
    double         N[Shapes::n_nodes];
    Tensor<1, dim> grad_N[Shapes::n_nodes];
    for (unsigned int a = 0; a < Shapes::n_nodes; ++a)
      X[a] = mapping.transform_unit_to_real_cell(
        cell, fe.unit_support_point(lexicographic[a]));
    Shapes::evaluate(xi, X, N, grad_N);
    for (unsigned int a = 0; a < Shapes::n_nodes; ++a)
      {
        EXPECT_NEAR(N[a], fe_values.shape_value(lexicographic[a], 0), 1e-14);
        EXPECT_NEAR(
          (grad_N[a] - fe_values.shape_grad(lexicographic[a], 0)).norm(),
          0.,
          1e-13);
      }

    const Point<dim> back = Shapes::inverse(fe_values.quadrature_point(0), X);
    EXPECT_NEAR(back.distance(xi), 0., 1e-13);
  }



  TEST(CellShapes, AgreeWithFEValues)
  {
    compare_with_fe_values<2, 1>();
    compare_with_fe_values<2, 2>();
    compare_with_fe_values<3, 1>();
    compare_with_fe_values<3, 2>();
  }



  TEST(CellShapes, InverseWorksOutsideOfTheCell)
  {
    const Point<2> X[4] = {{0, 0}, {2, 0}, {0, 2}, {2.2, 2.1}};
    const Point<2> xi(1.2, -0.1);
    double         N[4];
    moraine::CellShapes<2, 1>::values(xi, N);
    Point<2> x;
    for (unsigned int a = 0; a < 4; ++a)
      x += N[a] * X[a];
    EXPECT_NEAR((moraine::CellShapes<2, 1>::inverse(x, X).distance(xi)),
                0.,
                1e-13);
  }
} // namespace
