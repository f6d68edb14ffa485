// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_grid_space_h
#define moraine_mesh_grid_space_h

#include <moraine/core/linear_algebra.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/ghosted_unknowns.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/hp/fe_collection.h>

#include <deal.II/lac/affine_constraints.h>

#include <limits>
#include <vector>

namespace moraine
{
  /**
   * The displacement unknowns on the active cells of the background mesh:
   * Q1 or Q2 there, nothing elsewhere, so that cells without material own no
   * unknowns.
   *
   * Work in loops uses *nodes*: places that carry dim consecutive unknowns,
   * numbered densely on each rank. A rank knows the nodes of the active cells
   * it owns, of the active cells that touch those, and of those it asked for.
   */
  template <int dim>
  class GridSpace : public StatePart
  {
  public:
    using CellIterator =
      typename dealii::Triangulation<dim>::active_cell_iterator;
    static constexpr unsigned int no_cell =
      std::numeric_limits<unsigned int>::max();

    /** Functions of @p degree 1 or 2. */
    GridSpace(const BackgroundMesh<dim> &mesh, const unsigned int degree);

    /**
     * Make the cells flagged on any rank active. Unknowns are renumbered only
     * if the set changed, nodes also if a rank flags a cell it does not know.
     *
     * @param active One flag for each active_cell_index() of the mesh.
     * @return whether unknowns or nodes changed. Collective.
     */
    bool
    set_active_cells(std::vector<unsigned char> active);

    bool
    is_active(const CellIterator &cell) const
    {
      return active_cells[cell->active_cell_index()] != 0;
    }

    /** (degree + 1)^dim. */
    unsigned int
    nodes_per_cell() const
    {
      return n_nodes_per_cell;
    }

    /** The nodes of an active cell of this rank or next to one, in
     * lexicographic order. */
    const unsigned int *
    cell_nodes(const CellIterator &cell) const
    {
      return cell_nodes(cell->active_cell_index());
    }

    const unsigned int *
    cell_nodes(const unsigned int active_cell_index) const
    {
      const unsigned int slot = cell_slot[active_cell_index];
      Assert(slot != no_cell, dealii::ExcInternalError());
      return &nodes_of_cells[slot * n_nodes_per_cell];
    }

    /** Whether cell_nodes() may be asked for. */
    bool
    knows(const CellIterator &cell) const
    {
      return knows(cell->active_cell_index());
    }

    bool
    knows(const unsigned int active_cell_index) const
    {
      return cell_slot[active_cell_index] != no_cell;
    }

    unsigned int
    n_nodes() const
    {
      return first_dof.size();
    }

    /** First of the dim consecutive unknowns of a node. */
    dealii::types::global_dof_index
    node_dof(const unsigned int node) const
    {
      return first_dof[node];
    }

    /** The vertices of the mesh in whose middle the node is. */
    dealii::ArrayView<const unsigned int>
    node_vertices(const unsigned int node) const
    {
      return {&vertices_of_nodes[first_vertex[node]],
              first_vertex[node + 1] - first_vertex[node]};
    }

    /**
     * Where the node is: in the middle of the vertex, edge, face or cell of the
     * mesh that it belongs to, and as far from there as move_nodes() says.
     */
    dealii::Point<dim>
    node_position(const unsigned int node) const
    {
      const dealii::Point<dim> x =
        middle_of_vertices(node, background.triangulation().get_vertices());
      return moves.empty() ? x : x + moves[node];
    }

    /** Where the node was in the mesh as it was built. */
    dealii::Point<dim>
    built_position(const unsigned int node) const
    {
      return middle_of_vertices(node, background.built_vertices());
    }

    /** How far move_nodes() has taken the node. */
    dealii::Tensor<1, dim>
    node_move(const unsigned int node) const
    {
      return moves.empty() ? dealii::Tensor<1, dim>() : moves[node];
    }

    /** Nodal values (node major) of an owned-only vector. Collective. */
    void
    node_values(const LA::Vector                    &vector,
                std::vector<dealii::Tensor<1, dim>> &values) const;

    /** The other way: the sums over all ranks of what each has at its nodes, in
     * an owned-only vector. Collective. */
    void
    sum_node_values(const std::vector<dealii::Tensor<1, dim>> &values,
                    LA::Vector                                &vector) const;

    /** The sums of what each rank has at its nodes take the place of it.
     * Collective. */
    void
    sum_over_ranks(std::vector<dealii::Tensor<1, dim>> &values) const;

    /** The owned unknowns of nodal values that all ranks agree on. */
    LA::Vector
    vector_of(const std::vector<dealii::Tensor<1, dim>> &values) const;

    /** A zero vector of the owned unknowns. */
    LA::Vector
    vector() const
    {
      return unknowns.zero_vector();
    }

    /** Move every node by its value in @p displacement; the mesh stays. */
    void
    move_nodes(const std::vector<dealii::Tensor<1, dim>> &displacement);

    /** Whether nodes are elsewhere than in the mesh as it was built. */
    bool
    nodes_moved() const
    {
      return !moves.empty();
    }

    /** Write @p values of nodes, none or one for each, in @p unit into the data
     * sets "value" and "id" of @p group. */
    void
    write_node_values(const std::vector<dealii::Tensor<1, dim>> &values,
                      const std::string                         &group,
                      const std::string                         &unit,
                      Archive                                   &archive) const;

    /** What write_node_values() wrote. Nodes of cells that were not active by
     * then alone get zero. Collective. */
    void
    read_node_values(const Archive                       &archive,
                     const std::string                   &group,
                     std::vector<dealii::Tensor<1, dim>> &values) const;

    /** Group "nodes/move", if any moved. */
    void
    write(Archive &archive) const override
    {
      write_node_values(moves, "nodes/move", "length", archive);
    }

    /** Nodes of cells that were not active when it was written have not moved.
     */
    void
    read(const Archive &archive) override
    {
      read_node_values(archive, "nodes/move", moves);
    }

    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return dofs;
    }

    const dealii::IndexSet &
    locally_owned() const
    {
      return owned;
    }

    /** The unknowns of all nodes this rank knows. */
    const dealii::IndexSet &
    locally_relevant() const
    {
      return relevant;
    }

    dealii::types::global_dof_index
    n_dofs() const
    {
      return dofs.n_dofs();
    }

    unsigned int
    n_active_cells() const
    {
      return n_active;
    }

    unsigned int
    degree() const
    {
      return fe_degree;
    }

    const BackgroundMesh<dim> &
    mesh() const
    {
      return background;
    }

    MPI_Comm
    communicator() const
    {
      return background.triangulation().get_communicator();
    }

  private:
    void
    number_nodes();

    dealii::Point<dim>
    middle_of_vertices(const unsigned int                     node,
                       const std::vector<dealii::Point<dim>> &vertices) const
    {
      const unsigned int begin = first_vertex[node],
                         end   = first_vertex[node + 1];
      dealii::Point<dim> x;
      for (unsigned int k = begin; k < end; ++k)
        x += vertices[vertices_of_nodes[k]];
      x /= end - begin;
      return x;
    }

    const BackgroundMesh<dim>    &background;
    const unsigned int            fe_degree;
    const unsigned int            n_nodes_per_cell;
    dealii::hp::FECollection<dim> fe_collection;
    dealii::DoFHandler<dim>       dofs;
    /** Index in the finite element of component 0 of each lexicographic node.
     */
    std::vector<unsigned int> fe_index_of_node;
    /** The corners of a cell in whose middle each lexicographic node is. */
    std::vector<std::vector<unsigned int>>       corners_around;
    std::vector<unsigned char>                   active_cells;
    std::vector<unsigned char>                   wanted_cells; ///< by this rank
    unsigned int                                 n_active = 0;
    std::vector<unsigned int>                    cell_slot;
    std::vector<unsigned int>                    nodes_of_cells;
    std::vector<dealii::types::global_dof_index> first_dof;
    /** Vertices [first_vertex[a], first_vertex[a + 1]) are those of node a. */
    std::vector<unsigned int> first_vertex;
    std::vector<unsigned int> vertices_of_nodes;
    /** From where nodes are in the mesh; empty if none ever moved. */
    std::vector<dealii::Tensor<1, dim>> moves;
    dealii::IndexSet                    owned;
    dealii::IndexSet                    relevant;
    mutable GhostedUnknowns             unknowns;
    /** Where the first of each node stands in their array. */
    std::vector<unsigned int> unknown_of_node;
  };
} // namespace moraine

#endif
