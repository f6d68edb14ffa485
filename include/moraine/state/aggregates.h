// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_aggregates_h
#define moraine_state_aggregates_h

#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

namespace moraine
{
  /**
   * Whether the cells around each vertex are filled as the bulk of a body fills
   * them, by three quarters: it is about one and a half cells thick or more.
   * @param space grid whose vertices are asked about
   * @param filled part of each cell, by active_cell_index()
   */
  template <int dim>
  std::vector<bool>
  vertices_in_bulk(const GridSpace<dim>      &space,
                   const std::vector<double> &filled);

  /** By active_cell_index() of cells that have some: the filled cells that they
   * are counted with. */
  using RootsOfCells = std::map<unsigned int, std::vector<unsigned int>>;

  /**
   * Which nodes have too little material around to be free, and which cells
   * they follow: the aggregates of Badia, Verdugo, Martin 2018
   * (doi:10.1016/j.cma.2018.03.022). A cell is *filled* if its points fill at
   * least a given part of it; away from the bulk of a body, in parts less than
   * about one and a half cells thick, a fifth of that part of the fullest cell
   * around, so that a thin part has filled cells, too. A node of active cells
   * none of which is filled follows its *root*, the nearest filled cell: its
   * value is that of the root's functions, continued to the node. We tie nodes
   * one by one to the cell nearest to each, not cells to cells, and to the mean
   * of those that are equally near, so that what is symmetric stays so.
   *
   * Roots are sought over active cells only, so that nothing is tied across a
   * gap, and at most three cells away, because continued functions grow with
   * the distance. Nodes of parts without a filled cell near stay free.
   */
  template <int dim>
  class Aggregates
  {
  public:
    struct Tie
    {
      unsigned int node; ///< of this rank
      /** active_cell_index() of cells this rank knows, in order: one, or those
       * that are equally near. */
      std::vector<unsigned int> roots;
      std::vector<unsigned int> nodes;   ///< of all the roots
      std::vector<double>       weights; ///< of each the mean @f$N_a(x)@f$

      bool
      operator==(const Tie &other) const
      {
        return node == other.node && roots == other.roots &&
               nodes == other.nodes && weights == other.weights;
      }
    };

    /** The same on all ranks. */
    using AskOfCell =
      std::function<bool(const typename GridSpace<dim>::CellIterator &)>;

    /** @p fill_of_bodies, 0 <= fill <= 1, has for each body which part of a
     * cell has to be filled for its nodes to be free: the least one of the
     * bodies in it; roots_of_cells() may be asked for if @p group_cells. */
    explicit Aggregates(const std::vector<double> &fill_of_bodies,
                        const bool                 group_cells = false)
      : fill_of_bodies(fill_of_bodies)
      , with_groups(group_cells)
    {}

    /**
     * Tie the nodes of @p space anew; @p volume(p) is what point p fills of the
     * cell that holds it. A surface that holds means over its pieces may tear
     * off material that fills less than half a cell as that moves on, so where
     * it @p holds_mean_in a cell half of it, and of those that touch it, has
     * to be filled, at least, if anything has to be. If cells are grouped,
     * those that have a root in common with one of @p active, its own cells, or
     * one that it owns are asked for beside these; so are the roots of all
     * nodes this rank knows then.
     * @return whether ties, groups or nodes of this rank changed. Collective.
     */
    bool
    tie_nodes(GridSpace<dim>                                  &space,
              const PointSet<dim>                             &points,
              const std::function<double(const unsigned int)> &volume,
              std::vector<unsigned char>                       active,
              const AskOfCell &holds_mean_in = {});

    /** Of all nodes this rank knows, in their order. */
    const std::vector<Tie> &
    ties() const
    {
      return tied;
    }

    /** Of cut cells: the filled cell nearest to their middle, in the reach of
     * ties, or those that are equally near. The same on all ranks; empty if
     * cells are not grouped. */
    const RootsOfCells &
    roots_of_cells() const
    {
      return roots;
    }

    /**
     * Let @p values of nodes, which have @p masses (their component 0), be
     * those of their roots where nodes are tied, and give what momentum that
     * takes to the nodes of the roots: momentum stays, and mostly its moment.
     * All ranks agree on the values of a node. Collective.
     */
    void
    hand_over(const GridSpace<dim>                      &space,
              const std::vector<dealii::Tensor<1, dim>> &masses,
              std::vector<dealii::Tensor<1, dim>>       &values) const;

    /** Nodes of this rank that have neither a filled cell nor a root. */
    const std::vector<unsigned int> &
    nodes_without_root() const
    {
      return rootless;
    }

  private:
    using CellIterator = typename GridSpace<dim>::CellIterator;

    enum class Part : unsigned char
    {
      none,  ///< not active
      cut,   ///< points fill too little of it
      filled ///< its nodes are free
    };

    void
    find_parts(const GridSpace<dim>                            &space,
               const PointSet<dim>                             &points,
               const std::function<double(const unsigned int)> &volume,
               const AskOfCell                                 &holds_mean_in);

    void
    find_ties(const GridSpace<dim> &space);

    void
    group_cells(const GridSpace<dim> &space);

    /** Flag the cells of groups of which this rank flags or owns one. */
    void
    ask_for_groups(const GridSpace<dim>       &space,
                   std::vector<unsigned char> &active) const;

    Part
    part(const CellIterator &cell) const
    {
      return parts[cell->active_cell_index()];
    }

    /** The filled cells nearest to @p x around cut cells, which all meet there,
     * in the order of their indices. */
    std::vector<unsigned int>
    find_roots(const GridSpace<dim>            &space,
               const std::vector<CellIterator> &cut_cells,
               const dealii::Point<dim>        &x) const;

    /** The nodes and weights of a tie whose roots this rank knows. */
    void
    find_weights(const GridSpace<dim> &space, Tie &tie) const;

    /** The value of the roots of a tie at its node. */
    dealii::Tensor<1, dim>
    value_of_roots(const Tie                                 &tie,
                   const std::vector<dealii::Tensor<1, dim>> &values) const;

    /** How the nodes of the roots share what a tied node hands over: by its
     * weights, which keeps the moment, unless a node is too light for that;
     * then alike, by the masses @p moved with them. */
    std::vector<double>
    shares_of_roots(const Tie                                 &tie,
                    const std::vector<dealii::Tensor<1, dim>> &masses,
                    const std::vector<dealii::Tensor<1, dim>> &moved) const;

    /** Whether any cell of the mesh is cut. */
    bool
    any_cut() const
    {
      return std::find(parts.begin(), parts.end(), Part::cut) != parts.end();
    }

    const std::vector<double> fill_of_bodies;
    const bool                with_groups;
    std::vector<Part>         parts; ///< of all cells, the same on all ranks
    std::vector<Tie>          tied;
    RootsOfCells              roots;
    std::vector<unsigned int> rootless;
  };
} // namespace moraine

#endif
