// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_make_mesh_h
#define moraine_mesh_make_mesh_h

#include <moraine/mesh/mesh_parameters.h>
#include <moraine/mesh/mesh_sides.h>

#include <deal.II/grid/tria.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * Fill the empty @p triangulation with the cells of a generator or a file,
   * refined and extruded as asked for, on one level and without manifolds.
   *
   * @throws InputError for generators and arguments that do not exist, files
   * that cannot be read, cells that are no quadrilaterals or hexahedra or are
   * turned inside out at a corner, and wrong side names.
   */
  template <int dim>
  MeshSides
  make_mesh(const MeshParameters<dim>  &parameters,
            dealii::Triangulation<dim> &triangulation);

  /** Names of groups of cells, and their material ids. */
  using CellGroups =
    std::vector<std::pair<std::string, dealii::types::material_id>>;

  /** The physical groups of @p cells that came from a file of gmsh: by their
   * names, those without one by their number. Other meshes have none. */
  template <int dim>
  CellGroups
  groups_of_cells(const MeshParameters<dim>        &parameters,
                  const dealii::Triangulation<dim> &cells);

  /**
   * Refuse @p n cells that do not fit into the memory.
   *
   * @throws InputError naming @p where, section and key.
   */
  template <int dim>
  void
  require_memory_for_cells(const double n, const std::string &where);

  /**
   * The centre of a cell whose Jacobian is not positive at one of its corners
   * if its vertex number v (of the mesh) is at @p vertices[v]; nothing if there
   * is none.
   */
  template <int dim>
  std::optional<dealii::Point<dim>>
  find_inverted_cell(const dealii::Triangulation<dim>      &triangulation,
                     const std::vector<dealii::Point<dim>> &vertices);
} // namespace moraine

#endif
