// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_curved_shapes_h
#define moraine_geometry_curved_shapes_h

#include <moraine/core/expression.h>

#include <moraine/geometry/curve_subdivision.h>
#include <moraine/geometry/shape.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * What the round shapes share: they are convex, and their pieces are those of
   * a CurveSubdivision.
   */
  template <int dim>
  class RoundShape : public Shape<dim>
  {
  public:
    Overlap
    overlap(const ConvexPolytope<dim> &cell) const override;

  protected:
    RoundShape(const double radius, const CurveSubdivision<dim> &subdivision);

    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

    double                radius;
    CurveSubdivision<dim> subdivision;
  };



  /**
   * Disc (2D) or sphere (3D). Its part of a polytope is exact: per edge,
   * triangles and circular segments in 2D; per face and edge, the part within
   * the sphere of the cone from its centre in 3D.
   */
  template <int dim>
  class BallShape : public RoundShape<dim>
  {
  public:
    BallShape(const dealii::Point<dim>    &centre,
              const double                 radius,
              const CurveSubdivision<dim> &subdivision = {});

    double
    level(const dealii::Point<dim> &p) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

  protected:
    VolumeMoments<dim>
    moments_of_part(const ConvexPolytope<dim> &cell,
                    const dealii::Point<dim>  &reference) const override;

  private:
    dealii::Point<dim> centre;
  };



  /**
   * Solid circular cylinder. Its part of a polytope is the integral along the
   * axis of exact slices, to 1e-10 of the polytope's volume; exact if the axis
   * is parallel to the edges that the cylinder cuts.
   */
  class CylinderShape : public RoundShape<3>
  {
  public:
    CylinderShape(const dealii::Point<3>    &start,
                  const dealii::Point<3>    &end,
                  const double               radius,
                  const CurveSubdivision<3> &subdivision = {});

    double
    level(const dealii::Point<3> &p) const override;

    dealii::BoundingBox<3>
    bounding_box() const override;

  protected:
    VolumeMoments<3>
    moments_of_part(const ConvexPolytope<3> &cell,
                    const dealii::Point<3>  &reference) const override;

    void
    add_pieces_of_part(const ConvexPolytope<3>     &cell,
                       const double                 sign,
                       std::vector<SignedPiece<3>> &pieces) const override;

  private:
    double
    radial_level(const dealii::Point<3> &p) const;

    ConvexPolytope<3>
    between_ends(const ConvexPolytope<3> &cell) const;

    dealii::Point<3>     start;
    dealii::Tensor<1, 3> axis;
    double               length;
  };



  /**
   * Where an expression in x, y and z is positive. What is smaller than a
   * sub-cell between its vertices is not seen. Throws InputError where the
   * expression has no finite value.
   */
  template <int dim>
  class ExpressionShape : public Shape<dim>
  {
  public:
    /**
     * @p place: where the text stands, for messages. Throws InputError if the
     * text cannot be understood.
     */
    ExpressionShape(const std::string           &expression,
                    const std::string           &place,
                    const CurveSubdivision<dim> &subdivision = {});

    double
    level(const dealii::Point<dim> &p) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    Overlap
    overlap(const ConvexPolytope<dim> &cell) const override;

  protected:
    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

  private:
    Expression<dim>       expression;
    CurveSubdivision<dim> subdivision;
  };
} // namespace moraine

#endif
