// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_curved_surfaces_h
#define moraine_geometry_curved_surfaces_h

#include <moraine/geometry/level_set_surface.h>
#include <moraine/core/expression.h>

#include <string>

namespace moraine
{
  /**
   * What spheres and cylinders share: a constant distance from a centre or an
   * axis, the body inside or outside.
   */
  class RoundSurface : public LevelSetSurface<3>
  {
  public:
    double
    level(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const override;

    double
    function_value(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    function_gradient(const dealii::Point<3> &x,
                      const double            length) const override;

  protected:
    /** Throws InputError for a radius that is not positive. */
    RoundSurface(const double radius, const bool body_inside);

    /** From the nearest point of centre or axis to x. */
    virtual dealii::Tensor<1, 3>
    radial(const dealii::Point<3> &x) const = 0;

    double radius;
    double sign;
  };

  /** A sphere, the body inside or outside. */
  class Sphere : public RoundSurface
  {
  public:
    Sphere(const dealii::Point<3> &centre,
           const double            radius,
           const bool              body_inside);

    dealii::BoundingBox<3>
    bounding_box() const override;

    dealii::SymmetricTensor<2, 3>
    function_hessian(const dealii::Point<3> &x,
                     const double            length) const override;

  protected:
    dealii::Point<3>
    foot_point(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    radial(const dealii::Point<3> &x) const override;

  private:
    dealii::Point<3> centre;
  };

  /**
   * The round side of a cylinder between the planes through both ends of its
   * axis, the body inside or outside. Throws InputError for an axis without
   * length.
   */
  class Cylinder : public RoundSurface
  {
  public:
    Cylinder(const dealii::Point<3> &axis_start,
             const dealii::Point<3> &axis_end,
             const double            radius,
             const bool              body_inside);

    dealii::BoundingBox<3>
    bounding_box() const override;

    dealii::SymmetricTensor<2, 3>
    function_hessian(const dealii::Point<3> &x,
                     const double            length) const override;

  protected:
    dealii::Point<3>
    foot_point(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    radial(const dealii::Point<3> &x) const override;

  private:
    dealii::Point<3>     start, end;
    dealii::Tensor<1, 3> axis;
  };

  /**
   * φ(x, y[, z]) = 0 in muParser syntax, φ > 0 on the body's side, within a box
   * if one is given. Gradient and Hessian are central differences (errors about
   * 1e-9 and 1e-7 relative to φ's variation over a cell).
   *
   * Throws InputError if the text cannot be read, and where φ is not a finite
   * number.
   */
  template <int dim>
  class ExpressionSurface : public LevelSetSurface<dim>
  {
  public:
    /** @p place: where the text stands, for messages. */
    ExpressionSurface(
      const std::string              &expression,
      const std::string              &place,
      const dealii::BoundingBox<dim> &extent = unlimited_box<dim>());

    double
    level(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    double
    function_value(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    function_gradient(const dealii::Point<dim> &x,
                      const double              length) const override;

    dealii::SymmetricTensor<2, dim>
    function_hessian(const dealii::Point<dim> &x,
                     const double              length) const override;

  protected:
    dealii::Point<dim>
    foot_point(const dealii::Point<dim> &x) const override;

  private:
    /** Scale of differences where no cell is at hand. */
    double
    length_near(const dealii::Point<dim> &x) const;

    Expression<dim>          function;
    dealii::BoundingBox<dim> box;
  };
} // namespace moraine

#endif
