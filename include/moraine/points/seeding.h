// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_seeding_h
#define moraine_points_seeding_h

#include <moraine/geometry/shape.h>

#include <deal.II/base/quadrature.h>

#include <vector>

namespace moraine
{
  /** How points lie in a full cell. */
  enum class PointLayout
  {
    gauss,
    equal
  };

  /** A material point to be. */
  template <int dim>
  struct SeededPoint
  {
    dealii::Point<dim> position;
    double             volume;
  };

  /**
   * Fills cells with points. The reference cell is divided into n^dim
   * sub-cells, of equal lengths or with the weights of the Gauss rule as
   * lengths. Each gives one point with volume and centroid of its part in the
   * body, so that the volumes of all points sum up to the body's.
   *
   * With the Gauss layout the points of a full cell are the Gauss rule, their
   * volumes weight times detJ. (This sum is the cell's volume in 2D, and in 3D
   * for parallelepipeds or n >= 2.) A cell the body cuts has no Gauss rule;
   * there every sub-cell, full or not, has its point at its centroid, because
   * centroids and volumes integrate linear functions exactly.
   *
   * In a quadrilateral that is no parallelogram the gradients of bilinear
   * functions are not linear, but detJ times gradient is, as a function of the
   * unit cell. There the point is at the centroid of what its part is in the
   * unit cell (a full sub-cell: its middle), so that sum v_p grad N(x_p) is
   * still the integral; for cut sub-cells if the body is straight-sided. In a
   * hexahedron that is no parallelepiped only the Gauss layout with n >= 2
   * integrates gradients, in full cells; equal sub-cells have their centroids.
   *
   * In 3D the gradients of trilinear shape functions hold products of two
   * coordinates as well. A sub-cell that a straight-sided body cuts obliquely
   * has three points of equal volume there, with its centroid as their mean,
   * that integrate these too; where no such triangle lies in the body (next to
   * re-entrant edges) it has one.
   *
   * Finite elements of degree 2 ask for more: with a fitted degree k > 0 the
   * whole part of a cut cell has the points and weights of
   * moment_fitted_rule() with degree k instead, if there is one (in 3D only for
   * straight-sided bodies).
   *
   * Parts below 1e-12 of the smaller of sub-cell and body's bounding box get
   * no point.
   */
  template <int dim>
  class CellSeeder
  {
  public:
    CellSeeder(const unsigned int n_per_direction,
               const PointLayout  layout,
               const unsigned int fitted_degree = 0);

    /** Append the points of @p shape in a cell. The numbers of the sub-cells
     * run lexicographically, x fastest. */
    void
    seed(const CellVertices<dim>       &cell,
         const Shape<dim>              &shape,
         std::vector<SeededPoint<dim>> &points) const;

    /** The most points that seed() gives a cell. */
    unsigned int
    max_points() const;

    /** Sub-cells of a cell. */
    unsigned int
    n_sub_cells() const
    {
      return rule.size();
    }

    /** The sub-cell of @p cell that holds its reference position @p xi. */
    CellVertices<dim>
    sub_cell_around(const CellVertices<dim>  &cell,
                    const dealii::Point<dim> &xi) const
    {
      return sub_cell(cell, sub_cell_index(xi));
    }

    /** The distances from @p xi in a unit cell to the nearer faces of the
     * sub-cell that holds it. */
    dealii::Tensor<1, dim>
    distance_to_faces(const dealii::Point<dim> &xi) const;

    /** The longest edge of a sub-cell of a unit cell. */
    double
    longest_edge() const;

  private:
    void
    seed_full_cell(const CellVertices<dim>       &cell,
                   std::vector<SeededPoint<dim>> &points) const;

    /** Whether there is a rule for the cut cell. */
    bool
    seed_fitted(const CellVertices<dim>       &cell,
                const Shape<dim>              &shape,
                std::vector<SeededPoint<dim>> &points) const;

    CellVertices<dim>
    sub_cell(const CellVertices<dim> &cell, const unsigned int q) const;

    /** The sub-cell of a unit cell that holds @p xi, or is nearest to it. */
    unsigned int
    sub_cell_index(const dealii::Point<dim> &xi) const;

    PointLayout  layout;
    unsigned int fitted_degree;

    /** The middles of the sub-cells or the Gauss points, with weights. */
    dealii::Quadrature<dim> rule;

    std::vector<dealii::Point<dim>>     lower;
    std::vector<dealii::Tensor<1, dim>> lengths;
  };

} // namespace moraine

#endif
