// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_body_cover_h
#define moraine_points_body_cover_h

#include <moraine/points/bodies.h>
#include <moraine/points/point_set.h>

#include <vector>

namespace moraine
{
  /**
   * Which places bodies cover now, as far as the points in the cell of a place
   * tell: @f$x - u_p@f$ with the displacement of the nearest point of a body is
   * where the material was when the body was drawn. Where displacements in the
   * cell differ, or some were forgotten, the body counts as larger by that.
   */
  template <int dim>
  class BodyCover
  {
  public:
    /**
     * @param points must live as long as this
     * @param shapes of the bodies, and likewise; one that is null covers all
     * @param moved whether points move with their displacements
     * Collective.
     */
    BodyCover(const PointSet<dim>       &points,
              const ShapesOfBodies<dim> &shapes,
              const bool                 moved);

    /** Whether a body of the active cell @p cell covers @p x, or would if it
     * were larger by @p margin [length]. In a cell without points it is asked
     * as it was drawn, larger by the largest displacement of its points. */
    bool
    operator()(const unsigned int        cell,
               const dealii::Point<dim> &x,
               const double              margin) const;

  private:
    /** The same of the body with number @p body, which has points among those
     * from @p first to @p last. */
    bool
    covers(const unsigned int        body,
           const unsigned int        first,
           const unsigned int        last,
           const dealii::Point<dim> &x,
           const double              margin) const;

    dealii::Tensor<1, dim>
    displacement(const unsigned int p) const
    {
      return moved ? points->displacement_field()(points->values(p)) :
                     dealii::Tensor<1, dim>();
    }

    const PointSet<dim>       *points;
    const ShapesOfBodies<dim> *shapes;
    bool                       moved;
    /** Of the points of each body on all ranks; negative if it has none. */
    std::vector<double> largest_displacements;
  };
} // namespace moraine

#endif
