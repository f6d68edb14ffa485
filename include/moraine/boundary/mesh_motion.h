// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_mesh_motion_h
#define moraine_boundary_mesh_motion_h

#include <moraine/geometry/placement.h>

#include <functional>
#include <optional>

namespace moraine
{
  /**
   * How the mesh moves between two steps so that sides of it stay with
   * prescribed boundaries (the moving mesh concept of Beuth 2012; Wang et al.
   * 2018): as a rigid body with one boundary, or stretched uniformly between
   * two.
   */
  template <int dim>
  class MeshMotion
  {
  public:
    /** A boundary that the mesh goes with. */
    struct Master
    {
      /** In the middle of the boundary at the start. */
      dealii::Point<dim> place;
      RigidMotion<dim>   motion;
      /** Displacement on top of the motion, of time; the same everywhere. */
      std::function<dealii::Tensor<1, dim>(const double)> displacement;

      /** Where what is at @p x at @p t_start is at @p t_end. */
      dealii::Point<dim>
      map(const dealii::Point<dim> &x,
          const double              t_start,
          const double              t_end) const;
    };

    /** No motion. */
    MeshMotion() = default;

    /** Go with @p master. */
    explicit MeshMotion(const Master &master);

    /**
     * Places are those at @p t_0. Stretch along the line between the places of
     * two boundaries,
     * @f$x \leftarrow x + (1-s)\, d_A + s\, d_B@f$ with
     * @f$s = (x - x_A)\cdot e\,/\,(x_B - x_A)\cdot e@f$.
     */
    MeshMotion(const Master &A, const Master &B, const double t_0);

    bool
    moves() const
    {
      return first.has_value();
    }

    /** Where a place of the mesh, @p x at @p t_start, is at @p t_end. */
    dealii::Point<dim>
    map(const dealii::Point<dim> &x,
        const double              t_start,
        const double              t_end) const;

  private:
    std::optional<Master>  first;
    std::optional<Master>  second;
    double                 t_0 = 0;
    dealii::Tensor<1, dim> direction;
  };
} // namespace moraine

#endif
