// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_straight_surfaces_h
#define moraine_geometry_straight_surfaces_h

#include <moraine/geometry/cell_cut.h>
#include <moraine/geometry/surface.h>

namespace moraine
{
  /**
   * One or more straight segments in 2D. The body is on the LEFT when walking
   * along the points in their order; @p flip puts it on the right. A last point
   * equal to the first closes the line. Beyond the open ends, φ goes on as the
   * distance to the straight line of the end segment, outside the extent.
   *
   * Throws InputError for fewer than two points or two equal neighbours.
   */
  class Polyline : public Surface<2>
  {
  public:
    Polyline(const std::vector<dealii::Point<2>> &points,
             const bool                           flip = false);

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
    struct Segment
    {
      dealii::Point<2>     start;
      dealii::Tensor<1, 2> direction;
      dealii::Tensor<1, 2> normal;
      double               length;
    };

    /** Where the point of the line nearest to x lies. */
    struct Foot
    {
      const Segment       *segment;
      double               distance;
      dealii::Tensor<1, 2> normal;
      bool                 beyond_end;
    };

    Foot
    nearest(const dealii::Point<2> &x) const;

    std::vector<Segment>   segments;
    bool                   closed;
    dealii::BoundingBox<2> box;
    double                 magnitude;
  };

  /** A straight line (2D) or plane (3D) without limits. */
  template <int dim>
  class Plane : public Surface<dim>
  {
  public:
    /**
     * Through @p point with @p normal, of any length, pointing out of the body.
     * Throws InputError if it is zero.
     */
    Plane(const dealii::Point<dim>     &point,
          const dealii::Tensor<1, dim> &normal);

    double
    level(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const override;

    bool
    in_extent(const dealii::Point<dim> &x) const override;

    void
    pieces(const CellVertices<dim>        &cell,
           const unsigned int              n_gauss,
           std::vector<SurfacePoint<dim>> &out) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

    bool
    curved() const override;

  private:
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> unit_normal;
    double                 magnitude;
  };

  /**
   * A plane simple polygon in 3D. Seen from outside the body its vertices run
   * counter-clockwise (their right-hand normal points out of the body);
   * @p flip puts the body on the other side.
   *
   * Throws InputError for fewer than three vertices, no area, vertices off the
   * plane by more than 1e-9 of its size, or edges that cross.
   */
  class PlanePatch : public Surface<3>
  {
  public:
    PlanePatch(const std::vector<dealii::Point<3>> &vertices,
               const bool                           flip = false);

    double
    level(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const override;

    bool
    in_extent(const dealii::Point<3> &x) const override;

    void
    pieces(const CellVertices<3>        &cell,
           const unsigned int            n_gauss,
           std::vector<SurfacePoint<3>> &out) const override;

    dealii::BoundingBox<3>
    bounding_box() const override;

    bool
    curved() const override;

  private:
    PlaneFrame             frame;
    dealii::Tensor<1, 3>   unit_normal;
    std::vector<Polygon>   convex_parts;
    dealii::BoundingBox<3> box;
    double                 magnitude;
  };
} // namespace moraine

#endif
