// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/neo_hookean.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  void
  NeoHookean::respond(const StepTime &,
                      const ArrayView<PrincipalState> &points) const
  {
    for (PrincipalState &point : points)
      {
        const auto [lambda, mu]        = stiffness_at(point.internal);
        const Tensor<1, 3> &e          = point.strain;
        const double        volumetric = lambda * (e[0] + e[1] + e[2]);
        for (unsigned int A = 0; A < 3; ++A)
          {
            // expm1 keeps the digits of small strains.
            const double growth = std::expm1(2 * e[A]);
            point.stress[A]     = mu * growth + volumetric;
            for (unsigned int B = 0; B < 3; ++B)
              point.tangent[A][B] =
                lambda + (A == B ? 2 * mu * (1 + growth) : 0.);
          }
      }
  }



  void
  NeoHookean::stored_energies(const ArrayView<const ElasticPoint> &points,
                              const ArrayView<double> &energies) const
  {
    for (unsigned int i = 0; i < energies.size(); ++i)
      {
        const auto [lambda, mu]        = stiffness_at(points[i].internal);
        const Tensor<1, 3> &e          = points[i].strain;
        const double        volumetric = e[0] + e[1] + e[2];
        energies[i]                    = 0.5 * lambda * volumetric * volumetric;
        for (unsigned int A = 0; A < 3; ++A)
          energies[i] += 0.5 * mu * (std::expm1(2 * e[A]) - 2 * e[A]);
      }
  }



  MaterialModel
  neo_hookean_model()
  {
    return {"neo-Hookean",
            "Kirchhoff stress mu (b - 1) + lambda ln(J), with the left "
            "Cauchy-Green tensor b; for finite strain",
            elastic_keys(),
            [](MaterialInput &input) {
              return std::make_shared<NeoHookean>(read_elasticity(input));
            }};
  }
} // namespace moraine
