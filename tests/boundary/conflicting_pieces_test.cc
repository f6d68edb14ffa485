// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/conflicting_pieces.h>

#include <gtest/gtest.h>

#include <functional>

using namespace moraine;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  /** What @p owner holds from @p begin to @p end in a cell of size 1 of a row
   * on a line; node k is at x = k. */
  ConflictingPiece<2>
  piece(const unsigned int           owner,
        const unsigned int           cell,
        const double                 begin,
        const double                 end,
        const SymmetricTensor<2, 2> &M = dealii::unit_symmetric_tensor<2>())
  {
    ConflictingPiece<2> of;
    of.owner = owner;
    of.cell  = cell;
    of.area  = end - begin;
    of.h     = 1;
    of.nodes = {cell, cell + 1};
    for (const double s : {0.2, 0.8})
      {
        const double x = begin + s * (end - begin);
        of.places.push_back({{x, 0.}, M, {1 - (x - cell), x - cell}});
      }
    return of;
  }

  /** Two owners, the first of which ends at @p x in a row of four cells. */
  std::vector<ConflictingPiece<2>>
  row(const double x)
  {
    std::vector<ConflictingPiece<2>> pieces;
    for (unsigned int cell = 0; cell < 4; ++cell)
      {
        if (cell < x)
          pieces.push_back(piece(0, cell, cell, std::min(cell + 1., x)));
        if (cell + 1 > x)
          pieces.push_back(piece(1, cell, std::max(1. * cell, x), cell + 1.));
      }
    return pieces;
  }

  PrescribedIncrements<2>
  motion(const std::function<Tensor<1, 2>(const Point<2> &)> &g)
  {
    return [g](const Point<2> &x) {
      return std::vector<Tensor<1, 2>>{Tensor<1, 2>(), g(x)};
    };
  }

  const auto rests = motion([](const Point<2> &) { return Tensor<1, 2>(); });
  const auto sinks = motion([](const Point<2> &) {
    return Tensor<1, 2>({0., -0.1});
  });

  using Owners = std::vector<unsigned int>;
} // namespace

TEST(ConflictingPieces, ACellInWhichTwoMoveDifferentlyFollowsNeither)
{
  for (const double x : {2.02, 2.3, 2.98})
    EXPECT_EQ(resolve_conflicts<2>(row(x), {sinks, rests}).given_way,
              (Owners{0, 0, 1, 0, 1}))
      << x;
}

TEST(ConflictingPieces, AtANodeTheSecondLetsGo)
{
  EXPECT_EQ(resolve_conflicts<2>(row(2.), {sinks, rests}).given_way,
            (Owners{0, 0, 0, 1}));
}

TEST(ConflictingPieces, ThoseThatMoveTogetherHold)
{
  const Owners all = {0, 0, 0, 1, 1};
  EXPECT_EQ(resolve_conflicts<2>(row(2.3), {rests, rests}).given_way, all);
  EXPECT_EQ(resolve_conflicts<2>(row(2.3), {sinks, sinks}).given_way, all);
  const auto turns = motion([](const Point<2> &x) {
    return 0.1 * Tensor<1, 2>({-x[1], x[0] - 1e5});
  });
  EXPECT_EQ(resolve_conflicts<2>(row(2.3), {turns, turns}).given_way, all);
}

TEST(ConflictingPieces, ATurnAboutWhereTheyMeetIsFollowedByNodesOnly)
{
  // One cell cannot bend at 2.3; at a node it does.
  const auto turns = [](const double at) {
    return motion([at](const Point<2> &x) {
      return 0.1 * Tensor<1, 2>({0., x[0] - at});
    });
  };
  EXPECT_EQ(resolve_conflicts<2>(row(2.), {turns(2.), rests}).given_way,
            (Owners{0, 0, 1, 1}));
  EXPECT_NE(resolve_conflicts<2>(row(2.3), {turns(2.3), rests}).given_way,
            (Owners{0, 0, 0, 1, 1}));
}

TEST(ConflictingPieces, RollersOfOtherComponentsHold)
{
  std::vector<ConflictingPiece<2>> pieces = row(2.3);
  for (auto &of : pieces)
    for (auto &place : of.places)
      {
        place.M                             = SymmetricTensor<2, 2>();
        place.M[1 - of.owner][1 - of.owner] = 1;
      }
  const ConflictDecisions decisions =
    resolve_conflicts<2>(pieces, {sinks, rests});
  EXPECT_EQ(decisions.given_way, (Owners{0, 0, 0, 1, 1}));
  EXPECT_EQ(decisions.sees_another, std::vector<bool>(5, false));
}

TEST(ConflictingPieces, ThoseThatShareNodesSeeEachOther)
{
  // All nodes of the last cell of one are of the first of the other, and one of
  // the cells beside them.
  EXPECT_EQ(resolve_conflicts<2>(row(2.3), {sinks, rests}).sees_another,
            (std::vector<bool>{false, true, true, true, true}));
  EXPECT_EQ(resolve_conflicts<2>(row(2.3), {rests, rests}).sees_another,
            std::vector<bool>(5, false));
}

TEST(ConflictingPieces, NodesThatArePrescribedStay)
{
  std::vector<ConflictingPiece<2>> pieces = {piece(0, 0, 0., 1.),
                                             piece(0, 1, 1., 2.)};
  ConflictingPiece<2>              node;
  node.owner     = 1;
  node.must_hold = true;
  node.nodes     = {0};
  node.places.push_back({{0., 0.}, dealii::unit_symmetric_tensor<2>(), {1.}});
  pieces.push_back(node);
  EXPECT_EQ(resolve_conflicts<2>(pieces, {sinks, rests}).given_way,
            (Owners{1, 0, 1}));
}
