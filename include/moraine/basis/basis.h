// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_basis_h
#define moraine_basis_basis_h

#include <moraine/basis/stencil.h>
#include <moraine/geometry/carried_places.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** The parts of points that lie in one cell each. */
  template <int dim>
  struct CellParts
  {
    static constexpr unsigned int n_corners = 1u << dim;

    /** By active_cell_index(). */
    std::vector<unsigned int> cells;
    /** Their corners among the nodes of a batch, cell major. */
    std::vector<unsigned int> places;
    /** The part of each point in each cell, point major; those of a point add
     * up to 1. */
    std::vector<double> shares;
    /** Share times the mean of @f$\nabla N_a@f$ over the part [1/length], for
     * points, cells and corners. */
    std::vector<dealii::Tensor<1, dim>> gradients;
  };

  /**
   * Turns a point into the nodes it touches with @f$N@f$ and @f$\nabla N@f$.
   * Points of a cell that touch the same cells, or some of them, form a batch;
   * a batch is evaluated at once, so that what is outside the loop over its
   * points costs little.
   */
  template <int dim>
  class Basis
  {
  public:
    Basis(const GridSpace<dim> &space, const PointSet<dim> &points)
      : space(space)
      , points(points)
    {}

    virtual ~Basis() = default;

    /** Give the points what the basis stores with them. */
    virtual void
    initialise_points(PointSet<dim> &) const
    {}

    /**
     * Flag the cells that carry unknowns for the points of this rank.
     * @param active one flag per active_cell_index().
     * @throws ComputationError naming a point whose domain is too large for
     * the basis. Collective.
     */
    virtual void
    mark_cells(std::vector<unsigned char> &active)
    {
      for (const auto &in_cell : points.cells())
        active[in_cell.cell->active_cell_index()] = 1;
    }

    /**
     * Batch the points, after they were found and the cells mark_cells()
     * flagged were activated.
     * @return whether the nodes that occur together changed, so that the
     * sparsity pattern has to follow.
     */
    virtual bool
    batch_points() = 0;

    unsigned int
    n_batches() const
    {
      return batches.size();
    }

    /** The nodes of a batch, without evaluating anything. */
    dealii::ArrayView<const unsigned int>
    batch_nodes(const unsigned int batch) const
    {
      return {&batch_node_list[batches[batch].first_node],
              batches[batch].n_nodes};
    }

    /** The first point of a batch; all its points are in one cell. */
    unsigned int
    first_point_of(const unsigned int batch) const
    {
      return order[batches[batch].first_point];
    }

    /** Fill @p block with the stencils of batch @p batch. */
    virtual void
    evaluate(const unsigned int batch, StencilBlock<dim> &block) const = 0;

    /** The parts of the points of a batch in each of its cells. @p block is
     * that of evaluate(). Here each point lies in the cell of its batch. */
    virtual void
    evaluate_parts(const unsigned int       batch,
                   const StencilBlock<dim> &block,
                   CellParts<dim>          &parts) const;

    /** The functions of the cell of each place that this rank owns: they carry
     * forces to the nodes where domains stay in their cells. */
    PlaceFunctions<dim>
    functions_of_cells(
      const std::vector<typename CarriedPlaces<dim>::Place> &places) const;

    /**
     * The functions that carry forces at @p places to the nodes where domains
     * move through cells: those with which forces on the rim of a body are in
     * balance with stresses of its points. Here functions_of_cells().
     * Collective.
     */
    virtual PlaceFunctions<dim>
    functions_at(
      const std::vector<typename CarriedPlaces<dim>::Place> &places) const
    {
      return functions_of_cells(places);
    }

    /**
     * How the strain of points is found when a step is accepted: a basis for
     * the same points, whose nodes this rank knows. It is batched with this
     * one.
     */
    virtual const Basis &
    strain_basis() const
    {
      return *this;
    }

    /** Why the step that moves nodes by @p nodal_increments cannot be accepted,
     * naming the point of this rank (a domain that turns inside out), or "". */
    virtual std::string
    failure_of([[maybe_unused]] const std::vector<dealii::Tensor<1, dim>>
                 &nodal_increments) const
    {
      return "";
    }

    /**
     * Let the domains of the points follow a step that is accepted. Positions
     * of points and nodes are still those of the start of the step; fields of
     * the state (deformation gradient, volume) are already those of its end.
     *
     * @param points whose fields hold their domains
     * @param nodal_increments @f$\Delta u_a@f$ of the nodes
     * @param gradients @f$\sum_a \Delta u_a \otimes \nabla N_a@f$ of the
     * points, in the flat numbering
     */
    virtual void
    move_domains([[maybe_unused]] PointSet<dim> &points,
                 [[maybe_unused]] const std::vector<dealii::Tensor<1, dim>>
                   &nodal_increments,
                 [[maybe_unused]] const std::vector<dealii::Tensor<2, dim>>
                   &gradients) const
    {}

    /**
     * Split points whose domains became too large for the basis, if it was
     * told to. Called after points and the mesh were moved and before the
     * points' cells are searched. Sums over points of volume, mass, momentum
     * and the like stay.
     * @return whether any rank split a point. Collective.
     * @throws ComputationError naming a point that cannot be split enough.
     */
    virtual bool
    split_domains(PointSet<dim> &)
    {
      return false;
    }

    /** Number of points of this rank whose domains reach beyond the cells that
     * touch the point's, as of the last mark_cells(). */
    virtual unsigned int
    n_far_domains() const
    {
      return 0;
    }

    /** Whether points have domains to look at, domain_corners(). */
    virtual bool
    has_domains() const
    {
      return false;
    }

    /** The corners of the domain of a point, lexicographic. */
    virtual CellVertices<dim>
    domain_corners(const unsigned int) const
    {
      Assert(false, dealii::ExcNotImplemented());
      return {};
    }

  protected:
    struct Batch
    {
      unsigned int first_point; ///< in order
      unsigned int n_points;
      unsigned int first_node; ///< in batch_node_list
      unsigned int n_nodes;
    };

    /** Begin @p block with the points and nodes of a batch.
     * @return the batch */
    const Batch &
    reinit(const unsigned int batch, StencilBlock<dim> &block) const
    {
      const Batch &g = batches[batch];
      block.reinit(g.n_points,
                   &order[g.first_point],
                   g.n_nodes,
                   &batch_node_list[g.first_node]);
      return g;
    }

    /** Add a batch whose nodes are the last of batch_node_list, from
     * @p first_node on. */
    void
    append_batch(const unsigned int first_node,
                 const unsigned int first_point = 0,
                 const unsigned int n_points    = 0)
    {
      const unsigned int n_nodes = batch_node_list.size() - first_node;
      batches.push_back({first_point, n_points, first_node, n_nodes});
    }

    void
    clear_batches()
    {
      batches.clear();
      batch_node_list.clear();
      order.clear();
    }

    /** Make one batch of the points of each cell; append_nodes(cell) adds its
     * nodes to batch_node_list. */
    template <typename AppendNodes>
    void
    batch_points_by_cell(const AppendNodes &append_nodes)
    {
      clear_batches();
      order.resize(points.n_local());
      std::iota(order.begin(), order.end(), 0u);
      for (const auto &in_cell : points.cells())
        {
          const unsigned int first_node = batch_node_list.size();
          append_nodes(in_cell.cell);
          append_batch(first_node, in_cell.first, in_cell.last - in_cell.first);
        }
    }

    /**
     * Batch the points of a cell by the cells they touch: a point whose cells
     * are all among those of a batch joins it, for more zeros in a stencil cost
     * less than another scatter. @p in_cell holds the cells (n_cells(),
     * contains(), <) and the number of each point, and is sorted; append(cells)
     * adds a batch with its nodes and no points. On return @p cells_of_batches
     * are those of the new batches.
     */
    template <typename Cells, typename Append>
    void
    batch_points_of_cell(std::vector<std::pair<Cells, unsigned int>> &in_cell,
                         std::vector<Cells> &cells_of_batches,
                         const Append       &append)
    {
      std::sort(in_cell.begin(),
                in_cell.end(),
                [](const auto &a, const auto &b) {
                  const unsigned int n_a = a.first.n_cells(),
                                     n_b = b.first.n_cells();
                  return n_a != n_b ? n_a > n_b : a < b;
                });
      const unsigned int first_batch = batches.size();
      cells_of_batches.clear();
      batch_of.clear();
      for (const auto &[cells, p] : in_cell)
        {
          unsigned int g = 0;
          while (g < cells_of_batches.size() &&
                 !cells_of_batches[g].contains(cells))
            ++g;
          if (g == cells_of_batches.size())
            {
              cells_of_batches.push_back(cells);
              append(cells);
            }
          batch_of.push_back(g);
        }
      for (unsigned int g = 0; g < cells_of_batches.size(); ++g)
        {
          batches[first_batch + g].first_point = order.size();
          for (unsigned int k = 0; k < in_cell.size(); ++k)
            if (batch_of[k] == g)
              order.push_back(in_cell[k].second);
          batches[first_batch + g].n_points =
            order.size() - batches[first_batch + g].first_point;
        }
    }

    /** Add the functions of the cell of a place, number @p k, that this rank
     * owns. */
    void
    add_functions_of_cell(const typename CarriedPlaces<dim>::Place &place,
                          const unsigned int                        k,
                          PlaceFunctions<dim> &functions) const;

    const GridSpace<dim> &space;
    const PointSet<dim>  &points;

    std::vector<Batch>        batches;
    std::vector<unsigned int> order;
    std::vector<unsigned int> batch_node_list;

  private:
    std::vector<unsigned int> batch_of; ///< of batch_points_of_cell()
  };



  /**
   * The shape functions of the cell the point lies in, Q1 or Q2: standard MPM
   * if the points move through the mesh, FE if they are Gauss points that stay
   * where they are in their cell.
   */
  template <int dim, int degree>
  class CellBasis : public Basis<dim>
  {
  public:
    using Basis<dim>::Basis;

    bool
    batch_points() override;

    void
    evaluate(const unsigned int batch, StencilBlock<dim> &block) const override;
  };
} // namespace moraine

#endif
