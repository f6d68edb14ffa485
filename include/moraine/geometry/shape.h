// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shape_h
#define moraine_geometry_shape_h

#include <moraine/geometry/convex_polytope.h>
#include <moraine/geometry/surface.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * What a shape covers of a polytope, to the shape's accuracy.
   */
  template <int dim>
  struct ClippedVolume
  {
    double             volume = 0.;
    dealii::Point<dim> centroid;
  };

  /**
   * One term of a signed sum of polytopes: sign is +1 or -1.
   */
  template <int dim>
  struct SignedPiece
  {
    double              sign;
    ConvexPolytope<dim> polytope;
  };

  /**
   * How a polytope lies to a shape; `part` is also said when unsure.
   */
  enum class Overlap
  {
    none,
    part,
    all
  };

  /**
   * The region a body fills at the start, and its rim.
   *
   * A shape knows its part of any convex polytope (a cell or sub-cell of the
   * mesh): exactly, but for round-off, for straight-sided shapes, discs,
   * spheres and their combinations in which at most one operand is curved in
   * a cell; to about 1e-9 of the polytope for cylinders; otherwise by
   * subdivision (see add_curved_pieces()).
   */
  template <int dim>
  class Shape
  {
  public:
    virtual ~Shape() = default;

    /**
     * Positive inside, zero on the boundary. For all shapes but expressions
     * the size never exceeds the distance to the boundary.
     */
    virtual double
    level(const dealii::Point<dim> &p) const = 0;

    /**
     * Whether @p p is strictly inside.
     */
    bool
    contains(const dealii::Point<dim> &p) const;

    /**
     * A box the shape fits in; without limits if the shape has none, or if
     * nothing better is known (expressions).
     */
    virtual dealii::BoundingBox<dim>
    bounding_box() const = 0;

    /**
     * Volume and centroid of shape and @p cell. The centroid lies in the
     * cell; it has no meaning where the volume is zero.
     */
    ClippedVolume<dim>
    clip(const ConvexPolytope<dim> &cell) const;

    /**
     * Quick and safe answer without clipping.
     */
    virtual Overlap
    overlap(const ConvexPolytope<dim> &cell) const;

    /**
     * Volume and first moment about @p reference of shape and @p cell.
     */
    VolumeMoments<dim>
    moments(const ConvexPolytope<dim> &cell,
            const dealii::Point<dim>  &reference) const;

    /**
     * Append polytopes whose sum, weighted with their signs, is @p sign times
     * shape and @p cell.
     */
    void
    add_pieces(const ConvexPolytope<dim>     &cell,
               const double                   sign,
               std::vector<SignedPiece<dim>> &pieces) const;

    /**
     * Whether add_pieces() is exact; no if not overridden.
     */
    virtual bool
    is_straight() const;

    /** Names of the parts of the rim; none if it is one whole. */
    virtual std::vector<std::string>
    parts() const;

    /**
     * The rim as a surface with the shape as its body, or the part of it called
     * @p part. Null if the shape has no rim. Rims of combined shapes end where
     * the other operand begins: exactly in 2D, to about 1e-6 of a cell on plane
     * sides in 3D, to a fraction of a cell on curved ones.
     */
    std::shared_ptr<const Surface<dim>>
    rim(const std::string &part = "") const;

    using Faces = std::vector<std::shared_ptr<const Surface<dim>>>;

    /**
     * Append the surfaces that make up a part, or the whole rim if @p part is
     * empty, as far as @p extent goes. The body is the shape if
     * @p body_inside, else what is around it.
     */
    virtual void
    add_faces(const std::string &part,
              const bool         body_inside,
              const Extent<dim> &extent,
              Faces             &faces) const = 0;

  protected:
    /**
     * moments() of a cell that the shape may cut. Without an override the
     * pieces are summed.
     */
    virtual VolumeMoments<dim>
    moments_of_part(const ConvexPolytope<dim> &cell,
                    const dealii::Point<dim>  &reference) const;

    /**
     * add_pieces() of a cell that the shape may cut.
     */
    virtual void
    add_pieces_of_part(const ConvexPolytope<dim>     &cell,
                       const double                   sign,
                       std::vector<SignedPiece<dim>> &pieces) const = 0;
  };

} // namespace moraine

#endif
