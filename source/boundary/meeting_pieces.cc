// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/meeting_pieces.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What may be missed, over what motions differ by. */
    constexpr double tolerance_of_pieces = 1e-3;

    /** What nodes of a cell may differ by from their mean, over the same.
     * Across a gap of a cell it is 1/2, in a turn about where surfaces meet
     * half the square root of dim; the more the narrower a gap is. */
    constexpr double largest_difference = 0.9;

    /** Weight of differences in cells against what is missed. */
    constexpr double weight_of_differences = 1e-6;

    using Node = types::global_dof_index;



    /** Pieces, and what their owners prescribe relative to each other. */
    template <int dim>
    class Meeting
    {
    public:
      Meeting(const std::vector<MeetingPiece<dim>>         &pieces,
              const std::vector<PrescribedIncrements<dim>> &increments);

      /** The largest difference between the motions of two owners, along what
       * they hold; zero if it is round-off. */
      double
      difference(const unsigned int a, const unsigned int b) const
      {
        return differences[a * n_owners + b];
      }

      /** Whether what piece @p q holds is part of what @p p holds, and moves
       * otherwise there. */
      bool
      is_in_the_way(const unsigned int q, const unsigned int p) const;

      /** Numbers of pieces in the order in which they are taken. */
      std::vector<unsigned int>
      order() const;

      /** Those of @p taken that have a node of @p piece. */
      std::vector<unsigned int>
      around(const unsigned int piece, const std::vector<bool> &taken) const;

      /** Whether increments of nodes that differ little satisfy @p some pieces,
       * relative to the motion of owner @p reference; @p scale is the
       * difference of motions. */
      bool
      agree(const std::vector<unsigned int> &some,
            const unsigned int               reference,
            const double                     scale) const;

    private:
      /** @f$M (g - g_r)@f$ at a place of a piece in a span. */
      Tensor<1, dim>
      relative(const unsigned int piece,
               const unsigned int place,
               const unsigned int reference,
               const unsigned int span) const
      {
        const auto &g = values[piece][place];
        return pieces[piece].places[place].M *
               (g[pieces[piece].owner][span] - g[reference][span]);
      }

      void
      find_differences();

      /** Add the equations of a piece whose nodes have the numbers @p at, with
       * a right-hand side for each span. */
      void
      add(const unsigned int               piece,
          const std::vector<unsigned int> &at,
          const unsigned int               reference,
          LAPACKFullMatrix<double>        &matrix,
          LAPACKFullMatrix<double>        &sides) const;

      /** Whether @p u satisfies them. */
      bool
      satisfies(const LAPACKFullMatrix<double>  &u,
                const unsigned int               piece,
                const std::vector<unsigned int> &at,
                const unsigned int               reference,
                const double                     scale) const;

      const std::vector<MeetingPiece<dim>>         &pieces;
      const std::vector<PrescribedIncrements<dim>> &increments;
      const unsigned int                            n_owners;
      unsigned int                                  n_spans = 0;
      /** By piece, place, owner and span. */
      std::vector<std::vector<std::vector<std::vector<Tensor<1, dim>>>>> values;
      std::vector<double>                       differences;
      std::map<Node, std::vector<unsigned int>> pieces_of_nodes;
    };



    template <int dim>
    Meeting<dim>::Meeting(
      const std::vector<MeetingPiece<dim>>         &pieces,
      const std::vector<PrescribedIncrements<dim>> &increments)
      : pieces(pieces)
      , increments(increments)
      , n_owners(increments.size())
      , values(pieces.size())
      , differences(n_owners * n_owners, 0.)
    {
      for (unsigned int p = 0; p < pieces.size(); ++p)
        for (const Node node : pieces[p].nodes)
          pieces_of_nodes[node].push_back(p);
      for (unsigned int p = 0; p < pieces.size(); ++p)
        for (const auto &place : pieces[p].places)
          {
            values[p].emplace_back();
            for (const auto &of_owner : increments)
              values[p].back().push_back(of_owner(place.x));
            const auto own = values[p].back()[pieces[p].owner];
            for (auto &of_owner : values[p].back())
              if (of_owner.empty())
                of_owner = own;
            n_spans = own.size();
          }
      find_differences();
    }



    template <int dim>
    void
    Meeting<dim>::find_differences()
    {
      for (unsigned int p = 0; p < pieces.size(); ++p)
        for (unsigned int k = 0; k < pieces[p].places.size(); ++k)
          for (unsigned int b = 0; b < n_owners; ++b)
            for (unsigned int s = 0; s < n_spans; ++s)
              {
                const unsigned int a  = pieces[p].owner;
                const double       by = relative(p, k, b, s).norm();
                const double       round_off =
                  1e-9 * std::max(values[p][k][a][s].norm(),
                                  values[p][k][b][s].norm()) +
                  1e-14 * pieces[p].places[k].x.norm();
                if (by <= round_off)
                  continue;
                for (double *of : {&differences[a * n_owners + b],
                                   &differences[b * n_owners + a]})
                  *of = std::max(*of, by);
              }
    }



    template <int dim>
    bool
    Meeting<dim>::is_in_the_way(const unsigned int q,
                                const unsigned int p) const
    {
      const unsigned int other = pieces[q].owner;
      const double       little =
        tolerance_of_pieces * difference(pieces[p].owner, other);
      if (!(little > 0))
        return false;
      for (unsigned int k = 0; k < pieces[p].places.size(); ++k)
        for (unsigned int s = 0; s < n_spans; ++s)
          {
            const Tensor<1, dim> g = relative(p, k, other, s);
            for (const auto &place : pieces[q].places)
              if ((place.M * g).norm() > little)
                return true;
          }
      return false;
    }



    template <int dim>
    std::vector<unsigned int>
    Meeting<dim>::order() const
    {
      std::map<Node, std::set<unsigned int>> owners;
      for (const auto &piece : pieces)
        for (const Node node : piece.nodes)
          owners[node].insert(piece.owner);
      // Whole numbers, so that round-off does not decide.
      using Key =
        std::tuple<bool, long, long, unsigned int, unsigned int, unsigned int>;
      std::vector<Key> keys;
      double           largest = 0;
      for (const auto &piece : pieces)
        largest = std::max(largest, piece.area);
      for (unsigned int p = 0; p < pieces.size(); ++p)
        {
          const MeetingPiece<dim> &piece = pieces[p];
          double                   share = 0;
          for (unsigned int a = 0; a < piece.nodes.size(); ++a)
            if (std::any_of(owners[piece.nodes[a]].begin(),
                            owners[piece.nodes[a]].end(),
                            [&](const unsigned int other) {
                              return difference(piece.owner, other) > 0;
                            }))
              for (const auto &place : piece.places)
                share += std::abs(place.N[a]) / piece.places.size();
          keys.emplace_back(!piece.must_hold,
                            std::lround(1e3 * share),
                            -std::lround(1e3 * piece.area / largest),
                            piece.owner,
                            piece.cell,
                            p);
        }
      std::sort(keys.begin(), keys.end());
      std::vector<unsigned int> numbers;
      for (const Key &key : keys)
        numbers.push_back(std::get<5>(key));
      return numbers;
    }



    template <int dim>
    std::vector<unsigned int>
    Meeting<dim>::around(const unsigned int       piece,
                         const std::vector<bool> &taken) const
    {
      std::set<unsigned int> found;
      for (const Node node : pieces[piece].nodes)
        for (const unsigned int other : pieces_of_nodes.at(node))
          if (taken[other])
            found.insert(other);
      return {found.begin(), found.end()};
    }



    template <int dim>
    void
    Meeting<dim>::add(const unsigned int               piece,
                      const std::vector<unsigned int> &at,
                      const unsigned int               reference,
                      LAPACKFullMatrix<double>        &matrix,
                      LAPACKFullMatrix<double>        &sides) const
    {
      const unsigned int n        = at.size();
      const auto        &places   = pieces[piece].places;
      const unsigned int n_places = places.size();
      for (unsigned int k = 0; k < n_places; ++k)
        {
          const auto &N = places[k].N;
          const auto &M = places[k].M;
          for (unsigned int s = 0; s < n_spans; ++s)
            {
              const auto g = relative(piece, k, reference, s);
              for (unsigned int a = 0; a < n; ++a)
                for (unsigned int i = 0; i < dim; ++i)
                  sides(dim * at[a] + i, s) += N[a] / n_places * g[i];
            }
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < dim; ++j)
                  matrix(dim * at[a] + i, dim * at[b] + j) +=
                    N[a] * N[b] / n_places * M[i][j];
        }
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            matrix(dim * at[a] + i, dim * at[b] + i) +=
              weight_of_differences * ((a == b ? 1. : 0.) - 1. / n);
    }



    template <int dim>
    bool
    Meeting<dim>::satisfies(const LAPACKFullMatrix<double>  &u,
                            const unsigned int               piece,
                            const std::vector<unsigned int> &at,
                            const unsigned int               reference,
                            const double                     scale) const
    {
      const auto        &places = pieces[piece].places;
      const unsigned int n      = at.size();
      for (unsigned int s = 0; s < n_spans; ++s)
        {
          std::vector<Tensor<1, dim>> of_nodes(n);
          Tensor<1, dim>              mean;
          for (unsigned int a = 0; a < n; ++a)
            {
              for (unsigned int i = 0; i < dim; ++i)
                of_nodes[a][i] = u(dim * at[a] + i, s);
              mean += of_nodes[a] / n;
            }
          for (const auto &of_node : of_nodes)
            if ((of_node - mean).norm() > largest_difference * scale)
              return false;
          for (unsigned int k = 0; k < places.size(); ++k)
            {
              Tensor<1, dim> here;
              for (unsigned int a = 0; a < n; ++a)
                here += places[k].N[a] * of_nodes[a];
              if ((places[k].M * here - relative(piece, k, reference, s))
                    .norm() > tolerance_of_pieces * scale)
                return false;
            }
        }
      return true;
    }



    template <int dim>
    bool
    Meeting<dim>::agree(const std::vector<unsigned int> &some,
                        const unsigned int               reference,
                        const double                     scale) const
    {
      std::map<Node, unsigned int>           numbers;
      std::vector<std::vector<unsigned int>> at;
      for (const unsigned int p : some)
        {
          at.emplace_back();
          for (const Node node : pieces[p].nodes)
            at.back().push_back(
              numbers.emplace(node, numbers.size()).first->second);
        }
      const unsigned int       n = dim * numbers.size();
      LAPACKFullMatrix<double> matrix(n, n), u(n, n_spans);
      for (unsigned int k = 0; k < some.size(); ++k)
        add(some[k], at[k], reference, matrix, u);
      // What nothing holds stays.
      for (unsigned int i = 0; i < n; ++i)
        matrix(i, i) += 1e-4 * weight_of_differences;
      matrix.compute_lu_factorization();
      matrix.solve(u);
      for (unsigned int k = 0; k < some.size(); ++k)
        if (!satisfies(u, some[k], at[k], reference, scale))
          return false;
      return true;
    }
  } // namespace



  template <int dim>
  MeetingDecisions
  decide_meetings(const std::vector<MeetingPiece<dim>>         &pieces,
                  const std::vector<PrescribedIncrements<dim>> &increments)
  {
    MeetingDecisions decisions;
    for (const auto &piece : pieces)
      decisions.given_way.push_back(piece.owner);
    decisions.sees_another.assign(pieces.size(), false);
    if (pieces.empty())
      return decisions;
    const Meeting<dim> meeting(pieces, increments);
    std::vector<bool>  taken(pieces.size(), true);
    for (unsigned int p = 0; p < pieces.size(); ++p)
      {
        const std::vector<unsigned int> some = meeting.around(p, taken);
        decisions.sees_another[p] =
          std::any_of(some.begin(), some.end(), [&](const unsigned int q) {
            return meeting.is_in_the_way(q, p);
          });
      }
    taken.assign(pieces.size(), false);
    for (const unsigned int p : meeting.order())
      {
        const unsigned int        owner = pieces[p].owner;
        std::vector<unsigned int> some  = meeting.around(p, taken);
        unsigned int              other = owner;
        for (const unsigned int q : some)
          if (meeting.difference(owner, pieces[q].owner) >
              meeting.difference(owner, other))
            other = pieces[q].owner;
        some.push_back(p);
        taken[p] = other == owner || pieces[p].must_hold ||
                   meeting.agree(some, owner, meeting.difference(owner, other));
        if (!taken[p])
          decisions.given_way[p] = other;
      }
    return decisions;
  }



  template MeetingDecisions
  decide_meetings(const std::vector<MeetingPiece<2>> &,
                  const std::vector<PrescribedIncrements<2>> &);
  template MeetingDecisions
  decide_meetings(const std::vector<MeetingPiece<3>> &,
                  const std::vector<PrescribedIncrements<3>> &);
} // namespace moraine
