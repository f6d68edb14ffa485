// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shape_h
#define moraine_geometry_shape_h

#include <moraine/geometry/convex_polytope.h>
#include <moraine/geometry/placement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  template <int dim>
  class Shape;

  template <int dim>
  struct Extent;

  /** A quadrature point on a surface: its place, the unit normal pointing out
   * of the body (−∇φ), and its weight (length in 2D, area in 3D). */
  template <int dim>
  struct SurfacePoint
  {
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> normal;
    double                 JxW;
  };

  /** The direction of v, or any where v is zero. */
  template <int dim>
  dealii::Tensor<1, dim>
  unit_or_any(const dealii::Tensor<1, dim> &v)
  {
    const double length = v.norm();
    return length > 0. ? v / length : dealii::Point<dim>::unit_vector(0);
  }

  /** The largest distance of a vertex from the first one. */
  template <int dim>
  double
  cell_size(const CellVertices<dim> &cell)
  {
    double size = 0.;
    for (const auto &vertex : cell)
      size = std::max(size, vertex.distance(cell[0]));
    return size;
  }

  /** Largest absolute coordinate. */
  template <int dim>
  double
  coordinate_magnitude(const dealii::Point<dim> &x)
  {
    double magnitude = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      magnitude = std::max(magnitude, std::abs(x[d]));
    return magnitude;
  }

  /** What is known of the point of a surface nearest to a place. */
  template <int dim>
  struct NearestPoint
  {
    /** φ of the place, its signed distance. */
    double level;
    /** Unit normal there, out of the body. */
    dealii::Tensor<1, dim> normal;
    /** Whether the nearest point lies within the extent of the surface. */
    bool in_extent;
  };

  /**
   * A surface φ(x) = 0 with the body on the side φ > 0: the rim of a shape or a
   * part of it (see Shape::rim()), in its own frame. A MovedSurface places it
   * in space.
   */
  template <int dim>
  class Surface
  {
  public:
    virtual ~Surface() = default;

    /**
     * φ is positive on the body's side: the signed distance; for expressions
     * φ/|∇φ|, its first-order estimate. The normal −∇φ/|∇φ| means something at
     * or near the surface. @p length is the scale over which an expression is
     * seen (a cell's size); 0 where none is known: the coordinates' size.
     */
    virtual NearestPoint<dim>
    nearest(const dealii::Point<dim> &x, const double length = 0.) const = 0;

    double
    level(const dealii::Point<dim> &x) const
    {
      return nearest(x).level;
    }

    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const
    {
      return nearest(x).normal;
    }

    bool
    in_extent(const dealii::Point<dim> &x) const
    {
      return nearest(x).in_extent;
    }

    /**
     * Append quadrature points of the part of the surface inside one convex
     * cell. Points of a flat piece integrate polynomials of degree
     * 2 n_gauss − 1 exactly. A piece on a face shared by two cells belongs to
     * the cell on the body's side only, so the cells of a mesh share the
     * surface out without gap or overlap.
     */
    virtual void
    pieces(const CellVertices<dim>        &cell,
           const unsigned int              n_gauss,
           std::vector<SurfacePoint<dim>> &out) const = 0;

    /** The part of the surface within @p extent; null if pieces() cannot
     * cut that exactly. */
    virtual std::shared_ptr<const Surface<dim>>
    within(const Extent<dim> &extent) const
    {
      (void)extent;
      return nullptr;
    }

    /** A box that holds the surface; see unlimited_extent. */
    const dealii::BoundingBox<dim> &
    bounding_box() const
    {
      return box;
    }

    /** Whether a cell comes near the box at all; quick and on the safe side. */
    bool
    may_touch(const CellVertices<dim> &cell) const;

    /** Whether the normal changes along a smooth part of the surface. */
    bool
    curved() const
    {
      return is_curved;
    }

  protected:
    Surface(const dealii::BoundingBox<dim> &box, const bool is_curved)
      : box(box)
      , is_curved(is_curved)
    {}

    dealii::BoundingBox<dim> box;

  private:
    bool is_curved;
  };

  template <int dim>
  using SurfacePointer = std::shared_ptr<const Surface<dim>>;

  /** Part of a curve: from one value of its parameter to a larger one. */
  using Stretch = std::pair<double, double>;

  /** Where shapes end a surface that goes on beyond them: it keeps what is on
   * one side of each. */
  template <int dim>
  struct Extent
  {
    /** What a surface along the boundary of a shape counts as. */
    enum class Along
    {
      inner, ///< what lies just behind the surface, in its body
      outer, ///< what lies just before it
      never, ///< outside of the extent
      beside ///< within the extent, also at a distance up to its reach
    };

    struct Limit
    {
      std::shared_ptr<const Shape<dim>> shape;
      bool                              inside; ///< else outside of the shape
      Along                             along;
      double                            reach = 0; ///< [length] if beside
    };

    /**
     * Positive where a place @p x of a surface with unit normal @p normal is
     * within all limits, zero at the ends. Lengths below @p tolerance are
     * round-off.
     */
    double
    value(const dealii::Point<dim>     &x,
          const dealii::Tensor<1, dim> &normal,
          const double                  tolerance) const;

    /** Whether x is within the limits or at an end, up to round-off. */
    bool
    contains(const dealii::Point<dim>     &x,
             const dealii::Tensor<1, dim> &normal) const
    {
      const double tolerance = 1e-10 * coordinate_magnitude<dim>(x);
      return limits.empty() || value(x, normal, tolerance) >= -2. * tolerance;
    }

    /**
     * The parts within the limits of a piece of a curve, of which @p curve
     * gives place and unit normal. They are exact if they are not shorter than
     * a 32nd of the piece.
     */
    std::vector<Stretch>
    stretches(
      const Stretch &piece,
      const double   tolerance,
      const std::function<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>(
        double)>    &curve) const;

    /** The limits seen from the frame that @p placement puts in place. */
    Extent
    seen_from(const Placement<dim> &placement) const;

    /** The intersection with another extent. */
    Extent
    and_within(const Extent &other) const;

    std::vector<Limit> limits;

    /** Holds what is within the limits. */
    dealii::BoundingBox<dim> box = unlimited_box<dim>();
  };

  /** A surface in its present place. Answers in present coordinates by asking
   * the reference surface in its own frame. */
  template <int dim>
  class MovedSurface : public Surface<dim>
  {
  public:
    MovedSurface(const SurfacePointer<dim> &reference,
                 const Placement<dim>      &pose = Placement<dim>());

    void
    set_pose(const Placement<dim> &pose);

    /** From here on nearest() sees it over this length unless told another. */
    void
    see_over(const double length)
    {
      seen_over = length;
    }

    const Placement<dim> &
    pose() const
    {
      return present;
    }

    NearestPoint<dim>
    nearest(const dealii::Point<dim> &x,
            const double              length = 0.) const override;

    void
    pieces(const CellVertices<dim>        &cell,
           const unsigned int              n_gauss,
           std::vector<SurfacePoint<dim>> &out) const override;

    SurfacePointer<dim>
    within(const Extent<dim> &extent) const override;

    /**
     * How the normal changes with the place, @f$\nabla n@f$: 1 over the radii
     * of curvature along the surface; by central differences over a small part
     * of the length @p h. Zero at a corner.
     */
    dealii::SymmetricTensor<2, dim>
    normal_gradient(const dealii::Point<dim> &x, const double h) const;

  private:
    SurfacePointer<dim> reference;
    Placement<dim>      present;
    double              seen_over = 0;
  };

  /**
   * Several surfaces that bound one body together as one. Nearest is the one
   * whose nearest point is nearest among those within their extents; outside of
   * all, the one of the smallest |φ|. Null for none.
   */
  template <int dim>
  SurfacePointer<dim>
  join(const std::vector<SurfacePointer<dim>> &members);

  /** Volume and centroid of the part of a polytope inside a shape. */
  template <int dim>
  struct ClippedVolume
  {
    double             volume = 0.;
    dealii::Point<dim> centroid;
  };

  /** One term of a signed sum of polytopes: sign is +1 or -1. */
  template <int dim>
  struct SignedPiece
  {
    double              sign;
    ConvexPolytope<dim> polytope;
  };

  template <int dim>
  using SignedPieces = std::vector<SignedPiece<dim>>;

  /** How a polytope lies to a shape; `part` is also said when unsure. */
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

    /** Positive inside, zero on the boundary. For all shapes but expressions
     * the size never exceeds the distance to the boundary. */
    virtual double
    level(const dealii::Point<dim> &p) const = 0;

    /** Whether @p p is inside or nearer than @p margin, a length, to the
     * boundary; if negative: deeper inside than that. An estimate for
     * expressions, whose level is no length. */
    virtual bool
    covers(const dealii::Point<dim> &p, const double margin) const
    {
      return level(p) > -margin;
    }

    /** The level as a length: for expressions an estimate, up to a few times
     * @p length, the scale over which they are seen (a cell's size). */
    virtual double
    distance(const dealii::Point<dim> &p, const double length) const
    {
      (void)length;
      return level(p);
    }

    /** Whether distance() may exceed the distance to the boundary. */
    virtual bool
    estimates_distance() const
    {
      return false;
    }

    /** Whether @p p is strictly inside. */
    bool
    contains(const dealii::Point<dim> &p) const
    {
      return level(p) > 0.;
    }

    /** A box the shape fits in; without limits if the shape has none, or if
     * nothing better is known (expressions). */
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

    /** Volume and centroid of shape and @p cell. The centroid lies in the cell;
     * it has no meaning where the volume is zero. */
    ClippedVolume<dim>
    clip(const ConvexPolytope<dim> &cell) const;

    /** Quick and safe answer without clipping. */
    virtual Overlap
    overlap(const ConvexPolytope<dim> &cell) const;

    /** Volume and first moment about @p reference of shape and @p cell. */
    VolumeMoments<dim>
    moments(const ConvexPolytope<dim> &cell,
            const dealii::Point<dim>  &reference) const;

    /** Append polytopes whose sum, weighted with their signs, is @p sign times
     * shape and @p cell. */
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

    /** moments() of a cell that the shape may cut. Without an override the
     * pieces are summed. */
    virtual VolumeMoments<dim>
    moments_of_part(const ConvexPolytope<dim> &cell,
                    const dealii::Point<dim>  &reference) const;

    /** add_pieces() of a cell that the shape may cut. Without an override those
     * of add_curved_pieces() with the level as distance. */
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
    value(const dealii::Point<dim> &x) const
    {
      return this->level(x);
    }

    /** ∇φ; @p length is the scale over which φ is seen (a cell's size). */
    virtual dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x, const double length) const = 0;

    /** Distance from φ = 0, an estimate for expressions, and outward normal;
     * see Surface::nearest(). */
    virtual NearestPoint<dim>
    nearest(const dealii::Point<dim> &x, const double length) const = 0;

    /**
     * How far the normal of φ = 0 turns along each of the @p edges of a box
     * about @p middle [rad]: their lengths over the radius of curvature. An
     * estimate for expressions, at one place of the surface.
     */
    virtual std::array<double, dim>
    turns(const dealii::Point<dim>                      &middle,
          const std::array<dealii::Tensor<1, dim>, dim> &edges) const = 0;

    /**
     * Told that the smallest boxes into which the cell at @p x is halved are
     * too large for its surface. Throws InputError; expressions, which may have
     * edges, are taken as they are.
     */
    virtual void
    report_unresolved(const dealii::Point<dim> &x) const = 0;

    /**
     * Cut by dealii::NonMatching::QuadratureGenerator in the reference space of
     * the cell (φ composed with the cell's multilinear map). The number of
     * points sets its accuracy; it is not exact. Where the normal turns much
     * within a cell, it is halved first, five times in each direction at most:
     * areas are right to 1 % for radii from a tenth of a cell on. Cells across
     * the end of its extent are cut exactly if that is straight and follows the
     * cell's axes, else halved four times and their points chosen one by one.
     */
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
