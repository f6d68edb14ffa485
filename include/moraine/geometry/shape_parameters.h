// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shape_parameters_h
#define moraine_geometry_shape_parameters_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /**
   * The shape of one body as the user gives it. Empty lists and zero numbers
   * mean: not given. A key that the shape does not use must not be given.
   */
  template <int dim>
  struct ShapeParameters
  {
    void
    add_parameters(dealii::ParameterHandler &prm);

    std::string shape = "box";

    std::vector<double>      lower_corner;
    std::vector<double>      upper_corner;
    std::string              vertices;
    std::vector<double>      extent;
    std::vector<double>      centre;
    double                   radius       = 0.;
    double                   inner_radius = 0.;
    std::vector<double>      axis_start;
    std::vector<double>      axis_end;
    std::vector<double>      point;
    std::vector<double>      normal;
    std::string              expression;
    std::vector<std::string> operands;
    std::string              point_file;

    double              rotation_angle = 0.;
    std::vector<double> rotation_centre;
    std::vector<double> rotation_axis;
    std::vector<double> translation;

    /**
     * Whether the body's points come from a file; it has no shape then.
     */
    bool
    is_point_file() const;
  };

  /**
   * A shape and what it is for the user: the value of `Shape` and the keys it
   * needs and may have.
   */
  struct ShapeEntry
  {
    std::string              name;
    std::string              description;
    std::vector<std::string> needs;
    std::vector<std::string> may_have;
  };

  /**
   * All shapes in this dimension.
   */
  template <int dim>
  const std::vector<ShapeEntry> &
  shape_entries();

  /**
   * Throws InputError unless the keys given are those of the shape; @p section
   * is named in messages.
   */
  template <int dim>
  void
  check_keys(const ShapeParameters<dim> &parameters,
             const std::string          &section);
} // namespace moraine

#endif
