// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_surface_h
#define moraine_geometry_surface_h

#include <moraine/mesh/cell_map.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace moraine
{
  /**
   * A quadrature point on a surface: its place, the unit normal pointing out of
   * the body (−∇φ), and its weight (length in 2D, area in 3D).
   */
  template <int dim>
  struct SurfacePoint
  {
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> normal;
    double                 JxW;
  };

  /** Half the width of the bounding box of a surface without limits. */
  constexpr double unlimited_extent = 1e100;

  /** The box of a surface without limits. */
  template <int dim>
  dealii::BoundingBox<dim>
  unlimited_box();

  /** The direction of v, or any where v is zero. */
  template <int dim>
  dealii::Tensor<1, dim>
  unit_or_any(const dealii::Tensor<1, dim> &v);

  /** Throws InputError unless a radius is positive. */
  void
  check_radius(const double radius);

  /**
   * A surface φ(x) = 0 with the body on the side φ > 0, in its own frame. A
   * MovedSurface places it in space.
   */
  template <int dim>
  class Surface
  {
  public:
    virtual ~Surface() = default;

    /**
     * φ(x), positive on the body's side. The signed distance; for expressions
     * φ/|∇φ|, its first-order estimate.
     */
    virtual double
    level(const dealii::Point<dim> &x) const = 0;

    /** Unit normal pointing out of the body, −∇φ/|∇φ|, at or near the surface.
     */
    virtual dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const = 0;

    /** Whether the foot point of x lies within the extent of the surface. */
    virtual bool
    in_extent(const dealii::Point<dim> &x) const = 0;

    /**
     * Append quadrature points of the part of the surface inside one convex
     * cell. Points of a flat piece integrate polynomials of degree
     * 2 n_gauss − 1 exactly. A piece on a face shared by two cells belongs to
     * the cell on the body's side only, so the cells of a mesh share the
     * surface out without gap or overlap.
     */
    virtual void
    pieces(const CellVertices<dim>        &cell,
           const unsigned int              n_gauss,
           std::vector<SurfacePoint<dim>> &out) const = 0;

    /** A box that holds the surface; see unlimited_extent. */
    virtual dealii::BoundingBox<dim>
    bounding_box() const = 0;

    /**
     * Whether the normal changes along a smooth part of the surface; yes if not
     * overridden.
     */
    virtual bool
    curved() const
    {
      return true;
    }
  };
} // namespace moraine

#endif
