// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_combined_shapes_h
#define moraine_geometry_combined_shapes_h

#include <moraine/geometry/shape.h>

#include <memory>
#include <vector>

namespace moraine
{
  /**
   * x -> rotation x + shift with an orthogonal rotation.
   */
  template <int dim>
  struct Placement
  {
    /**
     * Nothing moves.
     */
    Placement();

    /**
     * Rotate by @p degrees, counter-clockwise, about @p centre (in 3D about
     * the axis through it along @p axis, which need not have unit length and
     * is not used in 2D), then translate. Multiples of a right angle about a
     * coordinate axis are exact.
     */
    Placement(const double                  degrees,
              const dealii::Point<dim>     &centre,
              const dealii::Tensor<1, dim> &axis,
              const dealii::Tensor<1, dim> &translation);

    dealii::Point<dim>
    apply(const dealii::Point<dim> &x) const;

    dealii::Point<dim>
    undo(const dealii::Point<dim> &x) const;

    dealii::Tensor<2, dim> rotation;
    dealii::Tensor<1, dim> shift;
  };



  /**
   * A shape after a rigid motion.
   */
  template <int dim>
  class MovedShape : public Shape<dim>
  {
  public:
    MovedShape(const std::shared_ptr<const Shape<dim>> &shape,
               const Placement<dim>                    &motion);

    double
    level(const dealii::Point<dim> &p) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    Overlap
    overlap(const ConvexPolytope<dim> &cell) const override;

    bool
    is_straight() const override;

  protected:
    VolumeMoments<dim>
    moments_of_part(const ConvexPolytope<dim> &cell,
                    const dealii::Point<dim>  &reference) const override;

    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

  private:
    ConvexPolytope<dim>
    moved_back(const ConvexPolytope<dim> &cell) const;

    std::shared_ptr<const Shape<dim>> shape;
    Placement<dim>                    motion;
  };



  /**
   * What two shapes a and b make: their union (a + b - ab), their
   * intersection ab (the pieces of the straighter one, clipped by the other),
   * their difference (a - ab), or a hollowed out by b, which lies inside a
   * (a - b: ring, tube; needs no intersection).
   */
  template <int dim>
  class CombinedShape : public Shape<dim>
  {
  public:
    enum class Operation
    {
      unite,
      intersect,
      subtract,
      hollow_out
    };

    CombinedShape(const Operation                          operation,
                  const std::shared_ptr<const Shape<dim>> &a,
                  const std::shared_ptr<const Shape<dim>> &b);

    double
    level(const dealii::Point<dim> &p) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    Overlap
    overlap(const ConvexPolytope<dim> &cell) const override;

    bool
    is_straight() const override;

  protected:
    VolumeMoments<dim>
    moments_of_part(const ConvexPolytope<dim> &cell,
                    const dealii::Point<dim>  &reference) const override;

    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

  private:
    /** Of ab, or of b where it lies inside a. */
    VolumeMoments<dim>
    common_moments(const ConvexPolytope<dim> &cell,
                   const dealii::Point<dim>  &reference) const;

    void
    add_common_pieces(const ConvexPolytope<dim>     &cell,
                      const double                   sign,
                      std::vector<SignedPiece<dim>> &pieces) const;

    Operation                         operation;
    std::shared_ptr<const Shape<dim>> a;
    std::shared_ptr<const Shape<dim>> b;
  };

} // namespace moraine

#endif
