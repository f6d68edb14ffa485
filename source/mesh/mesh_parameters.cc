// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/mesh_parameters.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  MeshParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Type",
                      type,
                      "box: equal cells between two corners. generator: a mesh "
                      "of deal.II's GridGenerator. file: a mesh of gmsh.",
                      patterns::selection({"box", "generator", "file"}));
    prm.add_parameter("Lower corner",
                      lower_corner,
                      "Of a box: corner with the smallest coordinates "
                      "(length).");
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "Of a box: corner with the largest coordinates "
                      "(length).");
    prm.add_parameter("Cells",
                      cells,
                      "Of a box: number of cells in each direction. Give "
                      "either this or the cell size.",
                      Patterns::List(Patterns::Integer(1), 0, dim));
    prm.add_parameter("Cell size",
                      cell_size,
                      "Of a box: edge length of the cells (length); it has to "
                      "divide the box. Give either this or the number of "
                      "cells.",
                      Patterns::Double(0));
    prm.add_parameter("Generator",
                      generator,
                      "Of a generator: a name in deal.II's namespace "
                      "GridGenerator, as hyper_shell or plate_with_a_hole; a "
                      "wrong one is answered with all there are.");
    prm.add_parameter("Arguments",
                      arguments,
                      "Of a generator: all its arguments, separated by ':', as "
                      "0, 0 : 5 : 10 : 18 : true. Sides have different numbers "
                      "only if the argument 'colorize' is true.",
                      patterns::NumberText());
    prm.add_parameter("File",
                      file,
                      "Of a file: quadrilaterals or hexahedra in format 2 or 4 "
                      "of gmsh (.msh); its path is seen from the folder of the "
                      "scene.");
    prm.add_parameter("Refinements",
                      refinements,
                      "Of a generator or a file: how often all cells are "
                      "halved in each direction. New vertices lie on the curve "
                      "of the generator; the edges of cells are straight.",
                      patterns::integer_in_range(0, 12));
    prm.add_parameter("Side names",
                      side_names,
                      "Of a generator or a file: names for keys 'Side', as "
                      "hole: 1, outer: 2. The numbers are boundary ids of the "
                      "generator, physical curves or surfaces of gmsh; names "
                      "of gmsh's own physical groups need not be repeated. A "
                      "side without a name here is called by its number.");
    if (dim == 3)
      {
        prm.add_parameter("Extrusion layers",
                          extrusion_layers,
                          "Of a generator or a file: if not 0, the generator "
                          "or file is plane, and its cells are repeated this "
                          "often along z. Sides bottom (z = 0) and top are "
                          "added.",
                          patterns::integer_in_range(0, 1000000));
        prm.add_parameter("Extrusion height",
                          extrusion_height,
                          "See 'Extrusion layers': height of all layers "
                          "(length).",
                          patterns::non_negative());
      }
  }



  template <int dim>
  bool
  MeshParameters<dim>::uses(const std::string &key) const
  {
    const auto is_one_of = [&key](const std::vector<std::string> &keys) {
      return std::find(keys.begin(), keys.end(), key) != keys.end();
    };
    if (key == "Type")
      return true;
    if (is_one_of({"Lower corner", "Upper corner", "Cells", "Cell size"}))
      return is_box();
    if (is_one_of({"Generator", "Arguments"}))
      return type == "generator";
    if (key == "File")
      return type == "file";
    return !is_box();
  }



  template <int dim>
  void
  MeshParameters<dim>::check() const
  {
    if (is_box())
      {
        n_cells();
        return;
      }
    if (type == "generator" && generator.empty())
      throw InputError(place("Mesh", "Generator") +
                       ": not set, allowed: the name of a generator");
    if (type == "file" && file.empty())
      throw InputError(place("Mesh", "File") +
                       ": not set, allowed: the path of a .msh file");
    if (extrusion_layers == 0 && extrusion_height > 0)
      throw InputError(place("Mesh", "Extrusion layers") +
                       ": found 0, allowed with 'Extrusion height': a whole "
                       "number >= 1");
    if (extrusion_layers > 0 && extrusion_height == 0)
      throw InputError(place("Mesh", "Extrusion height") +
                       ": found 0, allowed with 'Extrusion layers': a number "
                       "> 0");
  }



  template <int dim>
  std::array<unsigned int, dim>
  MeshParameters<dim>::n_cells() const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!(upper_corner[d] > lower_corner[d]))
        {
          std::ostringstream message;
          message << "section 'Mesh', key 'Upper corner': found "
                  << upper_corner
                  << ", allowed: every coordinate larger than that of 'Lower "
                     "corner', which is "
                  << lower_corner;
          throw InputError(message.str());
        }
    if (cells.empty() == (cell_size == 0))
      throw InputError(
        cells.empty() ?
          "section 'Mesh': found neither 'Cells' nor 'Cell size', allowed: "
          "exactly one of them" :
          "section 'Mesh': found both 'Cells' and 'Cell size', allowed: exactly "
          "one of them");
    if (!cells.empty() && cells.size() != dim)
      throw InputError(
        "section 'Mesh', key 'Cells': found " + std::to_string(cells.size()) +
        " numbers, allowed: " + std::to_string(dim) + " (one per direction)");

    std::array<unsigned int, dim> n;
    for (unsigned int d = 0; d < dim; ++d)
      if (!cells.empty())
        n[d] = cells[d];
      else
        {
          const double ratio = (upper_corner[d] - lower_corner[d]) / cell_size;
          if (!(ratio < 1e8) ||
              std::abs(ratio - std::round(ratio)) >
                1e-6 * std::max(1., ratio) ||
              std::round(ratio) < 1)
            {
              std::ostringstream message;
              message << "section 'Mesh', key 'Cell size': found " << cell_size
                      << ", allowed: a size that divides the box; its edge "
                      << "along "
                      << "xyz"[d] << " is "
                      << upper_corner[d] - lower_corner[d];
              throw InputError(message.str());
            }
          n[d] = static_cast<unsigned int>(std::round(ratio));
        }
    return n;
  }



  template struct MeshParameters<2>;
  template struct MeshParameters<3>;
} // namespace moraine
