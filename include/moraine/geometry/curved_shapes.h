// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_curved_shapes_h
#define moraine_geometry_curved_shapes_h

#include <moraine/core/expression.h>
#include <moraine/geometry/combined_shapes.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Where a smooth function φ is positive. Pieces are those of
   * add_curved_pieces().
   */
  template <int dim>
  class SmoothShape : public Shape<dim>
  {
  public:
    /** φ itself. */
    virtual double
    value(const dealii::Point<dim> &x) const = 0;

    /** ∇φ; @p length is the scale over which φ is seen (a cell's size). */
    virtual dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x, const double length) const = 0;

    virtual dealii::SymmetricTensor<2, dim>
    hessian(const dealii::Point<dim> &x, const double length) const = 0;

    /** Distance from φ = 0, an estimate for expressions, and outward normal. */
    virtual NearestPoint<dim>
    nearest(const dealii::Point<dim> &x) const = 0;
  };

  /**
   * Disc (2D), sphere or endless circular cylinder (3D). Its part of a polytope
   * is exact for discs and spheres (per edge, triangles and circular segments
   * in 2D; per face and edge, the part within the sphere of the cone from its
   * centre in 3D). For cylinders it is the integral along the axis of exact
   * slices, to 1e-10 of the polytope's volume; exact if the axis is parallel to
   * the edges that the cylinder cuts.
   */
  template <int dim>
  class RoundShape : public SmoothShape<dim>
  {
  public:
    /**
     * Within @p radius of @p centre, or of the line through it along @p axis
     * if that is not zero. Throws InputError for a radius that is not positive.
     */
    RoundShape(const dealii::Point<dim>     &centre,
               const double                  radius,
               const dealii::Tensor<1, dim> &axis = dealii::Tensor<1, dim>());

    double
    level(const dealii::Point<dim> &p) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    Overlap
    overlap(const ConvexPolytope<dim> &cell) const override;

    void
    add_faces(const std::string          &part,
              const bool                  body_inside,
              const Extent<dim>          &extent,
              typename Shape<dim>::Faces &faces) const override;

    /** (R² − r²)/(2R) has the zeros of the distance and is smooth at r = 0. */
    double
    value(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x, const double length) const override;

    dealii::SymmetricTensor<2, dim>
    hessian(const dealii::Point<dim> &x, const double length) const override;

    NearestPoint<dim>
    nearest(const dealii::Point<dim> &x) const override;

  protected:
    VolumeMoments<dim>
    moments_of_part(const ConvexPolytope<dim> &cell,
                    const dealii::Point<dim>  &reference) const override;

    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

  private:
    /** From the nearest point of centre or axis to x. */
    dealii::Tensor<1, dim>
    radial(const dealii::Tensor<1, dim> &from_centre) const;

    dealii::Point<dim>     centre;
    double                 radius;
    dealii::Tensor<1, dim> axis; ///< of unit length, or zero
  };

  /**
   * Solid or hollow circular cylinder: the round shape between the planes
   * through both ends of the axis. Its rim has the parts side, or outer and
   * inner, and bottom and top, where the axis starts and ends.
   */
  class CylinderShape : public CombinedShape<3>
  {
  public:
    /** Throws InputError for an axis without length. */
    CylinderShape(const dealii::Point<3> &start,
                  const dealii::Point<3> &end,
                  const double            radius,
                  const double            inner_radius = 0.);

    dealii::BoundingBox<3>
    bounding_box() const override;

    std::vector<std::string>
    parts() const override;

    void
    add_faces(const std::string &part,
              const bool         body_inside,
              const Extent<3>   &extent,
              Faces             &faces) const override;

  private:
    dealii::Point<3>                     start;
    dealii::Point<3>                     end;
    double                               radius;
    std::shared_ptr<const RoundShape<3>> outer;
    std::shared_ptr<const RoundShape<3>> inner; ///< null if solid
  };

  /**
   * Where an expression in x, y and z is positive. What is smaller than a
   * sub-cell between its vertices is not seen. Gradient and Hessian are central
   * differences (errors about 1e-9 and 1e-7 relative to φ's variation over a
   * cell). Throws InputError where the expression has no finite value, and for
   * a boundary with so many details in a cell that dividing it would take too
   * long.
   */
  template <int dim>
  class ExpressionShape : public SmoothShape<dim>
  {
  public:
    /**
     * @p place: where the text stands, for messages. @p length: scale of
     * differences where no cell is at hand; 0: the coordinates' size. Throws
     * InputError if the text cannot be understood.
     */
    ExpressionShape(const std::string &expression,
                    const std::string &place,
                    const double       length = 0.);

    double
    level(const dealii::Point<dim> &p) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    Overlap
    overlap(const ConvexPolytope<dim> &cell) const override;

    void
    add_faces(const std::string          &part,
              const bool                  body_inside,
              const Extent<dim>          &extent,
              typename Shape<dim>::Faces &faces) const override;

    double
    value(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x, const double length) const override;

    dealii::SymmetricTensor<2, dim>
    hessian(const dealii::Point<dim> &x, const double length) const override;

    NearestPoint<dim>
    nearest(const dealii::Point<dim> &x) const override;

  protected:
    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

  private:
    Expression<dim> expression;
    std::string     text;
    std::string     place;
    double          length;
  };
} // namespace moraine

#endif
