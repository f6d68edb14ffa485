// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_surface_library_h
#define moraine_geometry_surface_library_h

#include <moraine/geometry/surface.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace moraine
{
  /**
   * What the user says about one surface. Texts left empty were not given;
   * make_surface() tells which ones a kind needs and which it refuses.
   */
  template <int dim>
  struct SurfaceParameters
  {
    std::string surface = dim == 2 ? "polyline" : "plane patch";
    std::string points;
    std::string centre;
    std::string radius;
    std::string start_angle;
    std::string end_angle;
    std::string point;
    std::string normal;
    std::string axis_start;
    std::string axis_end;
    std::string body_side;
    std::string expression;
    std::string lower_corner;
    std::string upper_corner;
    bool        flip = false;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /**
   * Make the surface described. @p section names the input section in messages.
   * Throws InputError for entries that are missing, wrong, or that this kind
   * of surface does not use.
   */
  template <int dim>
  std::unique_ptr<Surface<dim>>
  make_surface(const SurfaceParameters<dim> &parameters,
               const std::string            &section);
} // namespace moraine

#endif
