// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/conflicting_pieces.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
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

    /** Solutions with what the last one missed added to the values: differences
     * in cells then take next to nothing of what can be met. */
    constexpr unsigned int n_corrections = 4;

    using Node = types::global_dof_index;



    /** Solve for @p u, its right-hand sides on entry: those increments with
     * little of @p penalty that satisfy @p constraint if any do. */
    void
    satisfy(const LAPACKFullMatrix<double> &constraint,
            LAPACKFullMatrix<double>       &penalised,
            LAPACKFullMatrix<double>       &u)
    {
      const LAPACKFullMatrix<double> wanted = u;
      LAPACKFullMatrix<double>       sides = u, met = u;
      penalised.set_property(LAPACKSupport::symmetric);
      penalised.compute_cholesky_factorization();
      penalised.solve(u);
      for (unsigned int k = 0; k < n_corrections; ++k)
        {
          constraint.mmult(met, u);
          sides.add(1., wanted);
          sides.add(-1., met);
          u = sides;
          penalised.solve(u);
        }
    }



    /** Pieces whose owners prescribe different motions of shared nodes. */
    template <int dim>
    class Conflicts
    {
    public:
      Conflicts(const std::vector<ConflictingPiece<dim>>     &pieces,
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
      is_in_the_way(const unsigned int q, const unsigned int p) const
      {
        const unsigned int other = pieces[q].owner;
        const double       little =
          tolerance_of_pieces * difference(pieces[p].owner, other);
        if (!(little > 0))
          return false;
        for (unsigned int k = 0; k < pieces[p].places.size(); ++k)
          for (unsigned int s = 0; s < n_spans; ++s)
            {
              const Tensor<1, dim> g = relative({p, k, other}, s);
              for (const auto &place : pieces[q].places)
                if ((place.M * g).norm() > little)
                  return true;
            }
        return false;
      }

      /** Numbers of pieces in the order in which they are taken. */
      std::vector<unsigned int>
      order() const
      {
        std::map<Node, std::set<unsigned int>> owners;
        for (const auto &piece : pieces)
          for (const Node node : piece.nodes)
            owners[node].insert(piece.owner);
        // Whole numbers, so that round-off does not decide.
        using Key = std::
          tuple<bool, long, long, unsigned int, unsigned int, unsigned int>;
        std::vector<Key> keys;
        double           largest = 0;
        for (const auto &piece : pieces)
          largest = std::max(largest, piece.area);
        for (unsigned int p = 0; p < pieces.size(); ++p)
          {
            const ConflictingPiece<dim> &piece = pieces[p];
            double                       share = 0;
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

      /** Those of @p taken that have a node of @p piece. */
      std::vector<unsigned int>
      around(const unsigned int piece, const std::vector<bool> &taken) const
      {
        std::set<unsigned int> found;
        for (const Node node : pieces[piece].nodes)
          for (const unsigned int other : pieces_of_nodes.at(node))
            if (taken[other])
              found.insert(other);
        return {found.begin(), found.end()};
      }

      /** Whether increments of nodes that differ little satisfy @p some pieces,
       * relative to the motion of owner @p reference; @p scale is the
       * difference of motions. */
      bool
      agree(const std::vector<unsigned int> &some,
            const unsigned int               reference,
            const double                     scale) const
      {
        if (a_linear_field_satisfies(some, reference, scale))
          return true;

        std::map<Node, unsigned int>           numbers;
        std::vector<std::vector<unsigned int>> at; // of the nodes of pieces
        for (const unsigned int p : some)
          {
            at.emplace_back();
            for (const Node node : pieces[p].nodes)
              at.back().push_back(
                numbers.emplace(node, numbers.size()).first->second);
          }
        const unsigned int       n = dim * numbers.size();
        LAPACKFullMatrix<double> constraint(n, n), u(n, n_spans);
        for (unsigned int k = 0; k < some.size(); ++k)
          {
            const auto &places = pieces[some[k]].places;
            for (unsigned int q = 0; q < places.size(); ++q)
              add({some[k], q, reference},
                  places[q].N,
                  at[k],
                  1. / places.size(),
                  constraint,
                  u);
          }
        LAPACKFullMatrix<double> penalised = constraint;
        for (const auto &of_piece : at)
          add_differences(of_piece, penalised);
        // What nothing holds stays.
        for (unsigned int i = 0; i < n; ++i)
          penalised(i, i) += 1e-4 * weight_of_differences;
        satisfy(constraint, penalised, u);
        for (unsigned int k = 0; k < some.size(); ++k)
          if (!satisfies(u, some[k], at[k], reference, scale))
            return false;
        return true;
      }

      /** Whether one linear field satisfies all pieces. */
      bool
      all_meet_a_linear_field() const
      {
        double smallest = 0;
        for (const double by : differences)
          if (by > 0 && (smallest == 0 || by < smallest))
            smallest = by;
        std::vector<unsigned int> all(pieces.size());
        std::iota(all.begin(), all.end(), 0);
        return smallest == 0 ||
               a_linear_field_satisfies(all, pieces[0].owner, smallest);
      }

    private:
      /** A place of a piece, and the owner whose motion is taken off. */
      struct Equation
      {
        unsigned int piece;
        unsigned int place;
        unsigned int reference;
      };

      const SymmetricTensor<2, dim> &
      projection(const Equation &of) const
      {
        return pieces[of.piece].places[of.place].M;
      }

      /** @f$M (g - g_r)@f$ in a span. */
      Tensor<1, dim>
      relative(const Equation &of, const unsigned int span) const
      {
        const auto &g = values[of.piece][of.place];
        return projection(of) *
               (g[pieces[of.piece].owner][span] - g[of.reference][span]);
      }

      void
      find_differences()
      {
        for (unsigned int p = 0; p < pieces.size(); ++p)
          for (unsigned int k = 0; k < pieces[p].places.size(); ++k)
            for (unsigned int b = 0; b < n_owners; ++b)
              for (unsigned int s = 0; s < n_spans; ++s)
                {
                  const unsigned int a  = pieces[p].owner;
                  const double       by = relative({p, k, b}, s).norm();
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

      /** Add @p share of @f$N^T M N u = N^T M (g - g_r)@f$; the functions @p N
       * are those of the vectors @p at of u. */
      template <class Values>
      void
      add(const Equation                  &of,
          const Values                    &N,
          const std::vector<unsigned int> &at,
          const double                     share,
          LAPACKFullMatrix<double>        &constraint,
          LAPACKFullMatrix<double>        &sides) const
      {
        for (unsigned int s = 0; s < n_spans; ++s)
          {
            const Tensor<1, dim> g = share * relative(of, s);
            for (unsigned int a = 0; a < at.size(); ++a)
              for (unsigned int i = 0; i < dim; ++i)
                sides(dim * at[a] + i, s) += N[a] * g[i];
          }
        for (unsigned int a = 0; a < at.size(); ++a)
          for (unsigned int b = 0; b < at.size(); ++b)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                constraint(dim * at[a] + i, dim * at[b] + j) +=
                  share * N[a] * N[b] * projection(of)[i][j];
      }

      /** Whether u satisfies an equation in a span. */
      template <class Values>
      bool
      holds(const Equation                  &of,
            const Values                    &N,
            const std::vector<unsigned int> &at,
            const LAPACKFullMatrix<double>  &u,
            const unsigned int               span,
            const double                     scale) const
      {
        Tensor<1, dim> here;
        for (unsigned int a = 0; a < at.size(); ++a)
          for (unsigned int i = 0; i < dim; ++i)
            here[i] += N[a] * u(dim * at[a] + i, span);
        return (projection(of) * here - relative(of, span)).norm() <=
               tolerance_of_pieces * scale;
      }

      /** Add what makes nodes of a piece differ little. */
      void
      add_differences(const std::vector<unsigned int> &at,
                      LAPACKFullMatrix<double>        &matrix) const
      {
        for (const unsigned int a : at)
          for (const unsigned int b : at)
            for (unsigned int i = 0; i < dim; ++i)
              matrix(dim * a + i, dim * b + i) +=
                weight_of_differences * ((a == b ? 1. : 0.) - 1. / at.size());
      }

      /** Whether @p u of nodes with the numbers @p at satisfies a piece. */
      bool
      satisfies(const LAPACKFullMatrix<double>  &u,
                const unsigned int               piece,
                const std::vector<unsigned int> &at,
                const unsigned int               reference,
                const double                     scale) const
      {
        for (unsigned int s = 0; s < n_spans; ++s)
          {
            std::vector<Tensor<1, dim>> of_nodes(at.size());
            Tensor<1, dim>              mean;
            for (unsigned int a = 0; a < at.size(); ++a)
              {
                for (unsigned int i = 0; i < dim; ++i)
                  of_nodes[a][i] = u(dim * at[a] + i, s);
                mean += of_nodes[a] / double(at.size());
              }
            for (const auto &of_node : of_nodes)
              if ((of_node - mean).norm() > largest_difference * scale)
                return false;
            const auto &places = pieces[piece].places;
            for (unsigned int k = 0; k < places.size(); ++k)
              if (!holds({piece, k, reference}, places[k].N, at, u, s, scale))
                return false;
          }
        return true;
      }

      /** Whether a linear field, @f$u(x) = c + A x@f$, which the functions of
       * any cells have, tied or not, satisfies @p some pieces. */
      bool
      a_linear_field_satisfies(const std::vector<unsigned int> &some,
                               const unsigned int               reference,
                               const double                     scale) const
      {
        const Point<dim> middle = pieces[some[0]].places[0].x;
        double           length = 0, h = 0;
        for (const unsigned int p : some)
          {
            h = std::max(h, pieces[p].h);
            for (const auto &place : pieces[p].places)
              length = std::max(length, place.x.distance(middle));
          }
        if (!(length > 0))
          return false;
        const auto functions = [&](const Equation &of) {
          std::array<double, dim + 1> N;
          N[dim] = 1;
          for (unsigned int j = 0; j < dim; ++j)
            N[j] =
              (pieces[of.piece].places[of.place].x[j] - middle[j]) / length;
          return N;
        };
        std::vector<Equation> equations;
        for (const unsigned int p : some)
          for (unsigned int k = 0; k < pieces[p].places.size(); ++k)
            equations.push_back({p, k, reference});
        std::vector<unsigned int> at(dim + 1);
        std::iota(at.begin(), at.end(), 0u);

        constexpr unsigned int   n = dim * (dim + 1);
        LAPACKFullMatrix<double> constraint(n, n), u(n, n_spans);
        for (const Equation &of : equations)
          add(of, functions(of), at, 1., constraint, u);
        LAPACKFullMatrix<double> penalised = constraint;
        const double             small     = 1e-10 * constraint.trace();
        for (unsigned int i = 0; i < n; ++i)
          penalised(i, i) += small;
        satisfy(constraint, penalised, u);

        for (unsigned int s = 0; s < n_spans; ++s)
          {
            double square = 0;
            for (unsigned int i = 0; i < dim * dim; ++i)
              square += u(i, s) * u(i, s);
            if (std::sqrt(dim * square) * h / 2 >
                largest_difference * scale * length)
              return false;
            for (const Equation &of : equations)
              if (!holds(of, functions(of), at, u, s, scale))
                return false;
          }
        return true;
      }

      const std::vector<ConflictingPiece<dim>>     &pieces;
      const std::vector<PrescribedIncrements<dim>> &increments;
      const unsigned int                            n_owners;
      unsigned int                                  n_spans = 0;
      /** By piece, place, owner and span. */
      std::vector<std::vector<std::vector<std::vector<Tensor<1, dim>>>>> values;
      std::vector<double>                       differences;
      std::map<Node, std::vector<unsigned int>> pieces_of_nodes;
    };
  } // namespace



  template <int dim>
  ConflictDecisions
  resolve_conflicts(const std::vector<ConflictingPiece<dim>>     &pieces,
                    const std::vector<PrescribedIncrements<dim>> &increments)
  {
    ConflictDecisions decisions;
    for (const auto &piece : pieces)
      decisions.given_way.push_back(piece.owner);
    decisions.sees_another.assign(pieces.size(), false);
    if (pieces.empty())
      return decisions;
    const Conflicts<dim> conflicts(pieces, increments);
    std::vector<bool>    taken(pieces.size(), true);
    for (unsigned int p = 0; p < pieces.size(); ++p)
      {
        const std::vector<unsigned int> some = conflicts.around(p, taken);
        decisions.sees_another[p] =
          std::any_of(some.begin(), some.end(), [&](const unsigned int q) {
            return conflicts.is_in_the_way(q, p);
          });
      }
    if (conflicts.all_meet_a_linear_field())
      return decisions;
    taken.assign(pieces.size(), false);
    for (const unsigned int p : conflicts.order())
      {
        const unsigned int        owner = pieces[p].owner;
        std::vector<unsigned int> some  = conflicts.around(p, taken);
        unsigned int              other = owner;
        for (const unsigned int q : some)
          if (conflicts.difference(owner, pieces[q].owner) >
              conflicts.difference(owner, other))
            other = pieces[q].owner;
        some.push_back(p);
        taken[p] =
          other == owner || pieces[p].must_hold ||
          conflicts.agree(some, owner, conflicts.difference(owner, other));
        if (!taken[p])
          decisions.given_way[p] = other;
      }
    return decisions;
  }



  template decltype(resolve_conflicts<2>) resolve_conflicts<2>;
  template decltype(resolve_conflicts<3>) resolve_conflicts<3>;
} // namespace moraine
