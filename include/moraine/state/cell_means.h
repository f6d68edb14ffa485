// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_cell_means_h
#define moraine_state_cell_means_h

#include <moraine/basis/basis.h>
#include <moraine/state/aggregates.h>

#include <functional>
#include <map>
#include <vector>

namespace moraine
{
  /**
   * Means over cells of the gradients of their shape functions, by the volumes
   * of the points, or of the parts of points, that lie in them:
   * @f[ b_{ca} = \frac{1}{V_c} \sum_p v_p\, s_{pc}\,
   *     \langle\nabla N_a\rangle_{pc}, \qquad
   *     V_c = \sum_p v_p\, s_{pc} @f]
   * with @f$s_{pc}@f$ the part of point p in cell c. What changes the volume of
   * a cell is then @f$\sum_a \Delta u_a \cdot b_{ca}@f$ for all that is in
   * it (Nagtegaal, Parks and Rice 1974; Hughes 1980).
   *
   * Cells whose nodes follow a root (Aggregates) and the root are a *group* g
   * with one mean for all that is in it, @f$\sum_{c \in g} (V_c / V_g)\,
   * b_{ca}@f$: there are no more means than cells whose nodes are free, so that
   * a cut does not lock. Where a point has a part @f$s_{pc}@f$ in cells of a
   * group, the cells of the group take its place with
   * @f$s_{pc'} = (V_{c'} / V_g) \sum_{c \in g} s_{pc}@f$. A cell with k roots
   * is in all their groups, with a share of 1/k of its volume and of its
   * points: above, @f$V_c@f$ and @f$s_{pc}@f$ are those shares then.
   */
  template <int dim>
  class CellMeans
  {
  public:
    static constexpr unsigned int n_corners = CellMeanBlock<dim>::n_corners;

    /** The volume of the i-th point of a block [length^dim]. */
    using Volume =
      std::function<double(const StencilBlock<dim> &, const unsigned int i)>;

    /** A cell that counts in the mean of another or in its own. */
    struct Part
    {
      unsigned int                  cell;  ///< active_cell_index()
      unsigned int                  group; ///< among those of the other, from 0
      double                        share; ///< of this cell in that group
      double                        weight;    ///< in the mean
      const dealii::Tensor<1, dim> *gradients; ///< @f$b_{ca}@f$ [1/length]
    };

    /** With @p for_shear blocks get mean gradients, too, unless cells form
     * groups, whose means are too coarse for that. */
    explicit CellMeans(const bool for_shear)
      : for_shear(for_shear)
    {}

    /** Of the points as @p basis has batched them; @p roots are those of cells
     * that have some. This rank knows the cells of groups of which it owns or
     * touches one. Collective. */
    void
    update(const GridSpace<dim> &space,
           const Basis<dim>     &basis,
           const Volume         &volume,
           const RootsOfCells   &roots);

    /** Give a block of the batch @p batch, as it was in update(), its means,
     * and the nodes that they have and the block has not. */
    void
    attach(const unsigned int batch, StencilBlock<dim> &block) const;

    /** The nodes of a batch with those that attach() adds to @p own. */
    dealii::ArrayView<const unsigned int>
    nodes_of_batch(const unsigned int                          batch,
                   const dealii::ArrayView<const unsigned int> own) const;

    /** Whether blocks get mean gradients, too. */
    bool
    averages_shear() const
    {
      return averages_gradients;
    }

    /** What the mean of a cell that this rank owns or touches consists of: all
     * cells of its groups, with or without points; no parts if no part of a
     * point lies there. */
    void
    of_cell(const unsigned int active_cell_index,
            std::vector<Part> &parts) const;

  private:
    struct Member
    {
      unsigned int cell;
      double       share;
    };

    struct Group
    {
      unsigned int first; ///< in members
      unsigned int end;
      double       volume;
    };

    struct Batch
    {
      unsigned int n_points;
      unsigned int first_cell;
      unsigned int n_cells;
      std::size_t  first_share;
      unsigned int first_node;
      unsigned int n_nodes; ///< of the block and of groups; 0: of the block
    };

    /** What the batches of points are made of, one after the other. */
    struct Batches
    {
      std::vector<Batch>        list;
      std::vector<unsigned int> cells;
      std::vector<unsigned int> corners; ///< among the nodes of the batch
      std::vector<double>       shares;  ///< none of batches in one cell
      std::vector<unsigned int> nodes;   ///< of those that have more nodes

      /** Cells, places and shares, if any, of one. */
      void
      parts_of(const Batch &batch, CellParts<dim> &parts) const;
    };

    /** Number of a cell among those with points here, which may be new. */
    unsigned int
    number_of(const unsigned int active_cell_index);

    /** Groups of which this rank owns or touches a cell. */
    void
    find_groups(const GridSpace<dim> &space, const RootsOfCells &roots);

    bool
    is_grouped(const unsigned int cell) const
    {
      return groups_of.count(cell) > 0;
    }

    /** Add what all ranks have, of cells that more than one of them touches. */
    void
    sum_over_ranks(const GridSpace<dim> &space);

    /** Keep what a batch is made of. */
    void
    append_batch(const unsigned int n_points, const CellParts<dim> &parts);

    /** Let groups take the place of their cells in all batches. */
    void
    take_groups(const GridSpace<dim> &space, const Basis<dim> &basis);

    /** Let groups take the place of cells in the @p parts of a batch, and add
     * to its @p nodes those that it lacks. */
    void
    group_parts(const GridSpace<dim>      &space,
                const unsigned int         n_points,
                std::vector<unsigned int> &nodes,
                CellParts<dim>            &parts) const;

    const bool          for_shear;
    bool                averages_gradients = false;
    Batches             batches;
    std::vector<Group>  groups;
    std::vector<Member> members; ///< of groups
    /** Numbers of the groups of cells that have some. */
    std::map<unsigned int, std::vector<unsigned int>> groups_of;
    std::vector<unsigned int>           cells;      ///< active_cell_index()
    std::vector<unsigned int>           numbers_of; ///< by active_cell_index()
    std::vector<double>                 volumes;
    std::vector<dealii::Tensor<1, dim>> gradients;
  };
} // namespace moraine

#endif
