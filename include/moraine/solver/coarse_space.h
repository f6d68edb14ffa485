// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_coarse_space_h
#define moraine_solver_coarse_space_h

#include <deal.II/base/index_set.h>

#include <deal.II/lac/full_matrix.h>

#include <moraine/core/linear_algebra.h>

#include <moraine/solver/direct_solver.h>
#include <moraine/solver/overlapping_rows.h>
#include <moraine/solver/subdomains.h>

#include <map>
#include <memory>
#include <vector>

namespace moraine
{
  /**
   * The coarse space of the generalised Dryja-Smith-Widlund method (Dohrmann,
   * Klawonn and Widlund 2008, doi 10.1137/070685841): rigid-body modes of each
   * part of the interface between subdomains, continued into these in
   * equilibrium. With P, whose columns they are, A P = 0 inside of subdomains,
   * and A_0 = P^T A P.
   *
   * We depart from the source in what the interface is: unknowns with a
   * neighbour in a subdomain of smaller number. It separates subdomains for any
   * width of the stencil, and each part of it belongs to one of them: those
   * unknowns that have the same such neighbours.
   */
  class CoarseSpace
  {
  public:
    /**
     * @p modes are the rigid-body modes; without any, a constant vector takes
     * their place. @p rows and @p subdomains must live as long as this.
     * Collective, as the rest.
     */
    CoarseSpace(const OverlappingRows         &rows,
                const Subdomains              &subdomains,
                const std::vector<LA::Vector> &modes,
                const LA::Vector              &any);

    /** dst = P A_0^-1 P^T src. */
    void
    vmult(LA::Vector &dst, const LA::Vector &src) const;

  private:
    /** The modes on an unknown of the interface. */
    struct InterfaceRow
    {
      unsigned int        row; ///< of OverlappingRows
      unsigned int        first_column;
      std::vector<double> values;
    };

    /** The modes in a subdomain: value of unknown i in columns[j]. */
    struct Inside
    {
      std::vector<unsigned int>                    unknowns;
      std::vector<dealii::types::global_dof_index> columns;
      dealii::FullMatrix<double>                   values;
    };

    /** Columns of P of this rank: an orthonormal basis of the modes on each
     * part of the interface. Then those that other ranks have around it. */
    void
    make_interface(const std::vector<LA::Vector> &modes,
                   const MPI_Comm                &communicator);

    /** Continue the modes into the inside of a subdomain of this rank. */
    Inside
    continue_into(const unsigned int subdomain) const;

    /** A_0. */
    void
    make_matrix(const MPI_Comm &communicator);

    /** What the inside of a subdomain has for A_0, for its columns. */
    dealii::FullMatrix<double>
    contribution(const Inside &inside) const;

    const InterfaceRow *
    on_interface(const unsigned int row) const
    {
      return interface_of[row] < 0 ? nullptr : &interface[interface_of[row]];
    }

    const OverlappingRows        &rows;
    const Subdomains             &subdomains;
    std::vector<InterfaceRow>     interface;
    std::vector<int>              interface_of; ///< of rows; -1: none
    dealii::IndexSet              own_columns;
    std::vector<Inside>           insides;
    LA::SparseMatrix              matrix;
    std::unique_ptr<DirectSolver> solver;
    mutable LA::Vector            right_hand_side, solution, known;
  };
} // namespace moraine

#endif
