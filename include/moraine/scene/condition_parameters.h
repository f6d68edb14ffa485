// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_condition_parameters_h
#define moraine_scene_condition_parameters_h

#include <moraine/boundary/enforcement.h>
#include <moraine/geometry/placement.h>
#include <moraine/geometry/shape_library.h>
#include <moraine/scene/absorbing_parameters.h>
#include <moraine/scene/contact_parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <vector>

namespace moraine
{
  /** The dim numbers of a key, named by @p place, as a point. */
  template <int dim>
  dealii::Point<dim>
  point_from(const std::vector<double> &numbers, const std::string &place);

  /** How a boundary or a grid condition moves as a rigid body. */
  template <int dim>
  struct MotionParameters
  {
    std::string         translation;
    std::string         rotation_angle;
    std::vector<double> rotation_centre;
    std::vector<double> rotation_axis;

    /** @p what moves, in the words of the key texts. */
    void
    add_parameters(dealii::ParameterHandler &prm, const std::string &what);

    /** The motion, with @p displacement on top of it if that is given.
     * @throw InputError for what is no motion in section @p section. */
    RigidMotion<dim>
    make_motion(const std::string &section,
                const std::function<dealii::Tensor<1, dim>(const double)>
                  &displacement = {}) const;
  };

  /** Section `Boundaries/<name>`. */
  template <int dim>
  struct BoundaryParameters
  {
    ShapeParameters<dim>  surface{ShapeUse::surface};
    EnforcementParameters enforcement;
    std::string           constraint = "fixed";
    std::string           components;
    std::string           displacement;
    MotionParameters<dim> motion;
    double                penetration_limit = 0;
    AbsorbingParameters   absorbing;
    ContactParameters     contact;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /** Section `Grid conditions/<name>`. */
  template <int dim>
  struct GridConditionParameters
  {
    std::string           constraint = "fixed";
    std::string           side;
    std::vector<double>   lower_corner;
    std::vector<double>   upper_corner;
    std::string           components;
    std::string           displacement;
    MotionParameters<dim> motion;
    AbsorbingParameters   absorbing;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /** Section `Loads/<name>`. */
  template <int dim>
  struct LoadParameters
  {
    std::string              type = "body force";
    std::string              value;
    std::string              curve;
    std::vector<std::string> bodies;
    std::string              coordinates = "current";
    std::string              side;
    std::vector<double>      location;
    ShapeParameters<dim>     surface{ShapeUse::surface};

    void
    add_parameters(dealii::ParameterHandler &prm);
  };
} // namespace moraine

#endif
