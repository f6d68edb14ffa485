// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/water_term.h>

#include <deal.II/base/mpi.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Tensor<1, dim>
  half_lengths(const State<dim> &state, const unsigned int p)
  {
    // Points that move fill space as squares. Gauss points next to a face of a
    // cell are 0.30 times the root of their volume away from it, or more.
    const double part =
      state.mesh_after_step() == MeshAfterStep::reset ? 0.5 : 0.29;
    Tensor<1, dim> half;
    if (state.point_basis().has_domains())
      {
        const auto corners = state.point_basis().domain_corners(p);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const auto ends =
              std::minmax_element(corners.begin(),
                                  corners.end(),
                                  [d](const auto &a, const auto &b) {
                                    return a[d] < b[d];
                                  });
            half[d] = 0.5 * ((*ends.second)[d] - (*ends.first)[d]);
          }
        return half;
      }
    const double length = std::pow(state.material_points().volume(p), 1. / dim);
    for (unsigned int d = 0; d < dim; ++d)
      half[d] = part * length;
    return half;
  }



  template <int dim>
  WaterTerm<dim>::WaterTerm(const WaterInBodies<dim>           &water,
                            PointSet<dim>                      &points,
                            std::vector<const BodyForce<dim> *> gravities,
                            const StrainMeasure                 measure)
    : water(water)
    , points(points)
    , gravities(std::move(gravities))
    , follows(measure == StrainMeasure::finite && water.water)
  {}



  template <int dim>
  std::vector<Effect>
  WaterTerm<dim>::effects(const StepContext<dim> &) const
  {
    if (!water.water)
      return {};
    return {{"water", "load", "water pressure"}};
  }



  template <int dim>
  bool
  WaterTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    half.resize(points.n_local());
    for (unsigned int p = 0; p < points.n_local(); ++p)
      half[p] = half_lengths(context.state, p);
    return false;
  }



  template <int dim>
  Tensor<1, dim>
  WaterTerm<dim>::extra_weight(const StepContext<dim> &context,
                               const unsigned int      p) const
  {
    Tensor<1, dim>     weight;
    const unsigned int body = points.body(p);
    if (water.extra_density[body] == 0.)
      return weight;
    for (const BodyForce<dim> *gravity : gravities)
      if (gravity->acts_on[body])
        weight += gravity->value(gravity->at_start ?
                                   context.state.original_position(p) :
                                   points.position(p),
                                 context.t_end);
    return water.extra_density[body] * context.state.initial_volume(p) * weight;
  }



  template <int dim>
  typename WaterTerm<dim>::TrialState
  WaterTerm<dim>::trial_state(const StepContext<dim>      &context,
                              const StencilBlock<dim>     &block,
                              const unsigned int           i,
                              const LocalSystem<dim>      &local,
                              std::vector<Tensor<1, dim>> &moved) const
  {
    const State<dim>     &state     = context.state;
    const unsigned int    p         = block.points[i];
    const Tensor<1, dim> *gradients = block.grad_N(i);
    TrialState            at;
    at.x         = points.position(p);
    at.gradients = gradients;
    if (!follows)
      {
        at.v        = state.integration_volume(p);
        at.v_weight = points.volume(p);
        return at;
      }
    Tensor<2, dim> gradient;
    for (unsigned int a = 0; a < block.n_nodes; ++a)
      {
        at.x += block.N(i)[a] * local.nodal_increments[a];
        gradient += outer_product(local.nodal_increments[a], gradients[a]);
      }
    const Tensor<2, dim> dF = Physics::Elasticity::Kinematics::F(gradient);
    at.J                    = determinant(dF);
    at.v                    = at.J * state.volume_in_cell(block, i);
    at.v_weight             = state.mesh_after_step() == MeshAfterStep::reset ?
                                at.J * points.volume(p) :
                                at.v;
    const Tensor<2, dim> inverse = invert(dF);
    moved.resize(block.n_nodes);
    for (unsigned int a = 0; a < block.n_nodes; ++a)
      moved[a] = gradients[a] * inverse;
    at.gradients = moved.data();
    return at;
  }



  template <int dim>
  void
  WaterTerm<dim>::add(const StepContext<dim>  &context,
                      const StencilBlock<dim> &block,
                      const bool               tangent,
                      LocalSystem<dim>        &local) const
  {
    if (!water.water)
      return;
    std::vector<Tensor<1, dim>> moved;
    for (unsigned int i = 0; i < block.n_points; ++i)
      {
        const unsigned int p  = block.points[i];
        const TrialState   at = trial_state(context, block, i, local, moved);
        // Stress has said so already.
        if (!(at.J > 0))
          continue;
        const WaterAt<dim> here = water.water->at(at.x, half[p], context.t_end);
        const double       inside = at.v * (here.pore.value - here.outer.value);
        const Tensor<1, dim> weight = extra_weight(context, p);
        const Tensor<1, dim> f =
          here.wet * weight - at.v_weight * here.outer.gradient;
        const double *N = block.N(i);
        for (unsigned int a = 0; a < block.n_nodes; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            local.force[dim * a + d] +=
              inside * at.gradients[a][d] + N[a] * f[d];
        if (tangent && follows)
          add_tangent(here, at, N, weight, local);
      }
  }



  template <int dim>
  void
  WaterTerm<dim>::add_tangent(const WaterAt<dim>   &here,
                              const TrialState     &at,
                              const double         *N,
                              const Tensor<1, dim> &extra_weight,
                              LocalSystem<dim>     &local) const
  {
    const Tensor<1, dim> *g       = at.gradients;
    const unsigned int    n_nodes = local.nodal_increments.size();
    const double          inside  = at.v * (here.pore.value - here.outer.value);
    const Tensor<1, dim>  change =
      at.v * (here.pore.gradient - here.outer.gradient);
    const Tensor<1, dim> outer = at.v_weight * here.outer.gradient;
    const Tensor<2, dim> on_N =
      at.v_weight * Tensor<2, dim>(here.outer.curvature) -
      outer_product(extra_weight, here.wet_gradient);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            local.matrix(dim * a + i, dim * b + j) -=
              inside * (g[a][i] * g[b][j] - g[a][j] * g[b][i]) +
              g[a][i] * N[b] * change[j] - N[a] * outer[i] * g[b][j] -
              N[a] * N[b] * on_N[i][j];
  }



  template <int dim>
  void
  WaterTerm<dim>::report(const StepContext<dim> &context,
                         std::vector<BoundaryReport<dim>> &) const
  {
    set_water_at_points(water, context.t_end, context.state, points);
  }



  template <int dim>
  void
  set_water_at_points(const WaterInBodies<dim> &water,
                      const double              t,
                      const State<dim>         &state,
                      PointSet<dim>            &points)
  {
    if (!water.pore_pressure.exists())
      return;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const double pressure =
          water.water ?
            water.water->at(points.position(p), half_lengths(state, p), t)
              .pore.value :
            0.;
        double *values = points.values(p);
        water.pore_pressure.store(pressure, values);
        water.total_stress.store(points.stress_field()(values) -
                                   pressure * unit_symmetric_tensor<3>(),
                                 values);
      }
  }



  template <int dim>
  Tensor<1, dim>
  force_of_outer_water(const WaterInBodies<dim> &water,
                       const double              t,
                       const State<dim>         &state)
  {
    Tensor<1, dim>       force;
    const PointSet<dim> &points = state.material_points();
    for (unsigned int p = 0; water.water && p < points.n_local(); ++p)
      force -= points.volume(p) *
               water.water->at(points.position(p), half_lengths(state, p), t)
                 .outer.gradient;
    return Utilities::MPI::sum(force, state.grid().communicator());
  }



#define INSTANTIATE(dim)                                                 \
  template class WaterTerm<dim>;                                         \
  template decltype(half_lengths<dim>)         half_lengths<dim>;        \
  template decltype(set_water_at_points<dim>)  set_water_at_points<dim>; \
  template decltype(force_of_outer_water<dim>) force_of_outer_water<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
