// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/state.h>
#include <moraine/state/trial_points.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** @f$\partial\varepsilon^e_A/\partial\varepsilon^{tr}_B = C^{-1} D@f$ */
    Tensor<2, 3>
    elastic_part(const LameConstants &C, const Tensor<2, 3> &D)
    {
      Tensor<2, 3> result;
      for (unsigned int B = 0; B < 3; ++B)
        {
          const double trace = D[0][B] + D[1][B] + D[2][B];
          for (unsigned int A = 0; A < 3; ++A)
            result[A][B] =
              (D[A][B] - C.lambda / (3 * C.lambda + 2 * C.mu) * trace) /
              (2 * C.mu);
        }
      return result;
    }



    /**
     * The derivative of @f$T : P@f$ by the logarithmic strain of
     * @f$b^{tr}@f$, where P is coaxial with @f$b^{tr}@f$.
     *
     * @param principal of @f$b^{tr}@f$
     * @param strain @f$\varepsilon^{tr}_A@f$
     * @param p principal values of P
     * @param dp @f$\partial p_A/\partial\varepsilon^{tr}_B@f$
     */
    SymmetricTensor<2, 3>
    gradient_of_product(const SymmetricTensor<2, 3> &T,
                        const Spectrum              &principal,
                        const Tensor<1, 3>          &strain,
                        const Tensor<1, 3>          &p,
                        const Tensor<2, 3>          &dp)
    {
      const Tensor<2, 3> &e     = principal.directions;
      const Tensor<2, 3>  t     = e * Tensor<2, 3>(T) * transpose(e);
      const double        equal = equal_strains(strain);
      Tensor<2, 3>        g;
      for (unsigned int B = 0; B < 3; ++B)
        for (unsigned int A = 0; A < 3; ++A)
          {
            g[B][B] += t[A][A] * dp[A][B];
            if (A == B)
              continue;
            const double difference = strain[A] - strain[B];
            g[A][B] =
              t[A][B] * (std::abs(difference) <= equal ?
                           0.5 * (dp[A][A] - dp[A][B] + dp[B][B] - dp[B][A]) :
                           (p[A] - p[B]) / std::tanh(difference));
          }
      return symmetrize(transpose(e) * g * e);
    }
  } // namespace



  template <int dim>
  void
  TrialPoints<dim>::find_energies(const State<dim>        &state,
                                  const StencilBlock<dim> &block,
                                  const unsigned int       begin)
  {
    AssertThrow(isotropic, ExcNotImplemented());
    const Material &material =
      state.material(state.material_points().body(block.points[begin]));
    stiffness.assign(points.size(), material.elastic_stiffness());
    for (unsigned int i = 0;
         i < points.size() && !material.has_uniform_stiffness();
         ++i)
      stiffness[i] = material.elastic_stiffness_at(&internal[i * n_internal]);
    dissipates = material.dissipates();
    energy_points.resize(points.size());
    const bool by_stress =
      measure == StrainMeasure::small && material.has_linear_elasticity();
    if (!by_stress)
      load_internal(state, block, begin, internal_at_start);
    if (measure == StrainMeasure::small)
      find_small_energies(state, block, begin, material);
    else
      find_finite_energies(state, block, begin);
    if (by_stress)
      return;
    stored.resize(2 * points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      elastic_points[2 * i + 1] = {answers[i].strain, answers[i].internal};
    material.stored_energies(ArrayView<const ElasticPoint>(
                               elastic_points.data(), elastic_points.size()),
                             ArrayView<double>(stored.data(), stored.size()));
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        energy_points[i].energies.stored_at_start = stored[2 * i];
        energy_points[i].energies.stored          = stored[2 * i + 1];
        const Tensor<1, 3> &trial                 = points[i].trial_strain;
        energy_points[i].energies.dissipated +=
          material.dissipated_by_water(trial[0] + trial[1] + trial[2],
                                       elastic_points[2 * i + 1],
                                       elastic_points[2 * i].internal);
      }
  }



  template <int dim>
  void
  TrialPoints<dim>::add_energies(const State<dim>        &state,
                                 const StencilBlock<dim> &block,
                                 const unsigned int       begin,
                                 StepEnergies            &sums)
  {
    find_energies(state, block, begin);
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const StepEnergies &of_point = energy_points[i].energies;
        sums.stored_at_start += weight(i) * of_point.stored_at_start;
        sums.stored += weight(i) * of_point.stored;
        sums.dissipated += weight(i) * of_point.dissipated;
      }
  }



  template <int dim>
  void
  TrialPoints<dim>::find_small_energies(const State<dim>        &state,
                                        const StencilBlock<dim> &block,
                                        const unsigned int       begin,
                                        const Material          &material)
  {
    const auto &set       = state.material_points();
    const bool  is_linear = material.has_linear_elasticity();
    if (!is_linear)
      elastic_points.resize(2 * points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        EnergyPoint  &at                 = energy_points[i];
        const double *values             = set.values(block.points[begin + i]);
        at.stress                        = set.stress_field()(values);
        const SymmetricTensor<2, 3> &end = points[i].stress;
        SymmetricTensor<2, 3>        strain, start_strain;
        if (is_linear)
          {
            strain       = stiffness[i].strain_of(end);
            start_strain = stiffness[i].strain_of(at.stress);
          }
        else
          {
            const double *at_start = &internal_at_start[i * n_internal];
            strain       = material.elastic_strain_of(end, answers[i].internal);
            start_strain = material.elastic_strain_of(at.stress, at_start);
            elastic_points[2 * i] = {spectrum<dim>(start_strain).values,
                                     at_start};
          }
        at.energies = {0.5 * (at.stress * start_strain),
                       0.5 * (end * strain),
                       0.};
        if (!dissipates)
          continue;
        SymmetricTensor<2, 3> plastic = start_strain - strain;
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = k; l < dim; ++l)
            plastic[k][l] +=
              0.5 * (points[i].gradient[k][l] + points[i].gradient[l][k]);
        at.energies.dissipated = 0.5 * ((at.stress + end) * plastic);
      }
  }



  template <int dim>
  void
  TrialPoints<dim>::find_finite_energies(const State<dim>        &state,
                                         const StencilBlock<dim> &block,
                                         const unsigned int       begin)
  {
    const auto &set = state.material_points();
    elastic_points.resize(2 * points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const unsigned int p      = block.points[begin + i];
        const double      *values = set.values(p);
        EnergyPoint       &at     = energy_points[i];
        at.stress = state.volume_ratio(p) * set.stress_field()(values);
        const Tensor<1, 3> start =
          spectrum<dim>(state.fields().b(values)).values;
        for (unsigned int A = 0; A < 3; ++A)
          elastic_points[2 * i].strain[A] = 0.5 * std::log(start[A]);
        elastic_points[2 * i].internal =
          internal_at_start.data() + i * n_internal;
        at.energies.dissipated = 0;
        if (!dissipates)
          continue;
        const Tensor<2, dim> dF =
          Physics::Elasticity::Kinematics::F(points[i].gradient);
        at.carried =
          in_space(dF) * Tensor<2, 3>(at.stress) * in_space(invert(dF));
        at.energies.dissipated =
          0.5 * ((symmetrize(at.carried) + points[i].stress) *
                 points[i].principal.tensor(points[i].trial_strain -
                                            answers[i].strain));
      }
  }



  template <int dim>
  SymmetricTensor<2, 3>
  TrialPoints<dim>::energy_gradient(const unsigned int i) const
  {
    if (!dissipates)
      return points[i].stress;
    const Tensor<2, 3> elastic = elastic_part(stiffness[i], answers[i].tangent);
    Tensor<2, 3>       plastic = -elastic;
    for (unsigned int A = 0; A < 3; ++A)
      plastic[A][A] += 1;
    const Spectrum     &principal = points[i].principal;
    const Tensor<1, 3> &stress    = answers[i].stress;
    const Tensor<1, 3>  p         = points[i].trial_strain - answers[i].strain;
    // Of the stored energy and half of tau_{n+1} : plastic strain.
    const Tensor<1, 3> of_end =
      stress * elastic + 0.5 * (p * answers[i].tangent + stress * plastic);
    const Tensor<2, 3> &M = energy_points[i].carried;
    const Tensor<2, 3>  P(principal.tensor(p));
    return principal.tensor(of_end) +
           0.5 * gradient_of_product(symmetrize(M),
                                     principal,
                                     points[i].trial_strain,
                                     p,
                                     plastic) +
           0.5 * symmetrize(P * transpose(M) - transpose(M) * P);
  }



#define INSTANTIATE(dim)                                                   \
  template void TrialPoints<dim>::find_energies(const State<dim> &,        \
                                                const StencilBlock<dim> &, \
                                                const unsigned int);       \
  template void TrialPoints<dim>::add_energies(const State<dim> &,         \
                                               const StencilBlock<dim> &,  \
                                               const unsigned int,         \
                                               StepEnergies &);            \
  template SymmetricTensor<2, 3> TrialPoints<dim>::energy_gradient(        \
    const unsigned int) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
