// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shape_library_h
#define moraine_geometry_shape_library_h

#include <moraine/geometry/combined_shapes.h>
#include <moraine/geometry/shape.h>
#include <moraine/geometry/shape_parameters.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  template <int dim>
  using NamedShapes = std::map<std::string, std::shared_ptr<const Shape<dim>>>;

  /**
   * The shape described by @p parameters, with its rotation and translation;
   * null for a point file. Operands are looked up in @p known. Throws
   * InputError for missing, superfluous and impossible values.
   */
  template <int dim>
  std::shared_ptr<const Shape<dim>>
  make_shape(const ShapeParameters<dim> &parameters,
             const NamedShapes<dim>     &known,
             const std::string          &section);

  /**
   * The shapes of all bodies, by name. An operand is the name of another body
   * of the list, before or after; it is used as placed there. Section names in
   * messages are @p section, a slash and the name.
   */
  template <int dim>
  NamedShapes<dim>
  make_shapes(const std::map<std::string, ShapeParameters<dim>> &bodies,
              const std::string                                 &section);

  /**
   * The numbers of a key as a point. Throws InputError, naming section and key,
   * unless there are dim of them.
   */
  template <int dim>
  dealii::Point<dim>
  to_point(const std::vector<double> &numbers,
           const std::string         &section,
           const std::string         &key);

  /** Rotation and translation of a body. */
  template <int dim>
  Placement<dim>
  make_placement(const ShapeParameters<dim> &parameters,
                 const std::string          &section);
} // namespace moraine

#endif
