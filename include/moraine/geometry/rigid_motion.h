// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_rigid_motion_h
#define moraine_geometry_rigid_motion_h

#include <moraine/geometry/surface.h>

#include <functional>
#include <memory>

namespace moraine
{
  /**
   * A rigid placement x = c + t + R (X − c) of a reference point X.
   */
  template <int dim>
  class Pose
  {
  public:
    /** The identity. */
    Pose();

    /** Rotation by @p angle (radians; 3D: about the unit vector @p axis). */
    Pose(const dealii::Point<dim>     &centre,
         const dealii::Tensor<1, dim> &translation,
         const double                  angle,
         const dealii::Tensor<1, dim> &axis);

    /** Reference point to present place. */
    dealii::Point<dim>
    map(const dealii::Point<dim> &X) const;

    /** Present place to reference point. */
    dealii::Point<dim>
    inverse(const dealii::Point<dim> &x) const;

    /** A vector carried along: R v. */
    dealii::Tensor<1, dim>
    rotate(const dealii::Tensor<1, dim> &v) const;

    const dealii::Tensor<2, dim> &
    rotation() const;

  private:
    dealii::Point<dim>     centre;
    dealii::Tensor<1, dim> translation;
    dealii::Tensor<2, dim> matrix;
  };

  /**
   * Translation and rotation as functions of time. The rotation angle is in
   * degrees, counter-clockwise in 2D, by the right-hand rule about the axis
   * through the centre in 3D. Functions left empty mean zero.
   */
  template <int dim>
  class RigidMotion
  {
  public:
    using Curve = std::function<double(const double)>;

    RigidMotion() = default;

    /** Throws InputError if a rotation in 3D has a zero axis. */
    RigidMotion(const std::array<Curve, dim> &translation,
                const Curve                  &angle  = Curve(),
                const dealii::Point<dim>     &centre = dealii::Point<dim>(),
                const dealii::Tensor<1, dim> &axis =
                  dealii::Point<dim>::unit_vector(dim - 1));

    /** Throws InputError naming t when an expression is not a number there. */
    Pose<dim>
    pose(const double t) const;

    /** Whether anything was prescribed at all. */
    bool
    moves() const;

    /** Whether a rotation was, be its angle zero. */
    bool
    turns() const
    {
      return static_cast<bool>(angle);
    }

    /**
     * The moment of a force @p f at @p x about the axis of rotation where it is
     * at @p t [force length].
     */
    double
    moment(const dealii::Point<dim>     &x,
           const dealii::Tensor<1, dim> &f,
           const double                  t) const;

  private:
    std::array<Curve, dim> translation;
    Curve                  angle;
    dealii::Point<dim>     centre;
    dealii::Tensor<1, dim> axis;
  };

  /**
   * A surface in its present place. Answers in present coordinates by asking
   * the reference surface in its own frame.
   */
  template <int dim>
  class MovedSurface : public Surface<dim>
  {
  public:
    MovedSurface(std::shared_ptr<const Surface<dim>> reference,
                 const Pose<dim>                    &pose = Pose<dim>());

    void
    set_pose(const Pose<dim> &pose);

    const Pose<dim> &
    pose() const;

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
    std::shared_ptr<const Surface<dim>> reference;
    Pose<dim>                           present;
  };
} // namespace moraine

#endif
