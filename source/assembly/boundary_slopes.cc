// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// How displacements vary along a piece of a surface, and what holds that.

#include <moraine/assembly/boundary_term.h>
#include <moraine/assembly/local_system.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  BoundaryTerm<dim>::add_slopes(const StepContext<dim> &context,
                                const bool              tangent,
                                GlobalSystem<dim>      &system) const
  {
    const GridSpace<dim> &space = context.state.grid();
    const unsigned int    n     = space.nodes_per_cell();
    const double          share = context.share_of_step();
    LocalSystem<dim>      local;
    for (unsigned int k = 0; k < boundary.slopes().size(); ++k)
      {
        const auto   &point = boundary.points()[boundary.slopes()[k].point];
        const double *N     = boundary.slope_of_N(k);
        const Tensor<1, dim>          t = slope_traction(context, k, share);
        const SymmetricTensor<2, dim> C =
          share * slope_stiffness(context, boundary.slopes()[k]);
        local.reinit(context.state, space.cell_nodes(point.cell), n, tangent);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            {
              local.force[dim * a + i] = point.JxW * N[a] * t[i];
              if (tangent)
                for (unsigned int b = 0; b < n; ++b)
                  for (unsigned int j = 0; j < dim; ++j)
                    local.matrix(dim * a + i, dim * b + j) =
                      point.JxW * N[a] * N[b] * C[i][j];
            }
        system.add(local, tangent);
      }
  }



  template <int dim>
  SymmetricTensor<2, dim>
  BoundaryTerm<dim>::slope_stiffness(const StepContext<dim>   &context,
                                     const BoundarySlope<dim> &slope) const
  {
    const BoundaryPoint<dim> &point = boundary.points()[slope.point];
    if (!point.holds || !slope.holds)
      return {};
    const double mu = context.cell_materials.elastic_stiffness(point.cell).mu;
    const SymmetricTensor<2, dim> M  = boundary.projection(point.normal);
    const Tensor<1, dim>          Mn = M * point.normal;
    return boundary.enforcement().slope_factor * mu / point.h *
           (M + symmetrize(outer_product(Mn, Mn)));
  }



  template <int dim>
  Tensor<1, dim>
  BoundaryTerm<dim>::slope_traction(const StepContext<dim> &context,
                                    const unsigned int      k,
                                    const double            share) const
  {
    const BoundarySlope<dim> &slope = boundary.slopes()[k];
    return slope.traction - share * slope_stiffness(context, slope) *
                              slope_violation(context, k);
  }



  template <int dim>
  Tensor<1, dim>
  BoundaryTerm<dim>::slope_violation(const StepContext<dim> &context,
                                     const unsigned int      k) const
  {
    const GridSpace<dim>     &space     = context.state.grid();
    const BoundarySlope<dim> &slope     = boundary.slopes()[k];
    const BoundaryPoint<dim> &point     = boundary.points()[slope.point];
    const double             *N         = boundary.slope_of_N(k);
    Tensor<1, dim>            violation = -slope.prescribed;
    for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
      violation += N[a] * context.increments()[space.cell_nodes(point.cell)[a]];
    return violation;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  BoundaryTerm<dim>::prepare_slopes(
    const StepContext<dim>                  &context,
    const std::vector<ConstraintState<dim>> &states)
  {
    const double                share = context.share_of_step();
    std::vector<Tensor<1, dim>> tractions;
    for (unsigned int k = 0; k < boundary.slopes().size(); ++k)
      {
        const BoundarySlope<dim> &slope = boundary.slopes()[k];
        const Point<dim>         &place = states[slope.point].place;
        // Where it moved to, if the place did.
        Tensor<1, dim> arm = slope.offset;
        if (context.balances_at_end())
          arm += share * (slope.prescribed + slope_violation(context, k));
        tractions.push_back(slope_traction(context, k, 1.));
        const Tensor<1, dim> force = boundary.points()[slope.point].JxW *
                                     slope_traction(context, k, share);
        prepared.work_of_motion +=
          work_of_motion(states.size() + k, force, slope.prescribed);
        prepared.moment +=
          moment(context, place + arm, force) - moment(context, place, force);
      }
    return tractions;
  }



#define INSTANTIATE(dim)                                                  \
  template void BoundaryTerm<dim>::add_slopes(const StepContext<dim> &,   \
                                              const bool,                 \
                                              GlobalSystem<dim> &) const; \
  template std::vector<Tensor<1, dim>> BoundaryTerm<dim>::prepare_slopes( \
    const StepContext<dim> &, const std::vector<ConstraintState<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
