// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_cell_map_h
#define moraine_mesh_cell_map_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace moraine
{
  /** The vertices of one cell in deal.II's lexicographic order. */
  template <int dim>
  using CellVertices = std::array<dealii::Point<dim>, (1 << dim)>;

  /** The multilinear map to a cell from the unit box; keeps a reference to it.
   */
  template <int dim>
  class CellMap
  {
  public:
    explicit CellMap(const CellVertices<dim> &cell)
      : cell(cell)
    {}

    dealii::Point<dim>
    place(const dealii::Point<dim> &xi) const
    {
      dealii::Point<dim> x;
      for (unsigned int v = 0; v < cell.size(); ++v)
        x += factor(v, xi, dim) * cell[v];
      return x;
    }

    /** J_kd = ∂x_k/∂ξ_d */
    dealii::Tensor<2, dim>
    jacobian(const dealii::Point<dim> &xi) const
    {
      dealii::Tensor<2, dim> J;
      for (unsigned int v = 0; v < cell.size(); ++v)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double f = factor(v, xi, d);
            for (unsigned int k = 0; k < dim; ++k)
              J[k][d] += f * cell[v][k];
          }
      return J;
    }

  private:
    /** Shape function of vertex v, differentiated in ξ_d (dim: not). */
    double
    factor(const unsigned int        v,
           const dealii::Point<dim> &xi,
           const unsigned int        d) const
    {
      double f = 1.;
      for (unsigned int i = 0; i < dim; ++i)
        {
          const bool upper = (v >> i) & 1u;
          if (i == d)
            f *= upper ? 1. : -1.;
          else
            f *= upper ? xi[i] : 1. - xi[i];
        }
      return f;
    }

    const CellVertices<dim> &cell;
  };
} // namespace moraine

#endif
