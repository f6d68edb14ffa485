// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_surface_library_h
#define moraine_geometry_surface_library_h

#include <moraine/geometry/shape_library.h>
#include <moraine/geometry/surface.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <memory>
#include <string>

namespace moraine
{
  /**
   * What the user says about one surface: the rim of a body or a surface of its
   * own. make_surface() tells which keys a kind needs and which it refuses.
   */
  template <int dim>
  struct SurfaceParameters
  {
    /** The text of each key; empty if it was not given. */
    std::map<std::string, std::string> texts;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /**
   * Make the surface described; @p bodies are those whose rims it may be.
   * @p section names the input section in messages. Throws InputError for
   * entries that are missing, wrong, or that this kind of surface does not use.
   */
  template <int dim>
  std::shared_ptr<const Surface<dim>>
  make_surface(const SurfaceParameters<dim> &parameters,
               const NamedShapes<dim>       &bodies,
               const std::string            &section);
} // namespace moraine

#endif
