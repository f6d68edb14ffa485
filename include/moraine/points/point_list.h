// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_point_list_h
#define moraine_points_point_list_h

#include <moraine/geometry/shape_library.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <string>
#include <vector>

namespace moraine
{
  /** Material points given one by one, wherever the cells of the mesh are. */
  template <int dim>
  struct PointList
  {
    std::vector<dealii::Point<dim>> positions;
    std::vector<double>             volumes;

    /** Names of further columns, and their values point by point. */
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> column_values;

    /** Half the edges of the parallelepiped each point stands for, as columns
     * [length]; zero if nothing is known of it but its volume. */
    dealii::Tensor<2, dim> half_edges;

    /** What point i is for the user, for messages. */
    std::function<std::string(const unsigned int i)> origin;
  };

  /**
   * The points of a CSV file: a header `x,y,volume` (3D: `x,y,z,volume`) and,
   * if wanted, names of more columns, which points carry along; then one point
   * per row. Empty lines and a byte-order mark are skipped. The origin of a
   * point is file and line.
   *
   * Throws InputError, with file and line, for a header that is different, a
   * row with a wrong number of values, a value that is not a finite number, a
   * volume that is not > 0, and a file without points.
   */
  template <int dim>
  PointList<dim>
  read_point_file(const std::string &file_name);

  /** The middles of n[d] equal parts in each direction d of a box, turned and
   * moved with it; their origin is @p section. */
  template <int dim>
  PointList<dim>
  make_point_grid(const ShapeParameters<dim>      &box,
                  const std::vector<unsigned int> &n,
                  const std::string               &section);
} // namespace moraine

#endif
