// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_couplings_h
#define moraine_assembly_couplings_h

#include <moraine/core/linear_algebra.h>
#include <moraine/mesh/grid_space.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <vector>

namespace moraine
{
  /**
   * Which nodes are coupled, and the matrix that follows. Nodes are a ninth of
   * the entries in 3D.
   */
  template <int dim>
  class Couplings
  {
  public:
    explicit Couplings(const GridSpace<dim> &space);

    /** Couple @p n nodes, each with each. */
    void
    add(const unsigned int *nodes, const unsigned int n);

    /**
     * Make a matrix of zeros with what @p constraints put in place of their
     * rows and columns; of these it has the diagonal. Collective.
     */
    void
    make_matrix(const dealii::AffineConstraints<double> &constraints,
                LA::SparseMatrix                        &matrix) const;

    /** By the numbers of nodes on this rank. */
    const dealii::DynamicSparsityPattern &
    of_nodes() const
    {
      return nodes;
    }

  private:
    const GridSpace<dim>          &space;
    dealii::DynamicSparsityPattern nodes;
    std::vector<unsigned int>      sorted;
  };
} // namespace moraine

#endif
