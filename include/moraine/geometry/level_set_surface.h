// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_level_set_surface_h
#define moraine_geometry_level_set_surface_h

#include <moraine/geometry/surface.h>

#include <deal.II/base/symmetric_tensor.h>

namespace moraine
{
  /** The half-space of points x with direction·x ≥ offset. */
  template <int dim>
  struct HalfSpace
  {
    dealii::Tensor<1, dim> direction;
    double                 offset;
  };

  /**
   * A surface given by a smooth function φ, cut by
   * dealii::NonMatching::QuadratureGenerator in the reference space of the cell
   * (φ composed with the cell's multilinear map). The number of points sets its
   * accuracy; it is not exact. Limits are half-spaces: cells across a
   * limit are cut exactly if it follows the cell's axes, else halved four times
   * and their points chosen one by one.
   */
  template <int dim>
  class LevelSetSurface : public Surface<dim>
  {
  public:
    /** φ itself, positive on the body's side. */
    virtual double
    function_value(const dealii::Point<dim> &x) const = 0;

    /** ∇φ; @p length is the scale over which φ is seen (a cell's size). */
    virtual dealii::Tensor<1, dim>
    function_gradient(const dealii::Point<dim> &x,
                      const double              length) const = 0;

    virtual dealii::SymmetricTensor<2, dim>
    function_hessian(const dealii::Point<dim> &x,
                     const double              length) const = 0;

    bool
    in_extent(const dealii::Point<dim> &x) const override;

    void
    pieces(const CellVertices<dim>        &cell,
           const unsigned int              n_gauss,
           std::vector<SurfacePoint<dim>> &out) const override;

  protected:
    /** The point of the surface that belongs to a nearby x. */
    virtual dealii::Point<dim>
    foot_point(const dealii::Point<dim> &x) const = 0;

    std::vector<HalfSpace<dim>> limits;
  };
} // namespace moraine

#endif
