// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_covered_pieces_h
#define moraine_geometry_covered_pieces_h

#include <moraine/geometry/shape.h>

#include <functional>
#include <memory>
#include <vector>

namespace moraine
{
  /** Of a cell: a body further away than this is not at a surface in it. */
  inline constexpr double largest_gap = 0.5;

  /** Whether a body covers a place, or would if it were larger by a margin
   * [length]. */
  template <int dim>
  using Covers =
    std::function<bool(const dealii::Point<dim> &x, const double margin)>;

  /** Whether a shape covers a place, or would if it were larger by @p margin.
   * Where an expression is no number it does. */
  template <int dim>
  bool
  covers_place(const Shape<dim>         &shape,
               const dealii::Point<dim> &x,
               const double              margin);

  /** Those of bodies where they are at first; none if the points of one of them
   * are given, so that its @p shapes entry is null. */
  template <int dim>
  Covers<dim>
  covers_of(const std::vector<std::shared_ptr<const Shape<dim>>> &shapes);

  /** Whether a body is at a place of a surface or behind it by less than a
   * tenth of the cell size @p h. @p normal is the outward one. */
  template <int dim>
  bool
  is_at_body(const Covers<dim>            &covers,
             const dealii::Point<dim>     &x,
             const dealii::Tensor<1, dim> &normal,
             const double                  h);

  /** Whether one is within half a cell behind it. */
  template <int dim>
  bool
  is_near_body(const Covers<dim>            &covers,
               const dealii::Point<dim>     &x,
               const dealii::Tensor<1, dim> &normal,
               const double                  h);

  /** The union of bodies where they are at first; null if the points of one of
   * them are given, so that its @p shapes entry is null. */
  template <int dim>
  ShapePointer<dim>
  united(const std::vector<ShapePointer<dim>> &shapes);

  /** The part of surfaces in a body or at it, or at most @p reach [length] off
   * on either side where the rim of the body runs along them. */
  template <int dim>
  Extent<dim>
  beside(const ShapePointer<dim> &body, const double reach);

  /**
   * The points of a surface in a cell that are to be kept. Where only some are,
   * as a body ends there, the cell is halved.
   * What is nearer to a face of the cell than all points is not seen: 7 % of
   * the cell size with 4 points in each direction.
   *
   * @param surface any
   * @param cell its vertices
   * @param n_gauss points in each direction of a piece of the whole cell
   * @param keep says of a point whether it is kept; may be asked twice
   * @param points they are added to
   * @param n_halvings of a cell in which a body ends
   */
  template <int dim>
  void
  add_kept_pieces(const Surface<dim>                                   &surface,
                  const CellVertices<dim>                              &cell,
                  const unsigned int                                    n_gauss,
                  const std::function<bool(const SurfacePoint<dim> &)> &keep,
                  std::vector<SurfacePoint<dim>>                       &points,
                  const unsigned int n_halvings = dim == 2 ? 4 : 2);
} // namespace moraine

#endif
