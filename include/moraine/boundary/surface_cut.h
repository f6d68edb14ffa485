// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_surface_cut_h
#define moraine_boundary_surface_cut_h

#include <moraine/boundary/body_behind.h>
#include <moraine/geometry/shape.h>
#include <moraine/mesh/grid_space.h>

#include <vector>

namespace moraine
{
  /** A place of a surface in an active cell, at the start of a step. */
  template <int dim>
  struct CutPoint
  {
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> normal;     ///< outward
    double                 JxW;        ///< length or area
    double                 body_area;  ///< the part of it that a body is at
    unsigned int           cell;       ///< active_cell_index()
    unsigned int           number = 0; ///< among the points of the cell
    double                 h;          ///< size of that cell
  };

  /** Functions of the nodes of each point's cell, point by point. */
  template <int dim>
  struct CutFunctions
  {
    unsigned int                        n_nodes = 0; ///< of a cell
    std::vector<double>                 values;
    std::vector<dealii::Tensor<1, dim>> gradients;
  };

  /** How fields vary along a piece of which @p point is the mean; see
   * BoundarySlope. */
  template <int dim>
  struct CutSlope
  {
    unsigned int           point;
    dealii::Tensor<1, dim> offset; ///< @f$s\, e@f$
  };

  /**
   * Where a surface cuts the active cells of this rank: Gauss points of its
   * pieces, cell by cell, or the means over them.
   */
  template <int dim>
  struct SurfaceCut
  {
    std::vector<CutPoint<dim>> points;
    CutFunctions<dim>          functions;
    std::vector<CutSlope<dim>> slopes;
    std::vector<double>        slopes_of_N; ///< n_nodes for each slope

    /** Of which pieces take_means() finds slopes: a roller has none on curved
     * pieces, whose mean normal is no normal of the surface. */
    enum class Slopes
    {
      none,
      straight,
      all
    };

    /**
     * Find the points. A piece in a cell without unknowns that lies within
     * @p search_tolerance of an active cell belongs to the nearest one and sees
     * its functions continued over the edge, because the material represented
     * by points close to the edge reaches over it.
     *
     * Where @p body finds none behind a part of the surface in a cell, that
     * part is left out (unless there are none at all); but not if it @p
     * holds_beyond_bodies, as one that is pushed through material would lose
     * hold of it, and of means only along faces of cells.
     */
    SurfaceCut(const GridSpace<dim>    &space,
               const MovedSurface<dim> &surface,
               const double             search_tolerance,
               BodyBehind<dim>         &body,
               const bool               holds_beyond_bodies,
               const bool               of_means);

    SurfaceCut() = default;

    /** Let the points of a cell be one, with the means of their functions; on
     * each side of a corner one. Those of a piece parallel to faces of the cell
     * stay, as functions can vanish there and keep their gradient. */
    void
    take_means(const GridSpace<dim> &space, const Slopes of_pieces);

  private:
    void
    number_points();

    /** Find the slopes of @p means, of which point q is part of mean
     * @p mean_of[q]. */
    void
    find_slopes(const std::vector<CutPoint<dim>> &means,
                const std::vector<unsigned int>  &mean_of,
                const Slopes                      of_pieces);
  };

  /** Whether the surface runs through a cell, but not along its faces alone. */
  template <int dim>
  bool
  cuts_across(const MovedSurface<dim>                     &surface,
              const typename GridSpace<dim>::CellIterator &cell);
} // namespace moraine

#endif
