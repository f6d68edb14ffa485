// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_straight_shapes_h
#define moraine_geometry_straight_shapes_h

#include <moraine/geometry/shape.h>

#include <utility>
#include <vector>

namespace moraine
{
  /**
   * The intersection of half spaces.
   */
  template <int dim>
  class ConvexShape : public Shape<dim>
  {
  public:
    /**
     * The half space n . (x - point) <= 0 with the outward unit normal n.
     */
    struct HalfSpace
    {
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> outward;
    };

    /**
     * @p bounding_box must hold the intersection of @p sides. @p names are
     * those of the sides, or none.
     */
    ConvexShape(
      const std::vector<HalfSpace>   &sides,
      const dealii::BoundingBox<dim> &bounding_box = unlimited_box<dim>(),
      const std::vector<std::string> &names        = {});

    /**
     * The box with these opposite corners, lower < upper. Its sides are called
     * left, right (x), bottom, top (y), or front, back (y), bottom, top (z).
     */
    static ConvexShape
    box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper);

    /** All of space: the body is the mesh. */
    static ConvexShape
    space();

    /**
     * The half space behind a plane; the normal need not have unit length.
     */
    static ConvexShape
    half_space(const dealii::Point<dim>     &point,
               const dealii::Tensor<1, dim> &outward_normal);

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
    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

  private:
    /** The corners of a side as a PlaneSurface wants them; bounded shapes. */
    std::vector<dealii::Point<dim>>
    corners_of(const unsigned int side) const;

    std::vector<HalfSpace>   sides;
    dealii::BoundingBox<dim> bounds;
    std::vector<std::string> names;
  };

  /**
   * A simple polygon, convex or not, in the x-y plane; in 3D the prism over it
   * between two values of z.
   */
  template <int dim>
  class PolygonShape : public Shape<dim>
  {
  public:
    /**
     * The vertices in either sense of rotation, at least three, without
     * crossing edges (see first_crossing() in polygon.h). @p heights are lower
     * and upper z, not used in 2D.
     */
    PolygonShape(const std::vector<dealii::Point<2>> &vertices,
                 const std::pair<double, double>     &heights = {0., 1.});

    double
    level(const dealii::Point<dim> &p) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    bool
    is_straight() const override;

    /** The edges, counted from 1 in the order given; in 3D bottom and top. */
    std::vector<std::string>
    parts() const override;

    void
    add_faces(const std::string          &part,
              const bool                  body_inside,
              const Extent<dim>          &extent,
              typename Shape<dim>::Faces &faces) const override;

  protected:
    /**
     * The triangles from the first vertex, each counted with the sign of its
     * area, clipped with the cell.
     */
    void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const override;

  private:
    std::vector<dealii::Point<2>> vertices; ///< counter-clockwise
    std::pair<double, double>     heights;
    bool                          reversed;
  };
} // namespace moraine

#endif
