// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_background_mesh_h
#define moraine_mesh_background_mesh_h

#include <moraine/core/simulation_state.h>
#include <moraine/mesh/cell_map.h>
#include <moraine/mesh/mesh_parameters.h>
#include <moraine/mesh/mesh_sides.h>
#include <moraine/mesh/straight_mapping.h>

#include <deal.II/base/point.h>

#include <deal.II/distributed/shared_tria.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/grid_tools_cache.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** A box of equal cells described in closed form. Bases that need a regular
   * mesh ask for it. */
  template <int dim>
  struct BoxGrid
  {
    dealii::Point<dim>            lower_corner;
    dealii::Tensor<1, dim>        cell_size;
    std::array<unsigned int, dim> n_cells;
  };

  /**
   * The background mesh: a triangulation every process knows as a whole, with
   * each cell owned by one of them. All cells are quadrilaterals or hexahedra
   * of one level, without hanging nodes, and have straight edges: the map to a
   * cell is the multilinear one of its vertices.
   */
  template <int dim>
  class BackgroundMesh : public StatePart
  {
  public:
    using CellIterator =
      typename dealii::Triangulation<dim>::active_cell_iterator;

    /**
     * Every process gets about the same number of cells.
     *
     * @throws InputError for a mesh that cannot be made; see make_mesh().
     */
    BackgroundMesh(const MeshParameters<dim> &parameters,
                   const MPI_Comm            &communicator);

    /**
     * Share the cells anew, so that the sums of @p work over the cells of each
     * process are about the same: each has a piece of a curve through all
     * cells. No work is negative, and not all of it zero. Call it before
     * anything is built on the mesh. Collective.
     */
    void
    share_cells(const std::function<double(const CellIterator &)> &work);

    /**
     * Move every vertex x to @p motion(x), the same on all ranks, and renew
     * what searches remember. A box stays one if all its edges only shift or
     * stretch. Points stay where they are and must be searched again
     * (PointSet::find_cells()), nodes are where their vertices are. Collective.
     *
     * @throws ComputationError if a cell would be turned inside out at a
     * corner, naming its centre; nothing has moved then.
     */
    void
    move_vertices(
      const std::function<dealii::Point<dim>(const dealii::Point<dim> &)>
        &motion);

    /** Data sets "mesh/...": where the vertices are. */
    void
    write(Archive &archive) const override;

    /** The cells must be those of the time of writing. */
    void
    read(const Archive &archive) override;

    /** @throws ComputationError as move_vertices() would. */
    void
    check_motion(
      const std::function<dealii::Point<dim>(const dealii::Point<dim> &)>
        &motion) const
    {
      moved_vertices(motion);
    }

    const dealii::parallel::shared::Triangulation<dim> &
    triangulation() const
    {
      return tria;
    }

    const dealii::Mapping<dim> &
    mapping() const
    {
      return cell_mapping;
    }

    /**
     * The cell that @p x is in, to 1e-10 of it, and its unit place there; the
     * first of several. Nothing beside the mesh, which takes no longer:
     * dealii::GridTools::find_active_cell_around_point() throws for each cell.
     */
    std::optional<std::pair<CellIterator, dealii::Point<dim>>>
    cell_around(const dealii::Point<dim> &x) const;

    /** Where the vertices were in the mesh as it was built. */
    const std::vector<dealii::Point<dim>> &
    built_vertices() const
    {
      return built.empty() ? tria.get_vertices() : built;
    }

    /** Finds cells and vertices near places. */
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
     * Boundary id of the side called @p name. A box has left, right (x), bottom
     * and top (y; in 3D y is front, back and z is bottom, top). Other meshes
     * have those of `Side names`, what is extruded has bottom and top besides,
     * and a side without name is called by its number.
     *
     * @throws InputError naming @p place and the sides there are.
     */
    dealii::types::boundary_id
    boundary_id(const std::string &name, const std::string &place) const
    {
      return sides.id_of(name, place);
    }

    /** Characteristic cell size: the largest edge of the largest cell. */
    double
    cell_size() const
    {
      return largest_edge;
    }

    /** How far round-off may part what is one place of the mesh: far from the
     * origin that of the coordinates. */
    double
    round_off() const
    {
      return std::max(1e-9 * largest_edge, std::ldexp(largest_coordinate, -43));
    }

  private:
    /** Where vertices go. @throws ComputationError if that inverts a cell. */
    std::vector<dealii::Point<dim>>
    moved_vertices(
      const std::function<dealii::Point<dim>(const dealii::Point<dim> &)>
        &motion) const;

    /** Before vertices move. */
    void
    keep_built_vertices()
    {
      if (built.empty())
        built = tria.get_vertices();
    }

    /** Put the cells in order along the curve. */
    void
    order_cells();

    /** Cut the curve; see share_cells(). */
    void
    cut_curve(const std::function<double(const CellIterator &)> &work);

    /** Find the largest edge and coordinate. */
    void
    measure_cells();

    dealii::parallel::shared::Triangulation<dim> tria;
    StraightMapping<dim>                         cell_mapping;
    dealii::GridTools::Cache<dim>                cache;
    std::optional<BoxGrid<dim>>                  box;
    std::array<unsigned int, dim> cells_of_box{}; ///< if it was made as one
    MeshSides                     sides;
    /** Cells in the order in which processes share them; empty on one. */
    std::vector<CellIterator> curve;
    double                    largest_edge = 0, largest_coordinate = 0;
    /** Empty if no vertex has moved. */
    std::vector<dealii::Point<dim>> built;
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

  /** The volume of a cell. That of deal.II, from products of coordinates, is
   * lost far from the origin. */
  template <class CellIterator>
  double
  volume_of_cell(const CellIterator &cell)
  {
    constexpr int                   dim = CellIterator::AccessorType::dimension;
    std::vector<dealii::Point<dim>> corners;
    std::vector<unsigned int>       numbers;
    for (const unsigned int v : cell->vertex_indices())
      {
        corners.emplace_back(cell->vertex(v) - cell->vertex(0));
        numbers.push_back(v);
      }
    return dealii::GridTools::cell_measure<dim>(corners, numbers);
  }

  /** The edge of a square or cube of its volume. pow() would round lengths
   * in other units differently. */
  template <class CellIterator>
  double
  edge_of_cell(const CellIterator &cell)
  {
    const double volume = volume_of_cell(cell);
    return CellIterator::AccessorType::dimension == 2 ? std::sqrt(volume) :
                                                        std::cbrt(volume);
  }
} // namespace moraine

#endif
