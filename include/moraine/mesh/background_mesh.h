// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_background_mesh_h
#define moraine_mesh_background_mesh_h

#include <moraine/mesh/cell_map.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <deal.II/distributed/shared_tria.h>

#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_tools_cache.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Section `Mesh`: a box of equal cells, offset anywhere.
   */
  template <int dim>
  struct MeshParameters
  {
    dealii::Point<dim>        lower_corner;
    dealii::Point<dim>        upper_corner;
    std::vector<unsigned int> cells;
    double                    cell_size = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Number of cells in each direction.
     *
     * @throws InputError if the corners do not span a box, if none or both of
     * `Cells` and `Cell size` are given, or if the size does not divide the
     * box.
     */
    std::array<unsigned int, dim>
    n_cells() const;
  };

  /**
   * A box of equal cells described in closed form. Bases that need a regular
   * mesh ask for it.
   */
  template <int dim>
  struct BoxGrid
  {
    dealii::Point<dim>            lower_corner;
    dealii::Tensor<1, dim>        cell_size;
    std::array<unsigned int, dim> n_cells;
  };

  /**
   * The background mesh: a triangulation every process knows as a whole, with
   * each cell owned by one of them.
   */
  template <int dim>
  class BackgroundMesh
  {
  public:
    BackgroundMesh(const MeshParameters<dim> &parameters,
                   const MPI_Comm            &communicator);

    const dealii::parallel::shared::Triangulation<dim> &
    triangulation() const
    {
      return tria;
    }

    const dealii::Mapping<dim> &
    mapping() const
    {
      return q1_mapping;
    }

    /** Finds cells around places and vertices. */
    const dealii::GridTools::Cache<dim> &
    search_cache() const
    {
      return cache;
    }

    /** Set if the mesh is a box of equal cells. */
    const std::optional<BoxGrid<dim>> &
    box_grid() const
    {
      return box;
    }

    /**
     * Boundary id of the side called @p name: left, right (x), bottom, top (y;
     * in 3D y is front, back and z is bottom, top).
     *
     * @throws InputError naming @p place and the sides there are.
     */
    dealii::types::boundary_id
    boundary_id(const std::string &name, const std::string &place) const;

    /** Characteristic cell size: the largest edge of the largest cell. */
    double
    cell_size() const
    {
      return largest_edge;
    }

  private:
    dealii::parallel::shared::Triangulation<dim> tria;
    dealii::MappingQ1<dim>                       q1_mapping;
    dealii::GridTools::Cache<dim>                cache;
    std::optional<BoxGrid<dim>>                  box;
    std::vector<std::string>                     side_names;
    double                                       largest_edge = 0;
  };

  /** The vertices of a cell in deal.II's lexicographic order. */
  template <int dim, class CellIterator>
  CellVertices<dim>
  vertices_of(const CellIterator &cell)
  {
    CellVertices<dim> vertices;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      vertices[v] = cell->vertex(v);
    return vertices;
  }
} // namespace moraine

#endif
