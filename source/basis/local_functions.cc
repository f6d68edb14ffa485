// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/local_functions.h>

#include <moraine/basis/gimp_basis.h>
#include <moraine/core/object_error.h>

#include <limits>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  CellWindow<dim>
  cells_of_box(const BoxGrid<dim> &grid, const Point<dim> &x, const double *l)
  {
    // A cell touched with next to no overlap must not become active: its far
    // nodes would get no stiffness.
    static const double shrink =
      1 - std::sqrt(std::numeric_limits<double>::epsilon());
    CellWindow<dim> window;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double position =
          (x[d] - grid.lower_corner[d]) / grid.cell_size[d];
        const double half      = shrink * l[d] / grid.cell_size[d];
        const double last_cell = grid.n_cells[d] - 1;
        window.first[d] =
          std::clamp(std::floor(position - half), 0., last_cell);
        window.last[d] = std::clamp(std::floor(position + half), 0., last_cell);
      }
    return window;
  }



  template <int dim>
  void
  append_nodes(const CellWindow<dim>     &window,
               const CellNeighbours<dim> &neighbours,
               const GridSpace<dim>      &space,
               std::vector<unsigned int> &nodes)
  {
    std::array<unsigned int, 3> n_nodes{{1, 1, 1}};
    for (unsigned int d = 0; d < dim; ++d)
      n_nodes[d] = window.last[d] - window.first[d] + 2;
    for (unsigned int k = 0; k < n_nodes[2]; ++k)
      for (unsigned int j = 0; j < n_nodes[1]; ++j)
        for (unsigned int i = 0; i < n_nodes[0]; ++i)
          {
            // Any cell of the window with that node will do.
            const std::array<unsigned int, 3> node{{i, j, k}};
            std::array<unsigned int, dim>     cell;
            unsigned int                      corner = 0;
            for (unsigned int d = 0; d < dim; ++d)
              {
                cell[d] = std::min(window.first[d] + node[d], window.last[d]);
                corner += (window.first[d] + node[d] - cell[d]) << d;
              }
            nodes.push_back(
              space.cell_nodes(neighbours.box_cell(cell))[corner]);
          }
  }



  template <int dim>
  void
  multiply(const LineFunctions &f, double *values, Tensor<1, dim> *gradients)
  {
    const auto &[n, S, dS] = f;
    unsigned int a         = 0;
    for (unsigned int k = 0; k < n[2]; ++k)
      {
        const double along_z = dim == 3 ? S[2][k] : 1.;
        for (unsigned int j = 0; j < n[1]; ++j)
          for (unsigned int i = 0; i < n[0]; ++i, ++a)
            {
              values[a]       = S[0][i] * S[1][j] * along_z;
              gradients[a][0] = dS[0][i] * S[1][j] * along_z;
              gradients[a][1] = S[0][i] * dS[1][j] * along_z;
              if constexpr (dim == 3)
                gradients[a][2] = S[0][i] * S[1][j] * dS[2][k];
            }
      }
  }



  template <int dim>
  void
  require_box_mesh(const GridSpace<dim> &space, const std::string &method)
  {
    if (!space.mesh().box_grid() || space.degree() != 1)
      throw ObjectError("method",
                        method,
                        "found '" + method +
                          "' on a mesh or with shape functions it cannot use, "
                          "allowed: a box of equal cells with degree 1, which "
                          "'Mesh motion' may stretch along its axes, not turn");
  }



  template <int dim>
  LocalFunctions<dim>::LocalFunctions(const GridSpace<dim> &space,
                                      const PointSet<dim>  &points)
    : space(space)
    , points(points)
    , half_length(points.fields().find(GimpBasis<dim>::half_length_name))
  {}



  template <int dim>
  CellWindow<dim>
  LocalFunctions<dim>::cells(const std::array<unsigned int, dim> &place,
                             const unsigned int                   point) const
  {
    if (!half_length.exists())
      return {place, place};
    return cells_of_box(grid(),
                        points.position(point),
                        points.values(point) + half_length.offset());
  }



  template <int dim>
  std::array<std::array<double, 2>, dim>
  LocalFunctions<dim>::values(const std::array<unsigned int, dim> &cell,
                              const unsigned int                   point) const
  {
    std::array<std::array<double, 2>, dim> S;
    const Point<dim>                      &x  = points.position(point);
    const BoxGrid<dim>                    &of = grid();
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double h     = of.cell_size[d];
        const double xi    = (x[d] - of.lower_corner[d]) / h;
        const double right = std::clamp(xi - cell[d], 0., 1.);
        if (half_length.exists())
          S[d] = LineOfBox(xi,
                           points.values(point)[half_length.offset() + d] / h,
                           of.n_cells[d])
                   .hats(cell[d]);
        else
          S[d] = {{1 - right, right}};
      }
    return S;
  }



#define INSTANTIATE(dim)                                      \
  template class LocalFunctions<dim>;                         \
  template decltype(cells_of_box<dim>)     cells_of_box<dim>; \
  template decltype(append_nodes<dim>)     append_nodes<dim>; \
  template decltype(multiply<dim>)         multiply<dim>;     \
  template decltype(require_box_mesh<dim>) require_box_mesh<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
