// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_straight_surfaces_h
#define moraine_geometry_straight_surfaces_h

#include <moraine/geometry/cell_cut.h>
#include <moraine/geometry/surface.h>

#include <type_traits>

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
             const bool                           flip   = false,
             const Extent<2>                     &extent = {});

    /**
     * The straight line without ends through @p point with @p normal, of any
     * length, pointing out of the body. Throws InputError if it is zero.
     */
    static Polyline
    plane(const dealii::Point<2>     &point,
          const dealii::Tensor<1, 2> &normal,
          const Extent<2>            &extent = {});

    NearestPoint<2>
    nearest(const dealii::Point<2> &x) const override;

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
      double               from; ///< abscissa of its first point
      double               to;
    };

    Polyline(const dealii::BoundingBox<2> &box,
             const double                  magnitude,
             const Extent<2>              &extent);

    std::vector<Segment>   segments;
    bool                   closed = false;
    dealii::BoundingBox<2> box;
    double                 magnitude;
    Extent<2>              extent;
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
               const bool                           flip   = false,
               const Extent<3>                     &extent = {});

    /** The plane without ends; see Polyline::plane(). */
    static PlanePatch
    plane(const dealii::Point<3>     &point,
          const dealii::Tensor<1, 3> &normal,
          const Extent<3>            &extent = {});

    NearestPoint<3>
    nearest(const dealii::Point<3> &x) const override;

    void
    pieces(const CellVertices<3>        &cell,
           const unsigned int            n_gauss,
           std::vector<SurfacePoint<3>> &out) const override;

    dealii::BoundingBox<3>
    bounding_box() const override;

    bool
    curved() const override;

  private:
    PlanePatch(const PlaneFrame             &frame,
               const dealii::Tensor<1, 3>   &unit_normal,
               const dealii::BoundingBox<3> &box,
               const double                  magnitude,
               const Extent<3>              &extent);

    /** Append points of what of a polygon lies within the extent. */
    void
    add_points(const Polygon                &polygon,
               const double                  tolerance,
               const unsigned int            n_gauss,
               std::vector<SurfacePoint<3>> &out) const;

    PlaneFrame             frame;
    dealii::Tensor<1, 3>   unit_normal;
    std::vector<Polygon>   convex_parts; ///< none: the whole plane
    dealii::BoundingBox<3> box;
    double                 magnitude;
    Extent<3>              extent;
  };

  /** What is bounded by corners in a plane, or the whole plane. */
  template <int dim>
  using PlaneSurface = std::conditional_t<dim == 2, Polyline, PlanePatch>;
} // namespace moraine

#endif
