// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/body_behind.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  BodyBehind<dim>::ask(const Covers &covers)
  {
    this->covers = covers;
    asked.clear();
  }



  template <int dim>
  void
  BodyBehind<dim>::stop_asking()
  {
    covers = {};
  }



  template <int dim>
  bool
  BodyBehind<dim>::is_still_so(const Covers &covers) const
  {
    return std::all_of(asked.begin(), asked.end(), [&](const Question &q) {
      return covers(q.cell, q.x, q.margin) == q.answer;
    });
  }



  template <int dim>
  bool
  BodyBehind<dim>::at(const unsigned int    cell,
                      const Point<dim>     &x,
                      const Tensor<1, dim> &normal,
                      const double          h)
  {
    return !covers || is_at_body(in_cell(cell), x, normal, h);
  }



  template <int dim>
  bool
  BodyBehind<dim>::near(const unsigned int    cell,
                        const Point<dim>     &x,
                        const Tensor<1, dim> &normal,
                        const double          h)
  {
    return !covers || is_near_body(in_cell(cell), x, normal, h);
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
