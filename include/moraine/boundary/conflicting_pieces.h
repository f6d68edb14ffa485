// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_conflicting_pieces_h
#define moraine_boundary_conflicting_pieces_h

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/types.h>

#include <functional>
#include <vector>

namespace moraine
{
  /** The constraints of one owner (an implicit boundary or a grid condition) in
   * one cell: @f$M \sum_a N_a u_a = M g@f$ at its quadrature points. */
  template <int dim>
  struct ConflictingPiece
  {
    struct Place
    {
      dealii::Point<dim>              x;
      dealii::SymmetricTensor<2, dim> M;
      std::vector<double>             N; ///< of the nodes of the piece

      template <class BoostArchive>
      void
      serialize(BoostArchive &archive, const unsigned int)
      {
        archive &x &M &N;
      }
    };

    unsigned int owner = 0;
    unsigned int cell  = 0; ///< active_cell_index(); of nodes, any number
    /** A node that is prescribed cannot let go. */
    bool   must_hold = false;
    double area      = 0; ///< [length^(dim-1)]
    double h         = 0; ///< size of the cell; of nodes zero
    /** Names of nodes that ranks share. */
    std::vector<dealii::types::global_dof_index> nodes;
    std::vector<Place>                           places;

    template <class BoostArchive>
    void
    serialize(BoostArchive &archive, const unsigned int)
    {
      archive &owner &cell &must_hold &area &h &nodes &places;
    }
  };

  /** The increments that an owner prescribes at a place in some spans of time,
   * as many for every owner; none where it knows of none, and differs from
   * nobody. */
  template <int dim>
  using PrescribedIncrements =
    std::function<std::vector<dealii::Tensor<1, dim>>(
      const dealii::Point<dim> &)>;

  /** What becomes of each piece. */
  struct ConflictDecisions
  {
    /** The owner it lets go for; its own if it holds. */
    std::vector<unsigned int> given_way;
    /** Whether a piece with a node of it holds part of what it holds, and moves
     * differently. */
    std::vector<bool> sees_another;
  };

  /**
   * Where owners meet whose motions nodes cannot follow together, or only if
   * they move by several times the difference of the motions, some pieces have
   * to let go. If one linear field meets the values of all pieces, all hold.
   * Else pieces are taken one after the other if they agree with those taken
   * before: first those that see least of nodes another one moves differently,
   * of two alike the larger one. Pieces agree if a linear field satisfies all,
   * or the nodal increments with least differences in cells do, relative to the
   * motion of one owner: rigid motions are no difference.
   *
   * @param pieces all that share nodes with one of another owner, of all ranks
   * @param increments of owners
   */
  template <int dim>
  ConflictDecisions
  resolve_conflicts(const std::vector<ConflictingPiece<dim>>     &pieces,
                    const std::vector<PrescribedIncrements<dim>> &increments);
} // namespace moraine

#endif
