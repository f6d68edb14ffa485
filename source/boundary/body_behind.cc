// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/body_behind.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  bool
  BodyBehind<dim>::is_still_so(const Covers &covers) const
  {
    return std::all_of(asked.begin(), asked.end(), [&](const Question &q) {
      return covers(q.cell, q.x, q.margin) == q.answer;
    });
  }



  template <int dim>
  moraine::Covers<dim>
  BodyBehind<dim>::in_cell(const unsigned int cell)
  {
    return [this, cell](const Point<dim> &x, const double margin) {
      asked.push_back({cell, x, margin, covers(cell, x, margin)});
      return asked.back().answer;
    };
  }



  template class BodyBehind<2>;
  template class BodyBehind<3>;
} // namespace moraine
