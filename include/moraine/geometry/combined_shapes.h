// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_combined_shapes_h
#define moraine_geometry_combined_shapes_h

#include <moraine/geometry/shape.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
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

    std::vector<std::string>
    parts() const override;

    void
    add_faces(const std::string          &part,
              const bool                  body_inside,
              const Extent<dim>          &extent,
              typename Shape<dim>::Faces &faces) const override;

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
   *
   * The rims of the operands a and b are the parts of its rim, with the names
   * given. Parts of theirs are called name/part, or part if they have no name.
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
                  const std::shared_ptr<const Shape<dim>> &b,
                  const std::array<std::string, 2>        &names = {});

    double
    level(const dealii::Point<dim> &p) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    Overlap
    overlap(const ConvexPolytope<dim> &cell) const override;

    bool
    is_straight() const override;

    std::vector<std::string>
    parts() const override;

    void
    add_faces(const std::string          &part,
              const bool                  body_inside,
              const Extent<dim>          &extent,
              typename Shape<dim>::Faces &faces) const override;

  protected:
    VolumeMoments<dim>
    moments_of_part(const ConvexPolytope<dim> &cell,
                    const dealii::Point<dim>  &reference) const override;

    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

    Operation                         operation;
    std::shared_ptr<const Shape<dim>> a;
    std::shared_ptr<const Shape<dim>> b;

  private:
    /** Of ab, or of b where it lies inside a. */
    VolumeMoments<dim>
    common_moments(const ConvexPolytope<dim> &cell,
                   const dealii::Point<dim>  &reference) const;

    void
    add_common_pieces(const ConvexPolytope<dim>     &cell,
                      const double                   sign,
                      std::vector<SignedPiece<dim>> &pieces) const;

    /** What comes before the names of an operand's parts. */
    std::string
    prefix(const unsigned int k) const;

    std::array<std::string, 2> names;
  };
} // namespace moraine

#endif
