// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_tests_solver_elasticity_h
#define moraine_tests_solver_elasticity_h

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/distributed/shared_tria.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <deal.II/numerics/vector_tools.h>

#include <moraine/core/linear_algebra.h>

#include <vector>

namespace moraine::testing_solver
{
  /**
   * A linear elastic cube of n^dim bilinear cells under its weight, held at
   * x = 0 (or not at all); inertia is the factor of its mass of density one.
   * With Poisson's ratio above 0.3 its volumetric strain is the cells' mean.
   */
  template <int dim>
  struct Elasticity
  {
    dealii::parallel::shared::Triangulation<dim> triangulation;
    const dealii::FESystem<dim>                  fe;
    dealii::DoFHandler<dim>                      dof_handler;
    dealii::AffineConstraints<double>            constraints;
    const std::shared_ptr<LA::SparseMatrix>      matrix =
      std::make_shared<LA::SparseMatrix>();
    LA::Vector              rhs;
    std::vector<LA::Vector> modes;

    Elasticity(const unsigned int n,
               const bool         held       = true,
               const double       convection = 0.,
               const double       inertia    = 0.,
               const double       poisson    = 0.3);

  private:
    void
    assemble(const double convection,
             const double inertia,
             const double poisson);

    void
    make_modes();
  };



  template <int dim>
  Elasticity<dim>::Elasticity(const unsigned int n,
                              const bool         held,
                              const double       convection,
                              const double       inertia,
                              const double       poisson)
    : triangulation(
        MPI_COMM_WORLD,
        dealii::Triangulation<dim>::none,
        false,
        dealii::parallel::shared::Triangulation<dim>::partition_zorder)
    , fe(dealii::FE_Q<dim>(1), dim)
    , dof_handler(triangulation)
  {
    dealii::GridGenerator::subdivided_hyper_cube(triangulation, n);
    dof_handler.distribute_dofs(fe);
    if (held)
      for (const auto &cell : dof_handler.active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          if (cell->vertex(v)[0] == 0.)
            for (unsigned int c = 0; c < dim; ++c)
              constraints.add_line(cell->vertex_dof_index(v, c));
    constraints.close();

    const auto                    &owned = dof_handler.locally_owned_dofs();
    dealii::DynamicSparsityPattern pattern(dof_handler.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(
      dof_handler,
      pattern,
      constraints,
      false,
      triangulation.locally_owned_subdomain());
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    dealii::SparsityTools::distribute_sparsity_pattern(pattern,
                                                       owned,
                                                       MPI_COMM_WORLD,
                                                       relevant);
    matrix->reinit(owned, owned, pattern, MPI_COMM_WORLD);
    rhs.reinit(owned, MPI_COMM_WORLD);
    assemble(convection, inertia, poisson);
    make_modes();
  }



  template <int dim>
  void
  Elasticity<dim>::assemble(const double convection,
                            const double inertia,
                            const double poisson)
  {
    using namespace dealii;
    const QGauss<dim>                    quadrature(2);
    FEValues<dim>                        values(fe,
                         quadrature,
                         update_values | update_gradients | update_JxW_values);
    const unsigned int                   n = fe.n_dofs_per_cell();
    FullMatrix<double>                   local(n, n);
    Vector<double>                       load(n);
    std::vector<types::global_dof_index> dofs(n);
    std::vector<Tensor<1, dim>>          means(n);
    const double                         mu = 0.5 / (1 + poisson);
    const double lambda = 2 * mu * poisson / (1 - 2 * poisson);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          local = 0.;
          load  = 0.;
          for (unsigned int i = 0; i < n; ++i)
            {
              means[i] = 0;
              for (const unsigned int q : values.quadrature_point_indices())
                means[i] += values.shape_grad(i, q) * values.JxW(q);
              means[i] /= cell->measure();
            }
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int i = 0; i < n; ++i)
              {
                const unsigned int ci = fe.system_to_component_index(i).first;
                const auto        &gi = values.shape_grad(i, q);
                const double       weight = values.JxW(q);
                if (ci == dim - 1)
                  load(i) -= values.shape_value(i, q) * weight;
                for (unsigned int j = 0; j < n; ++j)
                  {
                    const unsigned int cj =
                      fe.system_to_component_index(j).first;
                    const auto &gj = values.shape_grad(j, q);
                    const auto &di = poisson > 0.3 ? means[i] : gi;
                    const auto &dj = poisson > 0.3 ? means[j] : gj;
                    double k = lambda * di[ci] * dj[cj] + mu * gi[cj] * gj[ci];
                    if (ci == cj)
                      k += mu * (gi * gj) +
                           convection * values.shape_value(i, q) * gj[0] +
                           inertia * values.shape_value(i, q) *
                             values.shape_value(j, q);
                    local(i, j) += k * weight;
                  }
              }
          cell->get_dof_indices(dofs);
          constraints.distribute_local_to_global(
            local, load, dofs, *matrix, rhs);
        }
    matrix->compress(VectorOperation::add);
    rhs.compress(VectorOperation::add);
  }



  template <int dim>
  void
  Elasticity<dim>::make_modes()
  {
    using namespace dealii;
    constexpr unsigned int n_modes = dim == 2 ? 3 : 6;
    modes.assign(n_modes,
                 LA::Vector(dof_handler.locally_owned_dofs(), MPI_COMM_WORLD));
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto i = cell->vertex_dof_index(v, c);
            if (!modes[0].in_local_range(i) || constraints.is_constrained(i))
              continue;
            modes[c](i)        = 1.;
            const Point<dim> p = cell->vertex(v);
            // About axis a, component b gets -x_c and component c gets x_b.
            for (unsigned int a = 0; a < n_modes - dim; ++a)
              {
                const unsigned int b  = dim == 2 ? 0 : (a + 1) % 3;
                const unsigned int cc = dim == 2 ? 1 : (a + 2) % 3;
                if (c == b)
                  modes[dim + a](i) = -p[cc];
                if (c == cc)
                  modes[dim + a](i) = p[b];
              }
          }
    for (auto &mode : modes)
      mode.compress(VectorOperation::insert);
  }
} // namespace moraine::testing_solver

#endif
