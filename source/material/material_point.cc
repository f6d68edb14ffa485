// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/material_point.h>

#include <moraine/material/elastic_state.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  MaterialPoint::MaterialPoint(const std::shared_ptr<const Material> &material,
                               const StrainMeasure                    measure,
                               const SymmetricTensor<2, 3>           &stress)
    : material(material)
    , measure(measure)
  {
    committed.stress = stress;
    committed.F      = unit_symmetric_tensor<3>();
    committed.b      = unit_symmetric_tensor<3>();
    for (const InternalVariable &variable : material->internal_variables())
      committed.internal.push_back(variable.initial);
    material->initialise(stress, /* vertical = */ 2, committed.internal.data());
    if (measure == StrainMeasure::finite && material->is_isotropic())
      {
        const Spectrum at = spectrum<3>(stress);
        Tensor<1, 3>   values =
          elastic_state(*material, at.values, committed.internal).strain;
        for (unsigned int A = 0; A < 3; ++A)
          values[A] = std::exp(2 * values[A]);
        committed.b = at.tensor(values);
      }
    try_step(StepTime(), Tensor<2, 3>());
  }



  bool
  MaterialPoint::try_step(const StepTime &time, const Tensor<2, 3> &H)
  {
    trial = committed;
    if (measure == StrainMeasure::finite)
      {
        const Tensor<2, 3> dF =
          H + static_cast<Tensor<2, 3>>(unit_symmetric_tensor<3>());
        if (!(determinant(dF) > 0))
          return false;
        trial.F = dF * committed.F;
      }
    if (material->is_isotropic())
      answer_in_principal_values(time, H);
    else
      answer_in_tensors(time, H);
    return std::isfinite(trial.stress.norm());
  }



  void
  MaterialPoint::answer_in_principal_values(const StepTime     &time,
                                            const Tensor<2, 3> &H)
  {
    const bool     finite = measure == StrainMeasure::finite;
    Spectrum       at;
    PrincipalState to;
    if (finite)
      {
        const Tensor<2, 3> dF =
          H + static_cast<Tensor<2, 3>>(unit_symmetric_tensor<3>());
        at = spectrum<3>(symmetrize(
          dF * static_cast<Tensor<2, 3>>(committed.b) * transpose(dF)));
        for (unsigned int A = 0; A < 3; ++A)
          to.strain[A] = 0.5 * std::log(at.values[A]);
      }
    else
      {
        at =
          spectrum<3>(material->elastic_strain_of(committed.stress,
                                                  committed.internal.data()) +
                      symmetrize(H));
        to.strain = at.values;
      }
    const Tensor<1, 3> trial_strain = to.strain;
    to.internal                     = trial.internal.data();
    material->respond(time, ArrayView<PrincipalState>(&to, 1));
    trial.stress = at.tensor(to.stress);
    tangent      = spatial_tangent<3>(at, trial_strain, to, measure);
    if (!finite)
      return;
    Tensor<1, 3> values;
    for (unsigned int A = 0; A < 3; ++A)
      values[A] = std::exp(2 * to.strain[A]);
    trial.b = at.tensor(values);
  }



  void
  MaterialPoint::answer_in_tensors(const StepTime &time, const Tensor<2, 3> &H)
  {
    const bool  finite = measure == StrainMeasure::finite;
    TensorState to;
    to.strain_increment = symmetrize(H);
    to.F_n              = committed.F;
    to.F                = trial.F;
    to.stress =
      finite ?
        SymmetricTensor<2, 3>(committed.stress / determinant(committed.F)) :
        committed.stress;
    to.internal = trial.internal.data();
    material->respond(time, measure, ArrayView<TensorState>(&to, 1));
    trial.stress = to.stress;
    tangent      = voigt_matrix<3>(to.tangent);
  }



  SymmetricTensor<2, 3>
  MaterialPoint::stress_rate(const Tensor<2, 3> &l) const
  {
    constexpr auto        pairs = voigt_pairs<3>();
    SymmetricTensor<2, 3> rate;
    for (unsigned int I = 0; I < 6; ++I)
      for (unsigned int J = 0; J < 6; ++J)
        {
          const auto [k, m] = pairs[J];
          rate[pairs[I][0]][pairs[I][1]] +=
            tangent[I][J] * (k == m ? l[k][k] : l[k][m] + l[m][k]);
        }
    if (measure == StrainMeasure::finite)
      {
        const Tensor<2, 3> tau = trial.stress;
        rate += 2. * symmetrize(l * tau);
      }
    return rate;
  }
} // namespace moraine
