// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/background_mesh.h>

#include <moraine/core/exceptions.h>

#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  MeshParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Lower corner",
                      lower_corner,
                      "Corner of the mesh with the smallest coordinates "
                      "(length).");
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "Corner of the mesh with the largest coordinates "
                      "(length).");
    prm.add_parameter("Cells",
                      cells,
                      "Number of cells in each direction. Give either this or "
                      "the cell size.",
                      Patterns::List(Patterns::Integer(1), 0, dim));
    prm.add_parameter("Cell size",
                      cell_size,
                      "Edge length of the cells (length); it has to divide the "
                      "box. Give either this or the number of cells.",
                      Patterns::Double(0));
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



  template <int dim>
  BackgroundMesh<dim>::BackgroundMesh(const MeshParameters<dim> &parameters,
                                      const MPI_Comm            &communicator)
    : tria(communicator,
           Triangulation<dim>::none,
           false,
           parallel::shared::Triangulation<dim>::partition_zorder)
    , cache(tria, q1_mapping)
    , side_names(dim == 2 ?
                   std::vector<std::string>{"left", "right", "bottom", "top"} :
                   std::vector<std::string>{"left",
                                            "right",
                                            "front",
                                            "back",
                                            "bottom",
                                            "top"})
  {
    const auto n = parameters.n_cells();
    GridGenerator::subdivided_hyper_rectangle(
      tria,
      std::vector<unsigned int>(n.begin(), n.end()),
      parameters.lower_corner,
      parameters.upper_corner,
      true);

    BoxGrid<dim> grid;
    grid.lower_corner = parameters.lower_corner;
    grid.n_cells      = n;
    for (unsigned int d = 0; d < dim; ++d)
      {
        grid.cell_size[d] =
          (parameters.upper_corner[d] - parameters.lower_corner[d]) / n[d];
        largest_edge = std::max(largest_edge, grid.cell_size[d]);
      }
    box = grid;
  }



  template <int dim>
  types::boundary_id
  BackgroundMesh<dim>::boundary_id(const std::string &name,
                                   const std::string &place) const
  {
    std::string known;
    for (unsigned int id = 0; id < side_names.size(); ++id)
      {
        if (side_names[id] == name)
          return id;
        known += (id > 0 ? ", " : "") + side_names[id];
      }
    throw InputError(place + ": found '" + name +
                     "', allowed: a side of the mesh (" + known + ")");
  }



  template struct MeshParameters<2>;
  template struct MeshParameters<3>;
  template class BackgroundMesh<2>;
  template class BackgroundMesh<3>;
} // namespace moraine
