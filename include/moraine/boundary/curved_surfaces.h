// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_curved_surfaces_h
#define moraine_boundary_curved_surfaces_h

#include <moraine/boundary/surface.h>

#include <deal.II/base/function_parser.h>

#include <string>

namespace moraine
{
  /**
   * A circle or an arc of it in 2D: counter-clockwise from the start to the end
   * angle (degrees from the x axis), the body inside or outside. Pieces are cut
   * exactly by the cell's straight edges and use Gauss points in the angle, on
   * stretches of at most 45 degrees.
   *
   * Throws InputError for a radius that is not positive, or an arc of zero or
   * more than 360 degrees.
   */
  class Arc : public Surface<2>
  {
  public:
    Arc(const dealii::Point<2> &centre,
        const double            radius,
        const bool              body_inside,
        const double            start_angle = 0.,
        const double            end_angle   = 360.);

    double
    level(const dealii::Point<2> &x) const override;

    dealii::Tensor<1, 2>
    normal(const dealii::Point<2> &x) const override;

    bool
    in_extent(const dealii::Point<2> &x) const override;

    void
    pieces(const CellVertices<2>        &cell,
           const unsigned int            n_gauss,
           std::vector<SurfacePoint<2>> &out) const override;

    dealii::BoundingBox<2>
    bounding_box() const override;

    bool
    curved() const override;

  private:
    /** Angle of x from the start of the arc, in [0, 2π). */
    double
    angle_from_start(const dealii::Point<2> &x) const;

    dealii::Point<2>
    at_angle(const double from_start) const;

    dealii::Point<2>       centre;
    double                 radius;
    double                 sign;
    double                 start;
    double                 sweep;
    dealii::BoundingBox<2> box;
  };

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

    bool
    curved() const override;

  protected:
    /** The point of the surface that belongs to a nearby x. */
    virtual dealii::Point<dim>
    foot_point(const dealii::Point<dim> &x) const = 0;

    std::vector<HalfSpace<dim>> limits;
  };

  /**
   * A sphere (in 2D a circle, by the generator), the body inside or outside.
   * Throws InputError for a radius that is not positive.
   */
  template <int dim>
  class Sphere : public LevelSetSurface<dim>
  {
  public:
    Sphere(const dealii::Point<dim> &centre,
           const double              radius,
           const bool                body_inside);

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
    dealii::Point<dim> centre;
    double             radius;
    double             sign;
  };

  /**
   * The round side of a cylinder in 3D between the planes through both ends of
   * its axis, the body inside or outside. Throws InputError for a radius or an
   * axis length that is not positive.
   */
  class Cylinder : public LevelSetSurface<3>
  {
  public:
    Cylinder(const dealii::Point<3> &axis_start,
             const dealii::Point<3> &axis_end,
             const double            radius,
             const bool              body_inside);

    double
    level(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const override;

    dealii::BoundingBox<3>
    bounding_box() const override;

    double
    function_value(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    function_gradient(const dealii::Point<3> &x,
                      const double            length) const override;

    dealii::SymmetricTensor<2, 3>
    function_hessian(const dealii::Point<3> &x,
                     const double            length) const override;

  protected:
    dealii::Point<3>
    foot_point(const dealii::Point<3> &x) const override;

  private:
    dealii::Tensor<1, 3>
    radial(const dealii::Point<3> &x) const;

    dealii::Point<3>     start, end;
    dealii::Tensor<1, 3> axis;
    double               radius;
    double               sign;
  };

  /**
   * φ(x, y[, z]) = 0 in muParser syntax, φ > 0 on the body's side, within a box
   * if one is given. Gradient and Hessian are central differences (errors about
   * 1e-9 and 1e-7 relative to φ's variation over a cell).
   *
   * Throws InputError if the text cannot be read.
   */
  template <int dim>
  class ExpressionSurface : public LevelSetSurface<dim>
  {
  public:
    explicit ExpressionSurface(const std::string &expression);

    ExpressionSurface(const std::string              &expression,
                      const dealii::BoundingBox<dim> &extent);

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

    dealii::FunctionParser<dim> function;
    dealii::BoundingBox<dim>    box;
  };
} // namespace moraine

#endif
