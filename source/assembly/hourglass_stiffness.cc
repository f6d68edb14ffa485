// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/hourglass_stiffness.h>
#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>

#include <array>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the shear modulus. */
    constexpr double part_of_stiffness = 1e-5;



    /** What 2 Gauss points per direction do not see of the gradients in a cell
     * of degree 2, at the points of a full rule. */
    template <int dim>
    class UnseenGradients
    {
    public:
      using Shapes                          = CellShapes<dim, 2>;
      static constexpr unsigned int n_nodes = Shapes::n_nodes;

      UnseenGradients()
        : full(3)
        , reduced(2)
        , gradients(full.size())
        , JxW(full.size())
        , at_reduced(reduced.size())
      {
        // Linear functions that are 1 at one point of the reduced rule.
        for (unsigned int q = 0; q < full.size(); ++q)
          for (unsigned int k = 0; k < reduced.size(); ++k)
            {
              double value = 1;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double x_k = reduced.point(k)[d];
                  value *= (full.point(q)[d] - (1 - x_k)) / (2 * x_k - 1);
                }
              interpolation.push_back(value);
            }
      }

      /** In a cell with nodes @p X. */
      void
      reinit(const std::array<Point<dim>, n_nodes> &X)
      {
        std::array<double, n_nodes> N;
        for (unsigned int k = 0; k < reduced.size(); ++k)
          Shapes::evaluate(reduced.point(k),
                           X.data(),
                           N.data(),
                           at_reduced[k].data());
        for (unsigned int q = 0; q < full.size(); ++q)
          {
            Shapes::evaluate(full.point(q),
                             X.data(),
                             N.data(),
                             gradients[q].data());
            JxW[q] = full.weight(q) *
                     determinant(Shapes::jacobian(full.point(q), X.data()));
            for (unsigned int k = 0; k < reduced.size(); ++k)
              for (unsigned int a = 0; a < n_nodes; ++a)
                gradients[q][a] -=
                  interpolation[q * reduced.size() + k] * at_reduced[k][a];
          }
      }

      /** Their products, integrated over the cell, for pairs of nodes. */
      void
      products(std::vector<double> &of_nodes) const
      {
        of_nodes.assign(n_nodes * n_nodes, 0.);
        for (unsigned int q = 0; q < full.size(); ++q)
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              const Tensor<1, dim> g = JxW[q] * gradients[q][a];
              for (unsigned int b = 0; b < n_nodes; ++b)
                of_nodes[a * n_nodes + b] += g * gradients[q][b];
            }
      }

    private:
      using Gradients = std::array<Tensor<1, dim>, n_nodes>;

      const QGauss<dim>      full, reduced;
      std::vector<Gradients> gradients;
      std::vector<double>    JxW;
      std::vector<Gradients> at_reduced;
      std::vector<double>    interpolation; ///< reduced fastest
    };
  } // namespace



  template <int dim>
  void
  HourglassStiffness<dim>::add(const StepContext<dim> &context,
                               const bool              tangent,
                               GlobalSystem<dim>      &system) const
  {
    constexpr unsigned int          n_nodes = UnseenGradients<dim>::n_nodes;
    const GridSpace<dim>           &space   = context.state.grid();
    UnseenGradients<dim>            unseen;
    std::vector<double>             of_nodes;
    std::array<Point<dim>, n_nodes> X;
    LocalSystem<dim>                local;
    for (const auto &in_cell : context.state.material_points().cells())
      {
        const auto &cell = in_cell.cell;
        local.reinit(context.state, space.cell_nodes(cell), n_nodes, true);
        for (unsigned int a = 0; a < n_nodes; ++a)
          X[a] = space.node_position(local.nodes[a]);
        unseen.reinit(X);
        unseen.products(of_nodes);
        const double mu =
          context.cell_materials.elastic_stiffness(cell->active_cell_index())
            .mu;
        local.add_in_all_directions(part_of_stiffness * mu, of_nodes);
        for (unsigned int r = 0; r < dim * n_nodes; ++r)
          for (unsigned int b = 0; b < n_nodes; ++b)
            for (unsigned int j = 0; j < dim; ++j)
              local.force[r] -=
                local.matrix(r, dim * b + j) * local.nodal_increments[b][j];
        system.add(local, tangent);
      }
  }



  template class HourglassStiffness<2>;
  template class HourglassStiffness<3>;
} // namespace moraine
