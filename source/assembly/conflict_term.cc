// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/conflict_term.h>

#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>
#include <tuple>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What nodes are given by others: tied ones by their roots. */
    template <int dim>
    class FreeNodes
    {
    public:
      FreeNodes(const State<dim> &state, const PrescribedNodes<dim> &prescribed)
        : space(state.grid())
        , tie_of(space.n_nodes(), nullptr)
      {
        if (const auto *aggregates = state.strict_aggregates())
          for (const auto &tie : aggregates->ties())
            tie_of[tie.node] = &tie;
        for (const auto &entry : prescribed.entries)
          tie_of[entry.node] = nullptr;
      }

      /** Add @p weight times a node to weights of nodes. */
      void
      add(const unsigned int                            node,
          const double                                  weight,
          std::vector<std::pair<unsigned int, double>> &sum) const
      {
        const auto *tie     = tie_of[node];
        const auto  add_one = [&sum](const unsigned int a, const double w) {
          const auto same =
            std::find_if(sum.begin(), sum.end(), [a](const auto &entry) {
              return entry.first == a;
            });
          if (same == sum.end())
            sum.emplace_back(a, w);
          else
            same->second += w;
        };
        if (!tie)
          add_one(node, weight);
        else
          for (unsigned int a = 0; a < tie->weights.size(); ++a)
            add_one(tie->nodes[a], weight * tie->weights[a]);
      }

    private:
      const GridSpace<dim>                              &space;
      std::vector<const typename Aggregates<dim>::Tie *> tie_of;
    };



    /** A piece with the nodes as this rank numbers them. */
    template <int dim>
    struct LocalPiece
    {
      ConflictingPiece<dim>     piece;
      std::vector<unsigned int> nodes;
    };



    /** The pieces of @p boundary in the cells of this rank. */
    template <int dim>
    void
    add_pieces(const ImplicitBoundary<dim>  &boundary,
               const unsigned int            owner,
               const GridSpace<dim>         &space,
               const FreeNodes<dim>         &free_nodes,
               std::vector<LocalPiece<dim>> &pieces)
    {
      const auto                                  &points = boundary.points();
      const unsigned int                           n = space.nodes_per_cell();
      std::vector<std::pair<unsigned int, double>> sum;
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          if (q == 0 || points[q].cell != points[q - 1].cell)
            {
              pieces.emplace_back();
              pieces.back().piece.owner = owner;
              pieces.back().piece.cell  = points[q].cell;
              pieces.back().piece.h     = points[q].h;
              sum.clear();
            }
          auto &[piece, nodes] = pieces.back();
          for (auto &[node, weight] : sum)
            weight = 0;
          for (unsigned int a = 0; a < n; ++a)
            free_nodes.add(space.cell_nodes(points[q].cell)[a],
                           boundary.N(q)[a],
                           sum);
          piece.area += points[q].JxW;
          piece.places.push_back(
            {points[q].x, boundary.constraint().projection(points[q].normal), {}});
          nodes.clear();
          for (const auto &[node, weight] : sum)
            {
              nodes.push_back(node);
              piece.places.back().N.push_back(weight);
            }
        }
    }



    /** The same, or nothing where @p increments have no values, as expressions
     * need none beyond their surface. */
    template <int dim>
    PrescribedIncrements<dim>
    if_defined(const PrescribedIncrements<dim> &increments)
    {
      return [increments](const Point<dim> &x) {
        try
          {
            return increments(x);
          }
        catch (const InputError &)
          {
            return std::vector<Tensor<1, dim>>();
          }
      };
    }



    /** @throws InputError, on all ranks, where what a piece itself prescribes
     * is not a number. */
    template <int dim>
    void
    check_own_values(const std::vector<ConflictingPiece<dim>>     &pieces,
                     const std::vector<PrescribedIncrements<dim>> &increments)
    {
      for (const auto &piece : pieces)
        for (const auto &place : piece.places)
          increments[piece.owner](place.x);
    }



    /** Flags for nodes that see pieces or conditions of several owners.
     * Collective. */
    template <int dim>
    std::vector<bool>
    nodes_of_several(const GridSpace<dim>               &space,
                     const std::vector<LocalPiece<dim>> &pieces,
                     const PrescribedNodes<dim>         &prescribed,
                     const unsigned int                  n_boundaries)
    {
      // The owners of a node are all one if their variance is zero.
      std::vector<Tensor<1, dim>> sums(space.n_nodes()), squares(sums);
      const auto                  touch = [&](const unsigned int node,
                             const unsigned int owner) {
        sums[node][0] += 1;
        sums[node][1] += owner;
        squares[node][0] += double(owner) * owner;
      };
      for (const auto &[piece, nodes] : pieces)
        for (const unsigned int node : nodes)
          touch(node, piece.owner);
      for (const auto &entry : prescribed.entries)
        touch(entry.node, n_boundaries + entry.condition);
      space.sum_over_ranks(sums);
      space.sum_over_ranks(squares);
      std::vector<bool> several(space.n_nodes());
      for (unsigned int a = 0; a < several.size(); ++a)
        several[a] = sums[a][0] * squares[a][0] - sums[a][1] * sums[a][1] > 0.5;
      return several;
    }
  } // namespace



  template <int dim>
  ConflictTerm<dim>::ConflictTerm(
    const std::vector<ImplicitBoundary<dim> *> &boundaries,
    const std::vector<GridCondition<dim>>      &conditions,
    const std::vector<double>                  &times)
    : boundaries(boundaries)
    , conditions(conditions)
    , times(times)
  {}



  template <int dim>
  std::vector<Effect>
  ConflictTerm<dim>::effects(const StepContext<dim> &) const
  {
    std::vector<Effect> notes;
    for (const Conflict &conflict : conflicts)
      {
        // Rounding may decide which of two lets go.
        std::string a = name(conflict.first), b = name(conflict.second);
        if (b < a)
          std::swap(a, b);
        std::ostringstream text;
        text << "they move differently in a cell at (" << conflict.x << ")";
        if (conflict.cells.size() > 1)
          text << " and " << conflict.cells.size() - 1 << " more";
        text << ", which cannot follow both; smaller cells narrow the gap";
        notes.push_back({a + " and " + b, "note", text.str()});
      }
    return notes;
  }



  template <int dim>
  std::vector<ConflictingPiece<dim>>
  ConflictTerm<dim>::find_pieces(const StepContext<dim> &context) const
  {
    const GridSpace<dim>      &space = context.state.grid();
    const PrescribedNodes<dim> prescribed =
      find_prescribed_nodes(conditions, space, context.t_start);
    const FreeNodes<dim>         free_nodes(context.state, prescribed);
    std::vector<LocalPiece<dim>> all;
    for (unsigned int b = 0; b < boundaries.size(); ++b)
      add_pieces(*boundaries[b], b, space, free_nodes, all);
    const std::vector<bool> several =
      nodes_of_several(space, all, prescribed, boundaries.size());

    std::vector<Piece> pieces;
    std::vector<bool>  seen(space.n_nodes(), false);
    for (auto &[piece, nodes] : all)
      {
        if (std::none_of(nodes.begin(), nodes.end(), [&](const auto node) {
              return several[node];
            }))
          continue;
        for (const unsigned int node : nodes)
          {
            seen[node] = true;
            piece.nodes.push_back(space.node_dof(node));
          }
        pieces.push_back(std::move(piece));
      }
    for (const auto &entry : prescribed.entries)
      if (seen[entry.node])
        {
          Piece piece;
          piece.owner     = boundaries.size() + entry.condition;
          piece.cell      = entry.component;
          piece.must_hold = true;
          piece.nodes     = {space.node_dof(entry.node)};
          SymmetricTensor<2, dim> M;
          M[entry.component][entry.component] = 1;
          piece.places.push_back({space.node_position(entry.node), M, {1.}});
          pieces.push_back(piece);
        }
    return pieces;
  }



  template <int dim>
  bool
  ConflictTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    std::vector<unsigned int> now;
    for (const auto *boundary : boundaries)
      now.push_back(boundary->n_searches());
    // Pieces that were found anew hold again; those of before are as they were.
    if (boundaries.size() + conditions.size() < 2 || now == searches)
      return false;
    std::vector<Piece> pieces;
    for (auto &of_one_rank :
         Utilities::MPI::all_gather(context.state.grid().communicator(),
                                    find_pieces(context)))
      for (Piece &piece : of_one_rank)
        pieces.push_back(std::move(piece));
    // The same for any number of ranks; several know a node.
    const auto key = [](const Piece &piece) {
      return std::make_tuple(piece.owner, piece.cell, piece.nodes);
    };
    std::sort(pieces.begin(),
              pieces.end(),
              [&key](const Piece &a, const Piece &b) {
                return key(a) < key(b);
              });
    pieces.erase(std::unique(pieces.begin(),
                             pieces.end(),
                             [&key](const Piece &a, const Piece &b) {
                               return key(a) == key(b);
                             }),
                 pieces.end());

    std::vector<PrescribedIncrements<dim>> of_owners =
      increments(context.t_start);
    check_own_values(pieces, of_owners);
    for (auto &of_owner : of_owners)
      of_owner = if_defined<dim>(of_owner);
    take_conflicts(pieces, resolve_conflicts(pieces, of_owners));
    check_that_all_hold(context);
    searches = std::move(now);
    return false;
  }



  template <int dim>
  std::vector<PrescribedIncrements<dim>>
  ConflictTerm<dim>::increments(const double now) const
  {
    std::vector<PrescribedIncrements<dim>> of_owners;
    for (const auto *boundary : boundaries)
      of_owners.push_back(boundary->increments_between(times));
    for (const auto &condition : conditions)
      of_owners.push_back([this, &condition, now](const Point<dim> &x) {
        const Point<dim>            X = condition.motion.pose(now).inverse(x);
        std::vector<Tensor<1, dim>> all;
        for (unsigned int k = 1; k < times.size(); ++k)
          all.push_back(
            condition.increment(condition.motion.pose(times[k - 1]).map(X),
                                X,
                                times[k - 1],
                                times[k]));
        return all;
      });
    return of_owners;
  }



  template <int dim>
  void
  ConflictTerm<dim>::take_conflicts(const std::vector<Piece> &pieces,
                                    const ConflictDecisions  &decisions)
  {
    conflicts.clear();
    const std::vector<unsigned int>    &given_way = decisions.given_way;
    std::vector<std::set<unsigned int>> let_go(boundaries.size()),
      shared(let_go);
    for (unsigned int p = 0; p < pieces.size(); ++p)
      {
        if (decisions.sees_another[p] && pieces[p].owner < boundaries.size())
          shared[pieces[p].owner].insert(pieces[p].cell);
        if (given_way[p] == pieces[p].owner)
          continue;
        let_go[pieces[p].owner].insert(pieces[p].cell);
        const unsigned int first  = std::min(pieces[p].owner, given_way[p]),
                           second = std::max(pieces[p].owner, given_way[p]);
        auto conflict =
          std::find_if(conflicts.begin(), conflicts.end(), [&](const auto &m) {
            return m.first == first && m.second == second;
          });
        if (conflict == conflicts.end())
          conflict =
            conflicts.insert(conflicts.end(),
                             {first, second, pieces[p].places[0].x, {}});
        conflict->cells.insert(pieces[p].cell);
      }
    const auto all_but = [](const std::set<unsigned int> &cells) {
      return [&cells](const unsigned int c) { return cells.count(c) == 0; };
    };
    for (unsigned int b = 0; b < boundaries.size(); ++b)
      {
        // Nodes can follow means of two motions, but not slopes, too.
        boundaries[b]->hold_in_cells(all_but(let_go[b]), all_but(shared[b]));
      }
  }



  template <int dim>
  void
  ConflictTerm<dim>::check_that_all_hold(const StepContext<dim> &context) const
  {
    const MPI_Comm communicator = context.state.grid().communicator();
    for (const Conflict &conflict : conflicts)
      for (const unsigned int owner : {conflict.first, conflict.second})
        {
          if (owner >= boundaries.size())
            continue;
          const auto &points = boundaries[owner]->points();
          const bool  holds =
            std::any_of(points.begin(), points.end(), [](const auto &point) {
              return point.holds;
            });
          if (!Utilities::MPI::logical_or(holds, communicator))
            {
              std::ostringstream message;
              message << "'" << name(conflict.first) << "' and '"
                      << name(conflict.second)
                      << "' prescribe different motions at (" << conflict.x
                      << "), in all cells that '" << name(owner)
                      << "' cuts, allowed: smaller cells, or surfaces that "
                         "end a cell apart";
              throw InputError(message.str());
            }
        }
  }



  template class ConflictTerm<2>;
  template class ConflictTerm<3>;
} // namespace moraine
