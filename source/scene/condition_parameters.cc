// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/condition_parameters.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Point<dim>
  point_from(const std::vector<double> &numbers, const std::string &place)
  {
    if (numbers.size() != dim)
      throw InputError(place + ": found " + std::to_string(numbers.size()) +
                       " numbers, allowed: " + std::to_string(dim));
    Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = numbers[d];
    return point;
  }



  template <int dim>
  void
  MotionParameters<dim>::add_parameters(ParameterHandler  &prm,
                                        const std::string &what)
  {
    prm.add_parameter("Translation",
                      translation,
                      "Motion of " + what +
                        " and of the material it holds (length), dim "
                        "expressions in t or tables 't: d, t: d, ...' "
                        "separated by ';'.");
    prm.add_parameter("Rotation angle",
                      rotation_angle,
                      "Rotation of " + what +
                        " (degrees), an expression in t or a table; a change "
                        "moves the material. history.csv then has the moment "
                        "about the axis, at small strain in the places at the "
                        "start of the step, where forces balance.");
    prm.add_parameter("Rotation centre",
                      rotation_centre,
                      "Point of the axis of rotation; the origin if left out.",
                      patterns::numbers(0, dim));
    prm.add_parameter(
      "Rotation axis",
      rotation_axis,
      "In 3D: direction of the axis of rotation; z if left out.",
      patterns::numbers(0, 3));
  }



  template <int dim>
  RigidMotion<dim>
  MotionParameters<dim>::make_motion(
    const std::string                                 &section,
    const std::function<Tensor<1, dim>(const double)> &displacement) const
  {
    using Curve = typename RigidMotion<dim>::Curve;
    std::array<Curve, dim> shift;
    if (!translation.empty())
      {
        const auto curves =
          time_curves(translation, place(section, "Translation"), dim);
        for (unsigned int d = 0; d < dim; ++d)
          shift[d] = [curve = curves[d]](const double t) {
            return curve.value(t);
          };
      }
    if (displacement)
      for (unsigned int d = 0; d < dim; ++d)
        shift[d] = [given = shift[d], displacement, d](const double t) {
          return (given ? given(t) : 0.) + displacement(t)[d];
        };
    Curve angle;
    if (!rotation_angle.empty())
      angle = [curve =
                 TimeCurve(rotation_angle, place(section, "Rotation angle"))](
                const double t) { return curve.value(t); };
    Point<dim> centre;
    if (!rotation_centre.empty())
      centre =
        point_from<dim>(rotation_centre, place(section, "Rotation centre"));
    Tensor<1, dim> axis = Point<dim>::unit_vector(dim - 1);
    if (dim == 2 && !rotation_axis.empty())
      reject(section,
             "Rotation axis",
             Patterns::Tools::to_string(rotation_axis),
             "nothing in 2D, where it turns in the plane");
    if (!rotation_axis.empty())
      axis = point_from<dim>(rotation_axis, place(section, "Rotation axis"));
    return RigidMotion<dim>(shift, angle, centre, axis);
  }



  template <int dim>
  void
  BoundaryParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    surface.add_parameters(prm);
    prm.add_parameter(
      "Constraint",
      constraint,
      "fixed: all components. roller: the component normal to "
      "the surface. components: those of key 'Components'. "
      "absorbing: dashpots, and springs if wanted, that swallow "
      "waves, in dynamics; the material carries its places. "
      "contact: the rims of bodies touch the surface, separate and "
      "slide with friction; 'Band width' is 0.05 if it is left out.",
      patterns::selection(
        {"fixed", "roller", "components", "absorbing", "contact"}));
    prm.add_parameter("Components",
                      components,
                      "Of 'components': which, as x, y or x, y.",
                      patterns::several_of({"x", "y", "z"}));
    prm.add_parameter(
      "Displacement",
      displacement,
      "Displacement of the surface and of the material it holds since it began "
      "to act (length), dim expressions in t separated by ';'; 0 at the start. "
      "With 'Mesh after step = keep', where surfaces stay, also in x, y, z.");
    motion.add_parameters(prm, "the surface");
    prm.add_parameter(
      "Penetration limit",
      penetration_limit,
      "Largest depth a point may end behind the surface, in cell sizes; a step "
      "that goes deeper is rejected and halved. 0: no limit, only reported.",
      patterns::non_negative());
    enforcement.add_parameters(prm);
    absorbing.add_parameters(prm);
    contact.add_parameters(prm);
  }



  template <int dim>
  void
  GridConditionParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Side",
                      side,
                      dim == 2 ?
                        "A side of the mesh: left, right, bottom, top of a "
                        "box; else a name of 'Side names' or a number." :
                        "A side of the mesh: left, right (x), front, back (y), "
                        "bottom, top (z) of a box; else a name of 'Side "
                        "names', a number, or bottom and top of what is "
                        "extruded.");
    prm.add_parameter(
      "Lower corner",
      lower_corner,
      "With 'Upper corner': the nodes in this box of the mesh as it was built, "
      "instead of or within a side.",
      patterns::numbers(0, dim));
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "See 'Lower corner'.",
                      patterns::numbers(0, dim));
    prm.add_parameter(
      "Components",
      components,
      "Components that are prescribed, as x, y; all if left out.",
      patterns::several_of({"x", "y", "z"}));
    prm.add_parameter("Displacement",
                      displacement,
                      "Prescribed displacement (length), dim expressions in x, "
                      "y, z, t separated by ';', x where the node is in the "
                      "mesh as it was built; zero if left out. Its change over "
                      "time acts; it is 0 at the start.");
    motion.add_parameters(prm, "the nodes");
    prm.add_parameter("Constraint",
                      constraint,
                      "fixed: the components that are prescribed. absorbing: "
                      "dashpots, and springs if wanted, on a side, that "
                      "swallow waves, in dynamics.",
                      patterns::selection({"fixed", "absorbing"}));
    absorbing.add_parameters(prm);
  }



  template <int dim>
  void
  LoadParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Type",
      type,
      "body force (force/volume that the material has at the start of a step), "
      "gravity (acceleration, times density: its mass stays), surface "
      "traction (force on a surface carried by the material, a dead load per "
      "area of the undeformed body), side traction (the same on the material "
      "that is at a side of the mesh), pressure (on such a side or surface: "
      "pushes against it; with finite strain area and normal are those of the "
      "end of the step), point force (force "
      "at a place that the mesh carries along), force on points (force on the "
      "material points nearest to a place at the start).",
      patterns::selection({"body force",
                           "gravity",
                           "side traction",
                           "surface traction",
                           "pressure",
                           "point force",
                           "force on points"}));
    prm.add_parameter("Value",
                      value,
                      "dim expressions in x, y, z, t separated by ';'; of "
                      "pressure one.");
    prm.add_parameter(
      "Curve",
      curve,
      "Factor over time: an expression in t or a table 't: f, t: "
      "f, ...'; 1 if left out.");
    prm.add_parameter("Bodies",
                      bodies,
                      "Of body force and gravity: names of the bodies; all if "
                      "left out.");
    prm.add_parameter("Coordinates",
                      coordinates,
                      "Of body force and gravity: whether x, y, z of 'Value' "
                      "are where the material is at the start of a step "
                      "(current) or where it was at "
                      "the start of the run (original).",
                      patterns::selection({"current", "original"}));
    prm.add_parameter("Side",
                      side,
                      "Of side traction and pressure: a side of the mesh.");
    prm.add_parameter("Location",
                      location,
                      "Of point force and force on points: where it acts at "
                      "the start.",
                      patterns::numbers(0, dim));
    surface.add_parameters(prm);
  }



  template Point<2>
  point_from(const std::vector<double> &, const std::string &);
  template Point<3>
  point_from(const std::vector<double> &, const std::string &);
  template struct MotionParameters<2>;
  template struct MotionParameters<3>;
  template struct BoundaryParameters<2>;
  template struct BoundaryParameters<3>;
  template struct GridConditionParameters<2>;
  template struct GridConditionParameters<3>;
  template struct LoadParameters<2>;
  template struct LoadParameters<3>;
} // namespace moraine
