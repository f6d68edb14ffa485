// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_body_behind_h
#define moraine_boundary_body_behind_h

#include <moraine/geometry/covered_pieces.h>

#include <functional>
#include <vector>

namespace moraine
{
  /**
   * Of a surface that may be longer than the body that it holds: behind which
   * of its places the body is. What is asked is remembered, so that pieces are
   * found again only when an answer is another one.
   */
  template <int dim>
  class BodyBehind
  {
  public:
    /** Whether a body covers place @p x, or would if it were larger by @p
     * margin, as far as points of the active cell @p cell tell. */
    using Covers = std::function<bool(const unsigned int        cell,
                                      const dealii::Point<dim> &x,
                                      const double              margin)>;

    /** Forget what was asked. Without @p covers a body is everywhere. */
    void
    ask(const Covers &covers)
    {
      this->covers = covers;
      asked.clear();
    }

    /** From now on a body is everywhere; what was asked is remembered. */
    void
    stop_asking()
    {
      covers = {};
    }

    /** Whether @p covers gives all answers of before; always if nothing was
     * asked. */
    bool
    is_still_so(const Covers &covers) const;

    /** Whether a body is at the surface, or nearly. @p normal is the outward
     * one, @p h the size of the cell. */
    bool
    at(const unsigned int            cell,
       const dealii::Point<dim>     &x,
       const dealii::Tensor<1, dim> &normal,
       const double                  h)
    {
      return !covers || is_at_body(in_cell(cell), x, normal, h);
    }

    /** Whether one is within half a cell behind it. */
    bool
    near(const unsigned int            cell,
         const dealii::Point<dim>     &x,
         const dealii::Tensor<1, dim> &normal,
         const double                  h)
    {
      return !covers || is_near_body(in_cell(cell), x, normal, h);
    }

  private:
    struct Question
    {
      unsigned int       cell;
      dealii::Point<dim> x;
      double             margin;
      bool               answer;
    };

    /** Ask, and remember. */
    moraine::Covers<dim>
    in_cell(const unsigned int cell);

    Covers                covers;
    std::vector<Question> asked;
  };
} // namespace moraine

#endif
