// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_global_system_h
#define moraine_assembly_global_system_h

#include <moraine/assembly/constraint_table.h>
#include <moraine/assembly/couplings.h>
#include <moraine/assembly/ghost_rows.h>
#include <moraine/assembly/local_system.h>
#include <moraine/core/linear_algebra.h>
#include <moraine/core/local_rows.h>

#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * Where the terms put their forces and minus their derivatives: the matrix
   * with the constraints condensed, and the forces of all nodes as they are.
   *
   * Pairs of nodes that no constraint touches are summed where the rows lie
   * in memory: the columns of a node follow each other, so one search finds a
   * pair of nodes. Rows of other ranks are summed here before they are sent.
   * Pairs with other nodes take deal.II's way.
   */
  template <int dim>
  class GlobalSystem
  {
  public:
    /** Let the matrix go. */
    void
    clear()
    {
      sum_of_matrices.reset();
      ghost_rows = GhostRows();
    }

    /** Make a matrix with the pattern of @p couplings. Forces are measured for
     * each of @p n_bodies, to which nodes belong by @p body_of_node.
     * Collective. */
    void
    reinit(const GridSpace<dim>            &space,
           const ConstraintTable           &table,
           const Couplings<dim>            &couplings,
           const std::vector<unsigned int> &body_of_node,
           const unsigned int               n_bodies);

    /**
     * Begin anew, with the matrix if @p tangent. The matrix times the values
     * @p predicted of nodes is taken off the forces, unless there are none.
     */
    void
    begin(const bool                                 tangent,
          const std::vector<dealii::Tensor<1, dim>> &predicted = {});

    /** Add to the forces and, if asked, to the matrix. */
    void
    add(const LocalSystem<dim> &local, const bool tangent);

    /** Add a force at a node. */
    void
    add(const unsigned int node, const dealii::Tensor<1, dim> &force)
    {
      node_forces[node] += force;
    }

    /** Whether a strong condition says what this unknown is. */
    bool
    is_prescribed(const dealii::types::global_dof_index dof) const
    {
      return constraints->is_constrained(dof);
    }

    /** Sum over ranks: close the matrix, if it was asked for, and put the
     * forces into @p forces. Collective. */
    void
    end(LA::Vector &forces);

    /** @f$\sum f^2@f$ of what this rank added to the nodes of each body: the
     * size of forces that may cancel. */
    const std::vector<double> &
    squares_of_bodies() const
    {
      return squares;
    }

    /** Of all bodies. */
    double
    sum_of_squares() const
    {
      return std::accumulate(squares.begin(), squares.end(), 0.);
    }

    /** Let add() count work, which costs a little; at first it does not. */
    void
    count_work(const bool counts)
    {
      is_counting = counts;
    }

    bool
    counts_work() const
    {
      return is_counting;
    }

    /** @f$\sum f \cdot \Delta u@f$ of what this rank added, if it counts. */
    double
    work() const
    {
      return work_sum;
    }

    /** What this rank added to the forces of the nodes it knows. */
    const std::vector<dealii::Tensor<1, dim>> &
    forces_of_this_rank() const
    {
      return node_forces;
    }

    /** Why a point has no stress, if one has none since begin(). */
    const std::string &
    failure() const
    {
      return first_failure;
    }

    const std::shared_ptr<LA::SparseMatrix> &
    matrix() const
    {
      return sum_of_matrices;
    }

  private:
    /** Where an unconstrained node is in the matrix; the first of dim rows,
     * with the same entries, and columns that follow each other, or none. */
    struct NodeInMatrix
    {
      int row    = LA::LocalRows::none;
      int column = LA::LocalRows::none;
      int ghost  = LA::LocalRows::none; ///< in ghost_rows
    };

    NodeInMatrix
    find_node(const unsigned int node) const;

    /** Find the rows of other ranks, after all nodes are found. Collective. */
    void
    find_ghost_rows(const Couplings<dim> &couplings);

    /** Add the rows of the a-th node of @p local, of the nodes in by_column, to
     * rows of @p length entries with these @p columns. */
    void
    add_rows_of_node(const LocalSystem<dim> &local,
                     const unsigned int      a,
                     const unsigned int      length,
                     const int              *columns,
                     double                 *values) const;

    /** Add the matrix of @p local. */
    void
    add_to_matrix(const LocalSystem<dim> &local);

    /** Add the matrix in rest in deal.II's way. */
    void
    add_rest(const LocalSystem<dim> &local);

    /** Add the pairs of the nodes in by_column to rows in memory. */
    void
    add_to_rows(const LocalSystem<dim> &local);

    /** Rows of what follows others have nothing but a diagonal, the mean of
     * cells that may hold next to nothing. Give them the largest of all, so
     * that they do not spoil the condition. Collective. */
    void
    scale_tied_rows();

    const GridSpace<dim>                        *space       = nullptr;
    const ConstraintTable                       *table       = nullptr;
    const dealii::AffineConstraints<double>     *constraints = nullptr;
    std::shared_ptr<LA::SparseMatrix>            sum_of_matrices;
    LA::LocalRows                                rows;
    std::vector<NodeInMatrix>                    nodes_in_matrix;
    GhostRows                                    ghost_rows;
    std::vector<dealii::types::global_dof_index> tied_rows; ///< owned
    bool any_tied = false;                                  ///< on any rank
    std::vector<std::pair<int, unsigned int>>
                               by_column; ///< scratch: columns of nodes
    dealii::FullMatrix<double> rest;      ///< scratch: what has no such columns
    std::vector<dealii::Tensor<1, dim>> node_forces;
    std::vector<dealii::Tensor<1, dim>> predicted;
    const std::vector<unsigned int>    *body_of_node = nullptr;
    std::vector<double>                 squares;
    double                              work_sum = 0;
    std::string                         first_failure;
    bool                                is_counting  = false;
    bool                                with_tangent = false;
  };
} // namespace moraine

#endif
