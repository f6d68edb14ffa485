// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape_parameters.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/nearest.h>
#include <moraine/core/patterns.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <map>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::vector<ShapeEntry> &
    all_entries()
    {
      static const std::vector<ShapeEntry> entries{
        {"box", "between two corners", {"Lower corner", "Upper corner"}, {}},
        {"polygon",
         "a polygon in the x-y plane; in 3D the prism over it",
         {"Vertices", "Extent"},
         {}},
        {"disc", "(2D)", {"Centre", "Radius"}, {}},
        {"ring", "(2D)", {"Centre", "Radius", "Inner radius"}, {}},
        {"sphere", "(3D)", {"Centre", "Radius"}, {"Inner radius"}},
        {"cylinder",
         "(3D) solid or hollow",
         {"Axis start", "Axis end", "Radius"},
         {"Inner radius"}},
        {"half-space", "all behind a plane", {"Point", "Normal"}, {}},
        {"expression", "where it is positive", {"Expression"}, {}},
        {"mesh", "all cells of the mesh", {}, {}},
        {"union", "in any operand", {"Operands"}, {}},
        {"intersection", "in all operands", {"Operands"}, {}},
        {"difference", "in the first operand only", {"Operands"}, {}},
        {"points-from-file", "no shape: its points", {"Point file"}, {}}};
      return entries;
    }

    template <int dim>
    std::map<std::string, bool>
    given_keys(const ShapeParameters<dim> &p)
    {
      return {{"Lower corner", !p.lower_corner.empty()},
              {"Upper corner", !p.upper_corner.empty()},
              {"Vertices", !p.vertices.empty()},
              {"Extent", !p.extent.empty()},
              {"Centre", !p.centre.empty()},
              {"Radius", p.radius != 0.},
              {"Inner radius", p.inner_radius != 0.},
              {"Axis start", !p.axis_start.empty()},
              {"Axis end", !p.axis_end.empty()},
              {"Point", !p.point.empty()},
              {"Normal", !p.normal.empty()},
              {"Expression", !p.expression.empty()},
              {"Operands", !p.operands.empty()},
              {"Point file", !p.point_file.empty()}};
    }

    // rotation and translation
    template <int dim>
    void
    add_placement(ShapeParameters<dim> &p, ParameterHandler &prm)
    {
      prm.add_parameter("Rotation angle",
                        p.rotation_angle,
                        "Turns the body counter-clockwise [degrees]",
                        patterns::number());
      prm.add_parameter("Rotation centre",
                        p.rotation_centre,
                        "A point that the rotation leaves in place; the origin "
                        "if not set [length]",
                        patterns::numbers(0, dim));
      if (dim == 3)
        prm.add_parameter("Rotation axis",
                          p.rotation_axis,
                          "Direction of the axis of rotation; any length",
                          patterns::numbers(0, dim));
      prm.add_parameter("Translation",
                        p.translation,
                        "Moves the body after the rotation [length]",
                        patterns::numbers(0, dim));
    }
  } // namespace

  template <int dim>
  void
  ShapeParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    std::vector<std::string> names;
    std::string              text = "The region the body fills:";
    for (const auto &entry : shape_entries<dim>())
      {
        names.push_back(entry.name);
        text += " " + entry.name + " = " + entry.description + ";";
      }
    text.back()              = '.';
    const auto point_pattern = patterns::numbers(0, dim);
    prm.add_parameter("Shape", shape, text, patterns::selection(names));
    prm.add_parameter("Lower corner",
                      lower_corner,
                      "Smallest coordinates of a box [length]",
                      point_pattern);
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "Largest coordinates of a box [length]",
                      point_pattern);
    prm.add_parameter("Vertices",
                      vertices,
                      "Corners of a polygon in order, 'x y; x y; ...' "
                      "[length]. It may be non-convex but must not touch "
                      "itself",
                      patterns::NumberText());
    if (dim == 3)
      prm.add_parameter("Extent",
                        extent,
                        "Lower and upper z of the prism over a polygon "
                        "[length]",
                        patterns::numbers(0, 2));
    prm.add_parameter("Centre",
                      centre,
                      "Centre of a round shape [length]",
                      point_pattern);
    prm.add_parameter("Radius",
                      radius,
                      "(Outer) radius of a round shape [length]",
                      patterns::non_negative());
    prm.add_parameter("Inner radius",
                      inner_radius,
                      "Radius of the hole in a round shape [length]",
                      patterns::non_negative());
    if (dim == 3)
      {
        prm.add_parameter("Axis start",
                          axis_start,
                          "Centre of one end of a cylinder [length]",
                          point_pattern);
        prm.add_parameter("Axis end",
                          axis_end,
                          "Centre of the other end of a cylinder [length]",
                          point_pattern);
      }
    prm.add_parameter("Point",
                      point,
                      "A point on the plane that bounds a half-space [length]",
                      point_pattern);
    prm.add_parameter("Normal",
                      normal,
                      "Direction out of a half-space; any length",
                      point_pattern);
    prm.add_parameter("Expression",
                      expression,
                      "Positive inside the body; in x, y (and z), muParser "
                      "syntax. Details smaller than a point's share of its "
                      "cell may be missed");
    prm.add_parameter("Operands",
                      operands,
                      "Names of the bodies that a union, intersection or "
                      "difference is made from, as they are placed. These "
                      "bodies are not simulated themselves");
    prm.add_parameter("Point file",
                      point_file,
                      "CSV file with columns x, y (, z), volume and, if "
                      "wanted, more; its path is seen from the folder of the "
                      "scene");
    add_placement(*this, prm);
  }

  template <int dim>
  bool
  ShapeParameters<dim>::is_point_file() const
  {
    return shape == "points-from-file";
  }

  template <int dim>
  const std::vector<ShapeEntry> &
  shape_entries()
  {
    static const std::vector<ShapeEntry> entries = [] {
      const std::string       other = dim == 2 ? "(3D)" : "(2D)";
      std::vector<ShapeEntry> here;
      for (ShapeEntry entry : all_entries())
        if (entry.description.find(other) == std::string::npos)
          {
            if (dim == 2 && entry.name == "polygon")
              entry.needs = {"Vertices"};
            here.push_back(entry);
          }
      return here;
    }();
    return entries;
  }

  template <int dim>
  void
  check_keys(const ShapeParameters<dim> &p, const std::string &section)
  {
    std::vector<std::string> names;
    const ShapeEntry        *entry = nullptr;
    for (const auto &candidate : shape_entries<dim>())
      {
        names.push_back(candidate.name);
        if (candidate.name == p.shape)
          entry = &candidate;
      }
    if (entry == nullptr)
      throw InputError(place(section, "Shape") + ": found '" + p.shape +
                       "', not known in " + std::to_string(dim) + "D" +
                       suggest(p.shape, names));
    const auto has = [](const std::vector<std::string> &keys,
                        const std::string              &key) {
      return std::find(keys.begin(), keys.end(), key) != keys.end();
    };
    for (const auto &[key, given] : given_keys(p))
      {
        if (!given && has(entry->needs, key))
          throw InputError(place(section, key) +
                           ": not set, or zero. The shape '" + p.shape +
                           "' needs: " + list_of(entry->needs));
        if (given && !has(entry->needs, key) && !has(entry->may_have, key))
          throw InputError(
            place(section, key) + ": set, but the shape '" + p.shape +
            "' does not use it. It uses: " + list_of(entry->needs) +
            (entry->may_have.empty() ?
               "" :
               " and, if wanted, " + list_of(entry->may_have)));
      }
  }

#define INSTANTIATE(dim)                                        \
  template struct ShapeParameters<dim>;                         \
  template const std::vector<ShapeEntry> &shape_entries<dim>(); \
  template void check_keys(const ShapeParameters<dim> &, const std::string &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
