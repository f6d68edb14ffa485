// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_curved_surfaces_h
#define moraine_geometry_curved_surfaces_h

#include <moraine/geometry/curved_shapes.h>
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
        const double            end_angle   = 360.,
        const Extent<2>        &extent      = {});

    NearestPoint<2>
    nearest(const dealii::Point<2> &x) const override;

    void
    pieces(const CellVertices<2>        &cell,
           const unsigned int            n_gauss,
           std::vector<SurfacePoint<2>> &out) const override;

    dealii::BoundingBox<2>
    bounding_box() const override;

  private:
    /** An angle as seen from the start of the arc, in [0, 2π). */
    double
    from_start(const double angle) const;

    dealii::Point<2>
    at_angle(const double from_start) const;

    dealii::Tensor<1, 2>
    normal_at(const dealii::Point<2> &x) const;

    /** Gauss points of the stretch between two angles from the start. */
    void
    add_points(const double                  from,
               const double                  to,
               const unsigned int            n_gauss,
               std::vector<SurfacePoint<2>> &out) const;

    dealii::Point<2>       centre;
    double                 radius;
    double                 sign;
    double                 start;
    double                 sweep;
    dealii::BoundingBox<2> box;
    Extent<2>              extent;
  };

  /**
   * The boundary φ = 0 of a smooth shape, the body in the shape or around it,
   * cut by dealii::NonMatching::QuadratureGenerator in the reference space of
   * the cell (φ composed with the cell's multilinear map). The number of points
   * sets its accuracy; it is not exact. Cells across the end of its extent are
   * cut exactly if that is straight and follows the cell's axes, else halved
   * four times and their points chosen one by one.
   */
  template <int dim>
  class LevelSetSurface : public Surface<dim>
  {
  public:
    /** @p box holds the part of the surface within @p extent. */
    LevelSetSurface(const std::shared_ptr<const SmoothShape<dim>> &shape,
                    const bool                                     body_inside,
                    const Extent<dim>                             &extent,
                    const dealii::BoundingBox<dim>                &box);

    NearestPoint<dim>
    nearest(const dealii::Point<dim> &x) const override;

    void
    pieces(const CellVertices<dim>        &cell,
           const unsigned int              n_gauss,
           std::vector<SurfacePoint<dim>> &out) const override;

    dealii::BoundingBox<dim>
    bounding_box() const override;

  private:
    std::shared_ptr<const SmoothShape<dim>> shape;
    bool                                    body_inside;
    Extent<dim>                             extent;
    dealii::BoundingBox<dim>                box;
  };
} // namespace moraine

#endif
