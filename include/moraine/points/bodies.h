// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_bodies_h
#define moraine_points_bodies_h

#include <moraine/points/point_list.h>
#include <moraine/points/point_set.h>
#include <moraine/points/seeding.h>
#include <moraine/geometry/shape.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /** A body before it is points. */
  template <int dim>
  struct Body
  {
    /** Points fill what @p shape covers of the cells. */
    Body(const std::string                       &name,
         const std::shared_ptr<const Shape<dim>> &shape)
      : name(name)
      , shape(shape)
    {}

    /** The points are given, and fill @p outline if that is not null. */
    Body(const std::string                       &name,
         const PointList<dim>                    &listed,
         const std::shared_ptr<const Shape<dim>> &outline = nullptr)
      : name(name)
      , listed(listed)
      , outline(outline)
    {}

    /** What it fills; null if that is not known. */
    const std::shared_ptr<const Shape<dim>> &
    filled() const
    {
      return shape ? shape : outline;
    }

    std::string                       name;
    std::shared_ptr<const Shape<dim>> shape; ///< null if the points are given
    PointList<dim>                    listed;
    std::shared_ptr<const Shape<dim>> outline; ///< of the points given
    double volume = 0; ///< of its points at first, if somebody counted
  };



  /** By body; null if the points are given. */
  template <int dim>
  using ShapesOfBodies = std::vector<std::shared_ptr<const Shape<dim>>>;

  template <int dim>
  ShapesOfBodies<dim>
  shapes_of(const std::vector<Body<dim>> &bodies)
  {
    ShapesOfBodies<dim> shapes;
    for (const Body<dim> &body : bodies)
      shapes.push_back(body.shape);
    return shapes;
  }

  /**
   * A field of points for each further column of a point file, for output; call
   * it when all other fields are there.
   * @throws InputError for a column that has the name of one of them.
   */
  template <int dim>
  void
  request_columns(const std::vector<Body<dim>> &bodies, PointFields &fields);

  /**
   * Put the points of all bodies into an empty @p points: those that @p seeder
   * gives the cells a shape covers, and those listed. A point's body is the
   * index in @p bodies. Its id counts the points that cells may have, then the
   * listed ones, so it does not depend on the number of ranks. Collective.
   *
   * Bodies may share volume if @p meet says of their numbers that they are
   * never there at the same time.
   *
   * @return the volumes of the bodies, over all ranks. That of a straight-sided
   * body is exact but for round-off.
   * @throws InputError if shapes overlap, a listed point lies outside the mesh
   * or is given twice, a body has no point, or a bounded shape lies partly
   * outside the mesh.
   */
  template <int dim>
  std::vector<double>
  seed_bodies(
    const std::vector<Body<dim>>                              &bodies,
    const CellSeeder<dim>                                     &seeder,
    PointSet<dim>                                             &points,
    const std::function<bool(const unsigned, const unsigned)> &meet = {});
} // namespace moraine

#endif
