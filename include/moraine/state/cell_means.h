// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_cell_means_h
#define moraine_state_cell_means_h

#include <moraine/basis/basis.h>

#include <functional>
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
   */
  template <int dim>
  class CellMeans
  {
  public:
    static constexpr unsigned int n_corners = CellMeanBlock<dim>::n_corners;

    /** The volume of the i-th point of a block [length^dim]. */
    using Volume =
      std::function<double(const StencilBlock<dim> &, const unsigned int i)>;

    /** Of the points as @p basis has batched them. Collective. */
    void
    update(const GridSpace<dim> &space,
           const Basis<dim>     &basis,
           const Volume         &volume);

    /** Give a block of the batch @p batch, as it was in update(), its means. */
    void
    attach(const unsigned int batch, StencilBlock<dim> &block) const;

    /** @f$b_{ca}@f$ [1/length] of the corners of a cell that this rank owns or
     * touches and in which a part of a point lies; else a null pointer. */
    const dealii::Tensor<1, dim> *
    of_cell(const unsigned int active_cell_index) const;

  private:
    /** Number of a cell among those with points here, which may be new. */
    unsigned int
    number_of(const unsigned int active_cell_index);

    /** Add what all ranks have, of cells that more than one of them touches. */
    void
    sum_over_ranks(const GridSpace<dim> &space);

    struct Batch
    {
      unsigned int first_cell;
      unsigned int n_cells;
      std::size_t  first_share;
    };

    /** Keep what a batch is made of. */
    void
    append_batch(const CellParts<dim> &parts);

    std::vector<Batch>                  batches;
    std::vector<unsigned int>           cells_of_batches;
    std::vector<unsigned int>           corners_of_batches;
    std::vector<double>                 shares_of_batches;
    std::vector<unsigned int>           cells;      ///< active_cell_index()
    std::vector<unsigned int>           numbers_of; ///< by active_cell_index()
    std::vector<double>                 volumes;
    std::vector<dealii::Tensor<1, dim>> gradients;
  };
} // namespace moraine

#endif
