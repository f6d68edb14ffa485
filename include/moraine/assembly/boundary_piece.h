// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_boundary_piece_h
#define moraine_assembly_boundary_piece_h

#include <moraine/assembly/term.h>
#include <moraine/boundary/implicit_boundary.h>

#include <vector>

namespace moraine
{
  /**
   * The points of an implicit boundary in one cell in the trial state, and the
   * functions there: those of the cell, and of the cells with which it has a
   * mean.
   */
  template <int dim>
  class BoundaryPiece
  {
  public:
    /** The trial increment at a point. */
    struct Increment
    {
      dealii::Tensor<1, dim> value;
      dealii::Tensor<2, dim> gradient;
      dealii::Tensor<2, dim> mean_gradient; ///< by which the volume changes
    };

    /** Take the run of points in one cell that starts at point @p first; a
     * roller pushes at @p share of the step. */
    void
    reinit(const ImplicitBoundary<dim> &boundary,
           const StepContext<dim>      &context,
           const unsigned int           first,
           const double                 share);

    unsigned int
    begin() const
    {
      return first_point;
    }

    /** Where the next piece begins. */
    unsigned int
    end() const
    {
      return first_point + increments.size();
    }

    unsigned int
    cell() const
    {
      return cell_index;
    }

    /** The nodes, those of the cell first. */
    const std::vector<unsigned int> &
    nodes() const
    {
      return node_numbers;
    }

    /** Take the functions at point @p q, begin() <= q < end(). */
    void
    set_place(const unsigned int q);

    const BoundaryPoint<dim> &
    point(const unsigned int q) const
    {
      return boundary->points()[q];
    }

    /** Of the nodes of the cell at point @p q. */
    const double *
    functions(const unsigned int q) const
    {
      return boundary->N(q);
    }

    const Increment &
    increment(const unsigned int q) const
    {
      return increments[q - first_point];
    }

    const ConstraintState<dim> &
    constraint(const unsigned int q) const
    {
      return constraints[q - first_point];
    }

    std::vector<double>                 N;
    std::vector<dealii::Tensor<1, dim>> grad_N;
    /** The mean, or @p grad_N if there is none. */
    std::vector<dealii::Tensor<1, dim>> mean_grad_N;

  private:
    void
    find_nodes(const State<dim> &state);

    /** Of the place that is set; @p nodal has those of all nodes. */
    Increment
    increment_here(const std::vector<dealii::Tensor<1, dim>> &nodal) const;

    const ImplicitBoundary<dim>               *boundary    = nullptr;
    unsigned int                               first_point = 0;
    unsigned int                               cell_index  = 0;
    unsigned int                               n_of_cell   = 0; ///< nodes
    std::vector<unsigned int>                  node_numbers;
    std::vector<typename CellMeans<dim>::Part> parts; ///< of the mean
    std::vector<Increment>                     increments;
    std::vector<ConstraintState<dim>>          constraints;
  };
} // namespace moraine

#endif
