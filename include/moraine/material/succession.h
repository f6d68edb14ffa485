// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_succession_h
#define moraine_material_succession_h

#include <moraine/material/material_decorator.h>

#include <memory>
#include <utility>

namespace moraine
{
  /** A material that becomes another one at a time, with the same internal
   * variables and the same elasticity. A step belongs to the one of its middle.
   */
  class Succession : public MaterialDecorator
  {
  public:
    /** The @p first up to time @p start, the @p second from then on. */
    Succession(const std::shared_ptr<const Material> &first,
               std::shared_ptr<const Material>        second,
               const double                           start)
      : MaterialDecorator(first)
      , second(std::move(second))
      , start(start)
    {}

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override
    {
      at(time).respond(time, points);
    }

    void
    respond(const StepTime                       &time,
            const StrainMeasure                   measure,
            const dealii::ArrayView<TensorState> &points) const override
    {
      at(time).respond(time, measure, points);
    }

    bool
    has_symmetric_tangent() const override
    {
      return inner->has_symmetric_tangent() && second->has_symmetric_tangent();
    }

    double
    wanted_cut(const StepTime &time) const override
    {
      return at(time).wanted_cut(time);
    }

  private:
    const Material &
    at(const StepTime &time) const
    {
      return 0.5 * (time.start + time.end) > start ? *second : *inner;
    }

    const std::shared_ptr<const Material> second;
    const double                          start;
  };
} // namespace moraine

#endif
