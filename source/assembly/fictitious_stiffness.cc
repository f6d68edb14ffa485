// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/fictitious_stiffness.h>
#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <array>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * Volume of a cell around a place over that of the unit cell, from the
     * gradients there: @f$\det^{-1} \sum_a \xi_a \otimes \nabla N_a@f$.
     */
    template <int dim, int degree>
    double
    volume_ratio(const Tensor<1, dim> *grad_N)
    {
      Tensor<2, dim> inverse_J;
      for (unsigned int a = 0; a < CellShapes<dim, degree>::n_nodes; ++a)
        {
          unsigned int rest = a;
          for (unsigned int d = 0; d < dim; ++d, rest /= degree + 1)
            inverse_J[d] += rest % (degree + 1) / double(degree) * grad_N[a];
        }
      return 1 / determinant(inverse_J);
    }



    /** Add that of a volume @p v with the gradients. */
    template <int dim, std::size_t n_nodes>
    void
    add_stiffness(const double                               v,
                  const LameConstants                       &C,
                  const std::array<Tensor<1, dim>, n_nodes> &grad_N,
                  FullMatrix<double>                        &matrix)
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              matrix(dim * a + i, dim * b + j) +=
                v * (C.lambda * grad_N[a][i] * grad_N[b][j] +
                     C.mu * grad_N[a][j] * grad_N[b][i] +
                     (i == j ? C.mu * (grad_N[a] * grad_N[b]) : 0.));
    }
  } // namespace



  template <int dim>
  FictitiousStiffness<dim>::FictitiousStiffness(const double fraction)
    : fraction(fraction)
  {}



  template <int dim>
  std::vector<Effect>
  FictitiousStiffness<dim>::effects(const StepContext<dim> &) const
  {
    if (fraction == 0)
      return {};
    std::ostringstream text;
    text << "of empty parts of cells, " << fraction << " of the material's";
    return {{"stiffness of empty parts", "stiffness", text.str()}};
  }



  template <int dim>
  bool
  FictitiousStiffness<dim>::begin_step(const StepContext<dim> &context)
  {
    const GridSpace<dim> &space  = context.state.grid();
    const PointSet<dim>  &points = context.state.material_points();
    const auto           &tria   = space.mesh().triangulation();
    // Where cells go with their points, the part is that of the start.
    const bool at_start =
      context.state.mesh_after_step() != MeshAfterStep::reset;
    std::vector<double> filled(tria.n_active_cells(), 0.);
    for (const auto &in_cell : points.cells())
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        filled[in_cell.cell->active_cell_index()] +=
          at_start ? context.state.initial_volume(p) : points.volume(p);
    empty_cells.clear();
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned() && space.is_active(cell))
        {
          const double empty =
            1 - filled[cell->active_cell_index()] / volume_of_cell(cell);
          // Round-off in a full cell is not a part of it.
          if (empty > 1e-12)
            empty_cells.emplace_back(cell, empty);
        }
    return false;
  }



  template <int dim>
  bool
  FictitiousStiffness<dim>::any_empty_part(
    const StepContext<dim> &context) const
  {
    return Utilities::MPI::logical_or(!empty_cells.empty(),
                                      context.state.grid().communicator());
  }



  template <int dim>
  void
  FictitiousStiffness<dim>::add(const StepContext<dim> &context,
                                const bool              tangent,
                                GlobalSystem<dim>      &system) const
  {
    if (context.state.grid().degree() == 1)
      add_cells<1>(context, tangent, system);
    else
      add_cells<2>(context, tangent, system);
  }



  template <int dim>
  template <int degree>
  void
  FictitiousStiffness<dim>::add_cells(const StepContext<dim> &context,
                                      const bool              tangent,
                                      GlobalSystem<dim>      &system) const
  {
    using Shapes                                = CellShapes<dim, degree>;
    constexpr unsigned int              n_nodes = Shapes::n_nodes;
    const GridSpace<dim>               &space   = context.state.grid();
    const QGauss<dim>                   quadrature(degree + 1);
    std::array<Point<dim>, n_nodes>     X;
    std::array<double, n_nodes>         N;
    std::array<Tensor<1, dim>, n_nodes> grad_N;
    LocalSystem<dim>                    local;
    for (const auto &[cell, empty] : empty_cells)
      {
        local.reinit(context.state, space.cell_nodes(cell), n_nodes, true);
        for (unsigned int a = 0; a < n_nodes; ++a)
          X[a] = space.node_position(local.nodes[a]);
        const LameConstants C =
          context.cell_materials.elastic_stiffness(cell->active_cell_index());
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            Shapes::evaluate(quadrature.point(q),
                             X.data(),
                             N.data(),
                             grad_N.data());
            const double JxW =
              volume_ratio<dim, degree>(grad_N.data()) * quadrature.weight(q);
            add_stiffness(fraction * empty * JxW, C, grad_N, local.matrix);
          }
        for (unsigned int r = 0; r < dim * n_nodes; ++r)
          for (unsigned int b = 0; b < n_nodes; ++b)
            for (unsigned int j = 0; j < dim; ++j)
              local.force[r] -=
                local.matrix(r, dim * b + j) * local.nodal_increments[b][j];
        system.add(local, tangent);
      }
  }



  template class FictitiousStiffness<2>;
  template class FictitiousStiffness<3>;
} // namespace moraine
