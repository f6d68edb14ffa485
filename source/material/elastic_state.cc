// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/elastic_state.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int strain_iterations = 50;
    constexpr double       strain_tolerance  = 1e-13;
  } // namespace



  ElasticState
  elastic_state(const Material            &material,
                const Tensor<1, 3>        &stress,
                const std::vector<double> &internal)
  {
    SymmetricTensor<2, 3> wanted;
    for (unsigned int A = 0; A < 3; ++A)
      wanted[A][A] = stress[A];
    const SymmetricTensor<2, 3> first =
      material.elastic_strain_of(wanted, internal.data());
    Tensor<1, 3> trial;
    for (unsigned int A = 0; A < 3; ++A)
      trial[A] = first[A][A];

    ElasticState result;
    for (unsigned int iteration = 0; iteration < strain_iterations; ++iteration)
      {
        std::vector<double> variables = internal;
        PrincipalState      at;
        at.strain   = trial;
        at.internal = variables.data();
        material.respond(StepTime(), ArrayView<PrincipalState>(&at, 1));
        result                   = {at.strain, at.stress};
        const Tensor<1, 3> error = stress - at.stress;
        const bool yields = (at.strain - trial).norm() > 1e-9 * trial.norm();
        if (!std::isfinite(at.stress.norm()) || yields ||
            error.norm() <= strain_tolerance * stress.norm())
          break;
        trial += invert(at.tangent) * error;
      }
    return result;
  }



  SymmetricTensor<2, 3>
  stress_unstrained(const Material              &material,
                    const StrainMeasure          measure,
                    const SymmetricTensor<2, 3> &stress,
                    const std::vector<double>   &internal)
  {
    std::vector<double> variables = internal;
    TensorState         at;
    for (unsigned int d = 0; d < 3; ++d)
      at.F_n[d][d] = at.F[d][d] = 1;
    at.stress   = stress;
    at.internal = variables.data();
    material.respond(StepTime(), measure, ArrayView<TensorState>(&at, 1));
    return at.stress;
  }
} // namespace moraine
