// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_arc_h
#define moraine_geometry_arc_h

#include <moraine/geometry/surface.h>

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
} // namespace moraine

#endif
