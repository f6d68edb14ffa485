// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/rayleigh_damping.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  RayleighDamping<dim>::RayleighDamping(
    const std::vector<RayleighFactors> &factors)
    : factors(factors)
    , damps_mass(std::any_of(factors.begin(), factors.end(), [](const auto &f) {
      return f.mass > 0;
    }))
  {}



  template <int dim>
  std::vector<Effect>
  RayleighDamping<dim>::effects(const StepContext<dim> &) const
  {
    return {{"Rayleigh damping", "", ""}};
  }



  template <int dim>
  void
  RayleighDamping<dim>::add(const StepContext<dim>  &context,
                            const StencilBlock<dim> &block,
                            const bool               tangent,
                            LocalSystem<dim>        &local) const
  {
    const PointSet<dim> &points = context.state.material_points();
    const Motion<dim>   &motion = *context.motion;
    scratch.velocities.resize(block.n_nodes);
    scratch.gradients.resize(block.n_nodes);
    for (unsigned int a = 0; a < block.n_nodes; ++a)
      scratch.velocities[a] =
        motion.velocity(block.nodes[a], local.nodal_increments[a]);
    if (damps_mass)
      add_of_mass(context.state, motion, block, tangent, local);
    for (unsigned int p = 0; p < block.n_points; ++p)
      if (factors[points.body(block.points[p])].stiffness > 0)
        add_of_stiffness(context, block, p, tangent, local);
  }



  template <int dim>
  void
  RayleighDamping<dim>::add_of_mass(const State<dim>        &state,
                                    const Motion<dim>       &motion,
                                    const StencilBlock<dim> &block,
                                    const bool               tangent,
                                    LocalSystem<dim>        &local) const
  {
    scratch.mass.find_lumped(
      block,
      [&state](const unsigned int p) { return state.mass(p); },
      motion.lumped_mass());
    if (tangent)
      scratch.masses.assign(block.n_nodes * block.n_nodes, 0.);
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const unsigned int point = block.points[p];
        const double       c =
          factors[state.material_points().body(point)].mass * state.mass(point);
        const double *N = block.N(p);
        scratch.mass.add_product(N, -c, scratch.velocities, local.force);
        if (tangent)
          scratch.mass.add_matrix(N, c, scratch.masses);
      }
    if (tangent)
      local.add_in_all_directions(motion.velocity_by_increment(),
                                  scratch.masses);
  }



  template <int dim>
  void
  RayleighDamping<dim>::add_of_stiffness(const StepContext<dim>  &context,
                                         const StencilBlock<dim> &block,
                                         const unsigned int       p,
                                         const bool               tangent,
                                         LocalSystem<dim>        &local) const
  {
    const State<dim>   &state = context.state;
    const unsigned int  n     = block.n_nodes;
    const unsigned int  point = block.points[p];
    const unsigned int  body  = state.material_points().body(point);
    const LameConstants C     = elastic_stiffness(state, point);
    const double w = factors[body].stiffness * state.integration_volume(point) /
                     state.volume_ratio(point);

    // The part of the increment that has moved the gradients.
    double share = 0;
    if (state.strain_measure() == StrainMeasure::finite)
      share = context.share_of_step();
    std::vector<Tensor<1, dim>> &g = scratch.gradients;
    std::copy_n(block.grad_N(p), n, g.begin());
    if (share > 0)
      {
        Tensor<2, dim> F = unit_symmetric_tensor<dim>();
        for (unsigned int a = 0; a < n; ++a)
          F += share * outer_product(local.nodal_increments[a], g[a]);
        const Tensor<2, dim> inverse = invert(F);
        for (unsigned int a = 0; a < n; ++a)
          g[a] = g[a] * inverse;
      }
    Tensor<2, dim> L;
    for (unsigned int a = 0; a < n; ++a)
      L += outer_product(scratch.velocities[a], g[a]);
    SymmetricTensor<2, dim> stress = 2 * w * C.mu * symmetrize(L);
    for (unsigned int d = 0; d < dim; ++d)
      stress[d][d] += w * C.lambda * trace(L);
    for (unsigned int a = 0; a < n; ++a)
      {
        const Tensor<1, dim> f = stress * g[a];
        for (unsigned int i = 0; i < dim; ++i)
          local.force[dim * a + i] -= f[i];
      }
    if (!tangent)
      return;

    // L changes by A du_b x g_b, g_a by -share g_b (du_b . g_a).
    Tensor<2, dim> A = -share * L;
    for (unsigned int d = 0; d < dim; ++d)
      A[d][d] += context.motion->velocity_by_increment();
    for (unsigned int b = 0; b < n; ++b)
      {
        const Tensor<1, dim> A_g      = w * (g[b] * A);
        const Tensor<1, dim> stress_g = share * (stress * g[b]);
        for (unsigned int a = 0; a < n; ++a)
          {
            const Tensor<1, dim> g_A = w * (g[a] * A);
            const double         g_g = w * (g[a] * g[b]);
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int k = 0; k < dim; ++k)
                local.matrix(dim * a + i, dim * b + k) +=
                  C.lambda * g[a][i] * A_g[k] +
                  C.mu * (g_g * A[i][k] + g[b][i] * g_A[k]) -
                  stress_g[i] * g[a][k];
          }
      }
  }



  template class RayleighDamping<2>;
  template class RayleighDamping<3>;
} // namespace moraine
