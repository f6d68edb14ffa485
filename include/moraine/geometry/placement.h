// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_placement_h
#define moraine_geometry_placement_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>

namespace moraine
{
  /** Half the width of a box without limits. */
  constexpr double unlimited_extent = 1e100;

  /** The box without limits. */
  template <int dim>
  dealii::BoundingBox<dim>
  unlimited_box();

  /** The intersection of two boxes; no width where they are apart. */
  template <int dim>
  dealii::BoundingBox<dim>
  intersection(const dealii::BoundingBox<dim> &a,
               const dealii::BoundingBox<dim> &b);

  /** Whether @p x is in the box made wider by @p margin [length] on all sides.
   */
  template <int dim>
  bool
  is_inside(const dealii::BoundingBox<dim> &box,
            const dealii::Point<dim>       &x,
            const double                    margin);

  /** Whether a box has limits in all directions. */
  template <int dim>
  bool
  is_finite(const dealii::BoundingBox<dim> &box);

  /** A rigid placement x = c + t + R (X − c) of a reference point X. */
  template <int dim>
  class Placement
  {
  public:
    /** The identity. */
    Placement() = default;

    /**
     * Rotate by @p degrees, counter-clockwise, about @p centre (in 3D by the
     * right-hand rule about the axis through it along @p axis, which need not
     * have unit length and is not used in 2D), then translate. Multiples of a
     * right angle about a coordinate axis are exact.
     */
    Placement(const double                  degrees,
              const dealii::Point<dim>     &centre,
              const dealii::Tensor<1, dim> &axis,
              const dealii::Tensor<1, dim> &translation);

    /** Reference point to present place. */
    dealii::Point<dim>
    map(const dealii::Point<dim> &X) const
    {
      return centre + translation + matrix * (X - centre);
    }

    /** Present place to reference point. */
    dealii::Point<dim>
    inverse(const dealii::Point<dim> &x) const
    {
      return centre + (x - centre - translation) * matrix;
    }

    /** The placement that undoes this one. */
    Placement
    inverse() const;

    /** A vector carried along: R v. */
    dealii::Tensor<1, dim>
    rotate(const dealii::Tensor<1, dim> &v) const
    {
      return matrix * v;
    }

    const dealii::Tensor<2, dim> &
    rotation() const
    {
      return matrix;
    }

    /** A box that holds @p box in its present place; without limits if that
     * is. */
    dealii::BoundingBox<dim>
    map(const dealii::BoundingBox<dim> &box) const;

  private:
    dealii::Point<dim>     centre;
    dealii::Tensor<1, dim> translation;
    dealii::Tensor<2, dim> matrix = dealii::unit_symmetric_tensor<dim>();
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
    Placement<dim>
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

    /** The moment of a force @p f at @p x about the axis of rotation where @p
     * pose puts it [force length]. */
    double
    moment(const dealii::Point<dim>     &x,
           const dealii::Tensor<1, dim> &f,
           const Placement<dim>         &pose) const;

  private:
    std::array<Curve, dim> translation;
    Curve                  angle;
    dealii::Point<dim>     centre;
    dealii::Tensor<1, dim> axis;
  };

  /** @p v, rotated by the smallest rotation that turns the unit vector @p from
   * to @p to. */
  template <int dim>
  dealii::Tensor<1, dim>
  turned(const dealii::Tensor<1, dim> &v,
         const dealii::Tensor<1, dim> &from,
         const dealii::Tensor<1, dim> &to)
  {
    if (1. + from * to < 1e-6)
      return v; // the other side of a blade: there is no one axis
    // 1 + W + W^2/(1 + cos), W = to (x) from - from (x) to
    const auto W = [&](const dealii::Tensor<1, dim> &w) {
      return (from * w) * to - (to * w) * from;
    };
    const dealii::Tensor<1, dim> first = W(v);
    return v + first + 1. / (1. + from * to) * W(first);
  }
} // namespace moraine

#endif
