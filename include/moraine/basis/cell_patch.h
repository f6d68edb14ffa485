// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_cell_patch_h
#define moraine_basis_cell_patch_h

#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/cell_inverse.h>

#include <limits>
#include <vector>

namespace moraine
{
  /** The place in a box mesh of the cell that holds @p x, or is nearest to it.
   */
  template <int dim>
  std::array<unsigned int, dim>
  place_in(const BoxGrid<dim> &grid, const dealii::Point<dim> &x);



  /** Which cells touch which: a list of the cells at each vertex, or of the
   * cells of a box by their place in it. */
  template <int dim>
  class CellNeighbours
  {
  public:
    using CellIterator =
      typename dealii::Triangulation<dim>::active_cell_iterator;
    static constexpr unsigned int no_cell =
      std::numeric_limits<unsigned int>::max();

    explicit CellNeighbours(const BackgroundMesh<dim> &mesh);

    /** Renew the lists if the mesh is a box no longer, or again. */
    void
    update();

    const BackgroundMesh<dim> &
    mesh() const
    {
      return background;
    }

    const CellIterator &
    cell(const unsigned int active_cell_index) const
    {
      return cells[active_cell_index];
    }

    /** Cells at the vertices of @p cell, itself first, each once. */
    void
    find(const CellIterator &cell, std::vector<unsigned int> &found) const;

    /** active_cell_index() of the cell of a box at a place @p ijk in it. */
    unsigned int
    box_cell(const std::array<unsigned int, dim> &ijk) const
    {
      return cell_of_box[box_number(ijk)];
    }

    /** A cell that holds @p x, looked for from @p start on; the end of the mesh
     * if it is outside. */
    CellIterator
    cell_around(const CellIterator &start, const dealii::Point<dim> &x) const;

    /** The same, or outside the mesh a cell at the vertex nearest to @p x. */
    CellIterator
    nearest_cell(const CellIterator &start, const dealii::Point<dim> &x) const;

  private:
    unsigned int
    box_number(const std::array<unsigned int, dim> &ijk) const;

    const BackgroundMesh<dim> &background;
    bool                       is_box;
    std::vector<CellIterator>  cells;
    std::vector<unsigned int>  first_at_vertex;
    std::vector<unsigned int>  cells_at_vertices;
    std::vector<unsigned int>  cell_of_box;
  };



  /**
   * A cell and the cells that touch it: the part of the mesh in which corners
   * of a point's domain are looked for, and the part of which the rank that
   * owns the point knows the nodes.
   */
  template <int dim>
  class CellPatch
  {
  public:
    using CellIterator = typename CellNeighbours<dim>::CellIterator;

    explicit CellPatch(const CellNeighbours<dim> &neighbours)
      : neighbours(neighbours)
    {}

    /** Go to the cell @p cell. */
    void
    reinit(const CellIterator &cell);

    /**
     * Find the cell of a place that belongs to a point in the patch's first
     * cell, and the values of that cell's functions there.
     *
     * A place on a face belongs to the cell on the point's side, chosen by the
     * place at a relative 1e-8 closer to the point. Outside the mesh the
     * functions of the nearest cell are continued linearly from the nearest
     * place @f$\bar x@f$ of the cell,
     * @f$N_a(\bar x) + \nabla N_a(\bar x) \cdot (x - \bar x)@f$, so that
     * @f$\sum_a N_a x_a = x@f$ there as well.
     *
     * @param centre where the point is
     * @param x the place
     * @param active_cell_index is set to the cell
     * @param N is set to the 2^dim values
     * @return false if the place is in the mesh, but not in the patch.
     */
    bool
    locate(const dealii::Point<dim> &centre,
           const dealii::Point<dim> &x,
           unsigned int             &active_cell_index,
           double                   *N) const;

  private:
    bool
    locate_in_box(const dealii::Point<dim> &inner,
                  const dealii::Point<dim> &x,
                  unsigned int             &active_cell_index,
                  double                   *N) const;

    /** The same for a place that is in no cell of the patch. */
    bool
    locate_outside(const dealii::Point<dim> &x,
                   unsigned int             &active_cell_index,
                   double                   *N) const;

    const CellNeighbours<dim>     &neighbours;
    std::vector<unsigned int>      cells;
    std::vector<CellVertices<dim>> vertices;
    std::vector<CellInverse<dim>>  inverses;
    std::array<unsigned int, dim>  place_in_box;
  };
} // namespace moraine

#endif
