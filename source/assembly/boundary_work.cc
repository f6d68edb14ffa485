// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The work of implicit boundaries.

#include <moraine/assembly/boundary_piece.h>
#include <moraine/assembly/boundary_term.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  BoundaryTerm<dim>::note_start(const StepContext<dim> &context)
  {
    if (context.share_of_step() < 1.)
      return;
    std::vector<ConstraintState<dim>> states;
    evaluate(context, forces_at_start, states);
    for (unsigned int q = 0; q < forces_at_start.size(); ++q)
      forces_at_start[q] *= boundary.points()[q].JxW;
    for (unsigned int k = 0; k < boundary.slopes().size(); ++k)
      forces_at_start.push_back(
        boundary.points()[boundary.slopes()[k].point].JxW *
        slope_traction(context, k, 1.));
  }



  template <int dim>
  double
  BoundaryTerm<dim>::work_of_motion(const unsigned int    k,
                                    const Tensor<1, dim> &force,
                                    const Tensor<1, dim> &prescribed) const
  {
    if (forces_at_start.empty())
      return force * prescribed;
    return 0.5 * (forces_at_start[k] + force) * prescribed;
  }



  template <int dim>
  double
  BoundaryTerm<dim>::work_of_step(const StepContext<dim> &context,
                                  const double            of_force) const
  {
    const auto                       &points   = boundary.points();
    const double                      of_start = share_of_start(context);
    std::vector<Tensor<1, dim>>       tractions;
    std::vector<ConstraintState<dim>> states;
    evaluate(context, tractions, states);
    BoundaryPiece<dim> piece;
    double             work = of_force;
    for (unsigned int q = 0; q < points.size();)
      for (piece.reinit(boundary, context, q, context.share_of_push());
           q < piece.end();
           ++q)
        {
          const BoundaryPoint<dim> &point  = points[q];
          const Tensor<1, dim>     &normal = states[q].normal;
          Tensor<1, dim>            mean   = normal + point.normal;
          mean /= mean.norm();
          const double force =
            point.JxW * (tractions[q] * normal +
                         of_start * (point.multiplier_at_start * point.normal));
          work += force * (mean - piece.constraint(q).push) *
                  piece.increment(q).value;
        }
    return context.motion->integrator().divisor() * work;
  }



#define INSTANTIATE(dim)                                                    \
  template void   BoundaryTerm<dim>::note_start(const StepContext<dim> &);  \
  template double BoundaryTerm<dim>::work_of_motion(const unsigned int,     \
                                                    const Tensor<1, dim> &, \
                                                    const Tensor<1, dim> &) \
    const;                                                                  \
  template double BoundaryTerm<dim>::work_of_step(const StepContext<dim> &, \
                                                  const double) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
