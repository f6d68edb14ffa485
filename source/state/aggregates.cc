// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/aggregates.h>

#include <moraine/mesh/active_search.h>

#include <limits>
#include <set>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int largest_distance = 3; ///< of a root, in cells

    /** Of the cells around a vertex at least, in the bulk of a body: that is
     * about one and a half cells thick or more. */
    constexpr double fill_of_bulk = 0.75;

    /** Where means of a surface are held. */
    constexpr double fill_of_held = 0.5;

    /** Of the threshold, away from the bulk: a thin part that follows cells
     * filled little better than its others would not bend. */
    constexpr double share_in_thin_part = 0.2;



    template <int dim>
    bool
    has_vertex(const typename GridSpace<dim>::CellIterator &cell,
               const unsigned int                           vertex)
    {
      for (const unsigned int v : cell->vertex_indices())
        if (cell->vertex_index(v) == vertex)
          return true;
      return false;
    }



    /** The active cells that a node belongs to: those with all its vertices. */
    template <int dim>
    std::vector<typename GridSpace<dim>::CellIterator>
    cells_of_node(const GridSpace<dim> &space, const unsigned int node)
    {
      const auto &cells_at_vertex =
        space.mesh().search_cache().get_vertex_to_cell_map();
      const ArrayView<const unsigned int> vertices = space.node_vertices(node);
      std::vector<typename GridSpace<dim>::CellIterator> cells;
      for (const auto &cell : cells_at_vertex[vertices[0]])
        if (space.is_active(cell) &&
            std::all_of(vertices.begin(), vertices.end(), [&](const auto v) {
              return has_vertex<dim>(cell, v);
            }))
          cells.push_back(cell);
      return cells;
    }



    /**
     * Show active cells around some to @p visit, in layers that touch the one
     * before, these cells first, until it returns true or they are
     * largest_distance away.
     */
    template <int dim, typename Visit>
    void
    visit_layers(const GridSpace<dim>                              &space,
                 std::vector<typename GridSpace<dim>::CellIterator> layer,
                 const Visit                                       &visit)
    {
      const auto &cells_at_vertex =
        space.mesh().search_cache().get_vertex_to_cell_map();
      std::set<typename GridSpace<dim>::CellIterator> seen(layer.begin(),
                                                           layer.end());
      for (unsigned int distance = 0; !visit(layer); ++distance)
        {
          if (distance == largest_distance)
            return;
          std::vector<typename GridSpace<dim>::CellIterator> next;
          for (const auto &cell : layer)
            for (const unsigned int v : cell->vertex_indices())
              for (const auto &neighbour :
                   cells_at_vertex[cell->vertex_index(v)])
                if (space.is_active(neighbour) && seen.insert(neighbour).second)
                  next.push_back(neighbour);
          layer = std::move(next);
        }
    }



    /** What part of a cell has to be filled for its nodes to be free.
     * @param fill that part in the bulk */
    template <int dim>
    double
    threshold_of(const GridSpace<dim>                        &space,
                 const typename GridSpace<dim>::CellIterator &cell,
                 const std::vector<double>                   &filled,
                 const std::vector<bool>                     &in_bulk,
                 const double                                 fill)
    {
      bool   near_bulk = false;
      double largest   = 0;
      visit_layers(space, {cell}, [&](const auto &layer) {
        for (const auto &near : layer)
          {
            for (const unsigned int v : near->vertex_indices())
              near_bulk = near_bulk || in_bulk[near->vertex_index(v)];
            largest = std::max(largest, filled[near->active_cell_index()]);
          }
        return near_bulk;
      });
      return near_bulk ? fill : share_in_thin_part * fill * largest;
    }



    /** Active cells that only domains of points reach have the least fill of
     * the cells that touch them. */
    template <int dim>
    void
    fill_without_points(const GridSpace<dim>      &space,
                        const std::vector<double> &filled,
                        std::vector<double>       &fill)
    {
      const auto &cells_at_vertex =
        space.mesh().search_cache().get_vertex_to_cell_map();
      for (const auto &cell :
           space.mesh().triangulation().active_cell_iterators())
        if (const unsigned int c = cell->active_cell_index();
            space.is_active(cell) && filled[c] == 0)
          for (const unsigned int v : cell->vertex_indices())
            for (const auto &near : cells_at_vertex[cell->vertex_index(v)])
              if (const unsigned int n = near->active_cell_index();
                  filled[n] > 0)
                fill[c] = std::min(fill[c], fill[n]);
    }
  } // namespace



  template <int dim>
  std::vector<bool>
  vertices_in_bulk(const GridSpace<dim>      &space,
                   const std::vector<double> &filled)
  {
    const auto &tria = space.mesh().triangulation();
    const auto &cells_at_vertex =
      space.mesh().search_cache().get_vertex_to_cell_map();
    std::vector<double> sums(tria.n_vertices(), 0.);
    for (const auto &cell : tria.active_cell_iterators())
      if (space.is_active(cell))
        for (const unsigned int v : cell->vertex_indices())
          sums[cell->vertex_index(v)] += filled[cell->active_cell_index()];
    std::vector<bool> in_bulk(sums.size());
    for (unsigned int v = 0; v < sums.size(); ++v)
      in_bulk[v] =
        sums[v] > 0 && sums[v] >= fill_of_bulk * cells_at_vertex[v].size();
    return in_bulk;
  }



  template <int dim>
  bool
  Aggregates<dim>::tie_nodes(
    GridSpace<dim>                                  &space,
    const PointSet<dim>                             &points,
    const std::function<double(const unsigned int)> &volume,
    std::vector<unsigned char>                       active,
    const AskOfCell                                 &holds_mean_in)
  {
    find_parts(space, points, volume, holds_mean_in);
    const std::vector<Tie> ties_before  = std::move(tied);
    const RootsOfCells     roots_before = std::move(roots);
    group_cells(space);
    ask_for_groups(space, active);
    const auto ask_for_cells = [&] {
      for (const Tie &tie : tied)
        for (const unsigned int root : tie.roots)
          active[root] = 1;
      return space.set_active_cells(active);
    };
    find_ties(space);
    bool new_nodes = false;
    // Nodes of cells that were asked for may follow further roots.
    while (any_cut() && ask_for_cells())
      {
        new_nodes = true;
        find_ties(space);
      }
    for (const Tie &tie : tied)
      AssertThrow(!tie.nodes.empty(), ExcInternalError());
    return new_nodes || !(tied == ties_before) || !(roots == roots_before);
  }



  template <int dim>
  void
  Aggregates<dim>::find_parts(
    const GridSpace<dim>                            &space,
    const PointSet<dim>                             &points,
    const std::function<double(const unsigned int)> &volume,
    const AskOfCell                                 &holds_mean_in)
  {
    const auto         &tria = space.mesh().triangulation();
    std::vector<double> filled(tria.n_active_cells(), 0.);
    std::vector<double> fill(filled.size(), 1.);
    for (const auto &in_cell : points.cells())
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        {
          const unsigned int c = in_cell.cell->active_cell_index();
          filled[c] += volume(p);
          fill[c] = std::min(fill[c], fill_of_bodies[points.body(p)]);
        }
    Utilities::MPI::sum(filled, space.communicator(), filled);
    Utilities::MPI::min(fill, space.communicator(), fill);
    fill_without_points(space, filled, fill);
    for (const auto &cell : tria.active_cell_iterators())
      if (space.is_active(cell))
        filled[cell->active_cell_index()] /= volume_of_cell(cell);
    const auto &cells_at_vertex =
      space.mesh().search_cache().get_vertex_to_cell_map();
    enum class Held : unsigned char
    {
      unknown,
      no,
      yes
    };
    std::vector<Held> held(holds_mean_in ? filled.size() : 0, Held::unknown);
    const auto        is_held = [&](const auto &cell) {
      Held &answer = held[cell->active_cell_index()];
      if (answer == Held::unknown)
        answer = holds_mean_in(cell) ? Held::yes : Held::no;
      return answer == Held::yes;
    };
    const auto is_held_near = [&](const auto &cell) {
      const auto vertices = cell->vertex_indices();
      return holds_mean_in &&
             std::any_of(vertices.begin(), vertices.end(), [&](const auto v) {
               const auto &cells = cells_at_vertex[cell->vertex_index(v)];
               return std::any_of(cells.begin(), cells.end(), is_held);
             });
    };
    const std::vector<bool> in_bulk = vertices_in_bulk(space, filled);
    parts.assign(filled.size(), Part::none);
    for (const auto &cell : tria.active_cell_iterators())
      if (space.is_active(cell))
        {
          // Sums of the points of a half-filled cell may differ in the last
          // digit.
          const unsigned int c    = cell->active_cell_index();
          const double       part = (1 + 1e-9) * filled[c];
          if (fill[c] > 0 && part < fill_of_held && is_held_near(cell))
            fill[c] = std::max(fill[c], fill_of_held);
          if (filled[c] == 0 && fill[c] == 0)
            continue; // its nodes are free, but hold no others
          parts[c] =
            part >= fill[c] ||
                part >= threshold_of(space, cell, filled, in_bulk, fill[c]) ?
              Part::filled :
              Part::cut;
        }
  }



  template <int dim>
  void
  Aggregates<dim>::find_ties(const GridSpace<dim> &space)
  {
    tied.clear();
    rootless.clear();
    if (!any_cut())
      return;
    const unsigned int n = space.nodes_per_cell();
    std::vector<bool>  in_cut_cell(space.n_nodes(), false);
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (part(cell) == Part::cut && space.knows(cell->active_cell_index()))
        for (unsigned int a = 0; a < n; ++a)
          in_cut_cell[space.cell_nodes(cell->active_cell_index())[a]] = true;
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      {
        if (!in_cut_cell[node])
          continue;
        const auto cells = cells_of_node(space, node);
        if (std::any_of(cells.begin(), cells.end(), [this](const auto &cell) {
              return part(cell) == Part::filled;
            }))
          continue;
        Tie tie{node,
                find_roots(space,
                           cells,
                           space.node_position(node) - space.node_move(node)),
                {},
                {}};
        if (!tie.roots.empty())
          {
            if (std::all_of(tie.roots.begin(),
                            tie.roots.end(),
                            [&space](const auto root) {
                              return space.knows(root);
                            }))
              find_weights(space, tie);
            tied.push_back(std::move(tie));
          }
        else if (space.locally_owned().is_element(space.node_dof(node)))
          rootless.push_back(node);
      }
  }



  template <int dim>
  void
  Aggregates<dim>::find_weights(const GridSpace<dim> &space, Tie &tie) const
  {
    const unsigned int  n = space.nodes_per_cell();
    std::vector<double> N(n);
    for (const unsigned int root : tie.roots)
      {
        // Nodes that move with the material keep their place in the root.
        continue_shapes(space, root, space.node_position(tie.node), N.data());
        for (unsigned int a = 0; a < n; ++a)
          {
            const unsigned int node = space.cell_nodes(root)[a];
            const double       part = N[a] / tie.roots.size();
            const auto         known =
              std::find(tie.nodes.begin(), tie.nodes.end(), node);
            if (known == tie.nodes.end())
              {
                tie.nodes.push_back(node);
                tie.weights.push_back(part);
              }
            else
              tie.weights[known - tie.nodes.begin()] += part;
          }
      }
  }



  template <int dim>
  void
  Aggregates<dim>::group_cells(const GridSpace<dim> &space)
  {
    roots.clear();
    if (!with_groups || !any_cut())
      return;
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (part(cell) == Part::cut)
        {
          auto nearest = find_roots(space, {cell}, cell->center());
          if (!nearest.empty())
            roots[cell->active_cell_index()] = std::move(nearest);
        }
  }



  template <int dim>
  void
  Aggregates<dim>::ask_for_groups(const GridSpace<dim>       &space,
                                  std::vector<unsigned char> &active) const
  {
    if (roots.empty())
      return;
    std::vector<bool> here(active.size(), false); // groups, by their roots
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (const unsigned int c = cell->active_cell_index();
          active[c] != 0 || (cell->is_locally_owned() && space.is_active(cell)))
        {
          if (const auto found = roots.find(c); found == roots.end())
            here[c] = true;
          else
            for (const unsigned int root : found->second)
              here[root] = true;
        }
    for (const auto &[cell, roots_of_cell] : roots)
      for (const unsigned int root : roots_of_cell)
        if (here[root])
          active[cell] = active[root] = 1;
  }



  template <int dim>
  std::vector<unsigned int>
  Aggregates<dim>::find_roots(const GridSpace<dim>            &space,
                              const std::vector<CellIterator> &cut_cells,
                              const Point<dim>                &x) const
  {
    std::vector<std::pair<unsigned int, double>> found; // and distances
    visit_layers(space, cut_cells, [&](const auto &layer) {
      for (const auto &cell : layer)
        if (part(cell) == Part::filled)
          found.emplace_back(cell->active_cell_index(),
                             distance_to_cell<dim>(cell, x));
      if (found.empty())
        return false;
      double nearest = std::numeric_limits<double>::max();
      for (const auto &[cell, distance] : found)
        nearest = std::min(nearest, distance);
      nearest += space.mesh().round_off();
      found.erase(std::remove_if(found.begin(),
                                 found.end(),
                                 [nearest](const auto &one) {
                                   return one.second > nearest;
                                 }),
                  found.end());
      return true;
    });
    std::vector<unsigned int> cells;
    for (const auto &[cell, distance] : found)
      cells.push_back(cell);
    std::sort(cells.begin(), cells.end());
    return cells;
  }



  template <int dim>
  Tensor<1, dim>
  Aggregates<dim>::value_of_roots(
    const Tie                         &tie,
    const std::vector<Tensor<1, dim>> &values) const
  {
    Tensor<1, dim> value;
    for (unsigned int a = 0; a < tie.weights.size(); ++a)
      value += tie.weights[a] * values[tie.nodes[a]];
    return value;
  }



  template <int dim>
  std::vector<double>
  Aggregates<dim>::shares_of_roots(
    const Tie                         &tie,
    const std::vector<Tensor<1, dim>> &masses,
    const std::vector<Tensor<1, dim>> &moved) const
  {
    constexpr double    much = 0.5;
    std::vector<double> shares(tie.weights.size());
    double              sum    = 0;
    bool                is_fit = true;
    for (unsigned int a = 0; a < shares.size(); ++a)
      {
        const unsigned int node = tie.nodes[a];
        is_fit    = is_fit && moved[node][0] >= much * masses[node][0];
        shares[a] = std::max(moved[node][0], 0.);
        sum += shares[a];
      }
    if (is_fit)
      return tie.weights;
    for (double &share : shares)
      share /= sum;
    return shares;
  }



  template <int dim>
  void
  Aggregates<dim>::hand_over(const GridSpace<dim>              &space,
                             const std::vector<Tensor<1, dim>> &masses,
                             std::vector<Tensor<1, dim>>       &values) const
  {
    if (!any_cut())
      return;
    std::vector<Tensor<1, dim>> moved(masses), momenta(values.size());
    const auto                  is_mine = [&space](const Tie &tie) {
      return space.locally_owned().is_element(space.node_dof(tie.node));
    };
    // The mass that moves with each node, which may be less than its own:
    // weights of nodes behind the root are negative.
    std::vector<Tensor<1, dim>> taken(values.size());
    for (const Tie &tie : tied)
      if (is_mine(tie))
        for (unsigned int a = 0; a < tie.nodes.size(); ++a)
          taken[tie.nodes[a]][0] += tie.weights[a] * masses[tie.node][0];
    space.sum_over_ranks(taken);
    for (unsigned int node = 0; node < values.size(); ++node)
      moved[node] += taken[node];

    for (const Tie &tie : tied)
      if (is_mine(tie))
        {
          const Tensor<1, dim> momentum =
            masses[tie.node][0] *
            (values[tie.node] - value_of_roots(tie, values));
          const std::vector<double> shares =
            shares_of_roots(tie, masses, moved);
          for (unsigned int a = 0; a < tie.nodes.size(); ++a)
            momenta[tie.nodes[a]] += shares[a] * momentum;
        }
    space.sum_over_ranks(momenta);
    for (unsigned int node = 0; node < values.size(); ++node)
      if (moved[node][0] > 0)
        values[node] += momenta[node] / moved[node][0];
    for (const Tie &tie : tied)
      values[tie.node] = value_of_roots(tie, values);
  }



  template decltype(vertices_in_bulk<2>) vertices_in_bulk<2>;
  template decltype(vertices_in_bulk<3>) vertices_in_bulk<3>;
  template class Aggregates<2>;
  template class Aggregates<3>;
} // namespace moraine
