// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_local_functions_h
#define moraine_basis_local_functions_h

#include <moraine/basis/cell_patch.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace moraine
{
  /** In cells. A box as thin as that is a point; its average would be
   * round-off. */
  inline constexpr double thin_box = 1e-8;

  /** A block of cells of a box mesh: the first and the last, by direction. */
  template <int dim>
  struct CellWindow
  {
    std::array<unsigned int, dim> first;
    std::array<unsigned int, dim> last;

    bool
    operator<(const CellWindow &other) const
    {
      return std::tie(first, last) < std::tie(other.first, other.last);
    }

    unsigned int
    n_cells() const
    {
      unsigned int n = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n *= last[d] - first[d] + 1;
      return n;
    }

    bool
    contains(const CellWindow &other) const
    {
      bool inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        inside =
          inside && first[d] <= other.first[d] && other.last[d] <= last[d];
      return inside;
    }

    /** Call @p visit with the place of each cell, the first direction running
     * fastest. */
    template <typename Visit>
    void
    for_each_cell(const Visit &visit) const
    {
      auto ijk = first;
      for (;;)
        {
          visit(ijk);
          unsigned int d = 0;
          while (d < dim && ijk[d] == last[d])
            {
              ijk[d] = first[d];
              ++d;
            }
          if (d == dim)
            return;
          ++ijk[d];
        }
    }
  };

  /** The cells that a box around @p x with half lengths @p l overlaps; where it
   * reaches over the edge of the mesh it is cut. */
  template <int dim>
  CellWindow<dim>
  cells_of_box(const BoxGrid<dim>       &grid,
               const dealii::Point<dim> &x,
               const double             *l);

  /** Append the nodes of the cells of a window to @p nodes, the first direction
   * running fastest. The cells are active. */
  template <int dim>
  void
  append_nodes(const CellWindow<dim>     &window,
               const CellNeighbours<dim> &neighbours,
               const GridSpace<dim>      &space,
               std::vector<unsigned int> &nodes);

  /** Values in each direction of functions that are products of them, and
   * derivatives; up to 4 in each. */
  struct LineFunctions
  {
    std::array<unsigned int, 3> n{{1, 1, 1}};
    double                      values[3][4];
    double                      slopes[3][4];
  };

  /** Values and gradients of the products, the first direction running fastest.
   */
  template <int dim>
  void
  multiply(const LineFunctions    &f,
           double                 *values,
           dealii::Tensor<1, dim> *gradients);

  /**
   * @throws ObjectError naming the @p method if the mesh is not a box of equal
   * cells or the functions are not of degree 1.
   */
  template <int dim>
  void
  require_box_mesh(const GridSpace<dim> &space, const std::string &method);

  /** The extent of a box in one direction, in cells: from @f$x - l@f$ to @f$x +
   * l@f$, cut at 0 and the number of cells. */
  class LineOfBox
  {
  public:
    LineOfBox(const double x, const double l, const unsigned int n_cells)
      : lower(std::max(x - l, 0.))
      , upper(std::min<double>(x + l, n_cells))
      , is_point(upper - lower < thin_box)
      , per_length(is_point ? 0. : 1 / (upper - lower))
    {
      if (is_point)
        {
          lower = std::clamp(std::floor(x), 0., n_cells - 1.);
          upper = x;
        }
    }

    /**
     * The averages over the line of the hat functions of a cell, of which only
     * the part [a, b] in the cell counts: the local functions of GIMP, with L
     * the length and a, b from the cell's lower end,
     * @f[ S^*_0 = \frac{1}{L}\left(b - a - \frac{b^2 - a^2}{2}\right), \qquad
     *     S^*_1 = \frac{b^2 - a^2}{2 L}. @f]
     * Their sum is the share of the line that is in the cell.
     */
    std::array<double, 2>
    hats(const unsigned int cell) const
    {
      if (is_point)
        {
          const double right = upper - lower;
          return cell == lower ? std::array<double, 2>{{1 - right, right}} :
                                 std::array<double, 2>{{0., 0.}};
        }
      const double a     = std::clamp(lower - cell, 0., 1.);
      const double b     = std::clamp(upper - cell, 0., 1.);
      const double share = (b - a) * per_length;
      const double right = 0.5 * (a + b) * share;
      return {{share - right, right}};
    }

  private:
    double lower; ///< of a point the cell it is in
    double upper; ///< of a point its place
    bool   is_point;
    double per_length;
  };

  /**
   * The local functions @f$S^*_{ip}@f$ of the cells that points touch,
   * @f[ S^*_{ip}(e) = \frac{1}{V_p} \int_{\Omega_p \cap \Omega_e} N_i \, dx @f]
   * (González Acosta et al. 2020), over the boxes of GIMP, or, if points have
   * none, @f$N_i(x_p)@f$ in the cell of the point. They are products of one
   * function for each direction. A box that reaches over the edge of the mesh
   * is cut there. Needs a mesh of equal boxes.
   */
  template <int dim>
  class LocalFunctions
  {
  public:
    /** With boxes if the points have the field `half_length`. Keeps references
     * to both. */
    LocalFunctions(const GridSpace<dim> &space, const PointSet<dim> &points);

    /** The cells that a point in the cell at @p place touches. */
    CellWindow<dim>
    cells(const std::array<unsigned int, dim> &place,
          const unsigned int                   point) const;

    /** The two functions in each direction of a cell that a point touches;
     * their sums over nodes and cells are 1. */
    std::array<std::array<double, 2>, dim>
    values(const std::array<unsigned int, dim> &cell,
           const unsigned int                   point) const;

  private:
    const BoxGrid<dim> &
    grid() const
    {
      return *space.mesh().box_grid();
    }

    const GridSpace<dim>                         &space;
    const PointSet<dim>                          &points;
    const PointField<dim, dealii::Tensor<1, dim>> half_length;
  };
} // namespace moraine

#endif
