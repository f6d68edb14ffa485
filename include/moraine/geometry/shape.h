// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shape_h
#define moraine_geometry_shape_h

#include <moraine/geometry/convex_polytope.h>
#include <moraine/geometry/surface.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
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

  template <int dim>
  using SignedPieces = std::vector<SignedPiece<dim>>;

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
   * The region a body fills at the start, and its rim. make_box() and others in
   * shapes.h give the shapes there are.
   *
   * A shape knows its part of any convex polytope (a cell or sub-cell of the
   * mesh): exactly, but for round-off, for straight-sided shapes, discs,
   * spheres, cylinders and their combinations in which at most one operand is
   * curved in a cell; otherwise by
   * subdivision (see add_curved_pieces()).
   */
  template <int dim>
  class Shape : public std::enable_shared_from_this<Shape<dim>>
  {
  public:
    virtual ~Shape() = default;

    /**
     * Positive inside, zero on the boundary. For all shapes but expressions
     * the size never exceeds the distance to the boundary.
     */
    virtual double
    level(const dealii::Point<dim> &p) const = 0;

    /** Whether @p p is strictly inside. */
    bool
    contains(const dealii::Point<dim> &p) const
    {
      return level(p) > 0.;
    }

    /**
     * A box the shape fits in; without limits if the shape has none, or if
     * nothing better is known (expressions).
     */
    const dealii::BoundingBox<dim> &
    bounding_box() const
    {
      return box;
    }

    /** Whether add_pieces() is exact. */
    bool
    is_straight() const
    {
      return straight;
    }

    /** Names of the parts of the rim; none if it is one whole. */
    const std::vector<std::string> &
    parts() const
    {
      return part_names;
    }

    /**
     * Volume and centroid of shape and @p cell. The centroid lies in the
     * cell; it has no meaning where the volume is zero.
     */
    ClippedVolume<dim>
    clip(const ConvexPolytope<dim> &cell) const;

    /** Quick and safe answer without clipping. */
    virtual Overlap
    overlap(const ConvexPolytope<dim> &cell) const;

    /** Volume and first moment about @p reference of shape and @p cell. */
    VolumeMoments<dim>
    moments(const ConvexPolytope<dim> &cell,
            const dealii::Point<dim>  &reference) const;

    /**
     * Append polytopes whose sum, weighted with their signs, is @p sign times
     * shape and @p cell.
     */
    void
    add_pieces(const ConvexPolytope<dim> &cell,
               const double               sign,
               SignedPieces<dim>         &pieces) const;

    /**
     * The rim as a surface with the shape as its body, or the part of it called
     * @p part, as far as @p extent goes; the body is around the shape if not
     * @p body_inside. Null if the shape has no rim. Rims of combined shapes end
     * where the other operand begins: exactly in 2D, to about 1e-6 of a cell on
     * plane sides in 3D, to a fraction of a cell on curved ones.
     */
    SurfacePointer<dim>
    rim(const std::string &part        = "",
        const bool         body_inside = true,
        const Extent<dim> &extent      = {}) const
    {
      return join(faces(part, body_inside, extent));
    }

    using Faces = std::vector<SurfacePointer<dim>>;

    /** The smooth surfaces that make up rim(). */
    virtual Faces
    faces(const std::string &part,
          const bool         body_inside,
          const Extent<dim> &extent) const = 0;

  protected:
    Shape(const dealii::BoundingBox<dim> &box,
          const bool                      straight,
          const std::vector<std::string> &part_names = {})
      : box(box)
      , straight(straight)
      , part_names(part_names)
    {}

    /**
     * moments() of a cell that the shape may cut. Without an override the
     * pieces are summed.
     */
    virtual VolumeMoments<dim>
    moments_of_part(const ConvexPolytope<dim> &cell,
                    const dealii::Point<dim>  &reference) const;

    /**
     * add_pieces() of a cell that the shape may cut. Without an override those
     * of add_curved_pieces() with the level as distance.
     */
    virtual void
    add_pieces_of_part(const ConvexPolytope<dim> &cell,
                       const double               sign,
                       SignedPieces<dim>         &pieces) const;

  private:
    dealii::BoundingBox<dim> box;
    bool                     straight;
    std::vector<std::string> part_names;
  };

  template <int dim>
  using ShapePointer = std::shared_ptr<const Shape<dim>>;

  /** A shape where a smooth function φ is positive. */
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

    /** Distance from φ = 0, an estimate for expressions, and outward normal. */
    virtual NearestPoint<dim>
    nearest(const dealii::Point<dim> &x) const = 0;

    typename Shape<dim>::Faces
    faces(const std::string &part,
          const bool         body_inside,
          const Extent<dim> &extent) const override;

  protected:
    SmoothShape(const dealii::BoundingBox<dim> &box)
      : Shape<dim>(box, false)
    {}
  };
} // namespace moraine

#endif
