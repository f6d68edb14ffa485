// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shape_library_h
#define moraine_geometry_shape_library_h

#include <moraine/geometry/shape.h>
#include <moraine/geometry/shape_parameters.h>

#include <map>
#include <string>

namespace moraine
{
  template <int dim>
  using NamedShapes = std::map<std::string, ShapePointer<dim>>;

  /**
   * The shape described by @p parameters, with its rotation and translation;
   * null for a point file. Operands are looked up in @p known. Throws
   * InputError for missing, superfluous and impossible values.
   */
  template <int dim>
  ShapePointer<dim>
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
   * The rim of one of @p bodies, of a shape of its own, or a part of it. Throws
   * InputError for entries that are missing, wrong, or that this kind of
   * surface does not use.
   */
  template <int dim>
  SurfacePointer<dim>
  make_surface(const SurfaceParameters<dim> &parameters,
               const NamedShapes<dim>       &bodies,
               const std::string            &section);

  /** Rotation and translation of a body. */
  template <int dim>
  Placement<dim>
  make_placement(const ShapeParameters<dim> &parameters,
                 const std::string          &section);
} // namespace moraine

#endif
