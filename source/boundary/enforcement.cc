// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/enforcement.h>

#include <moraine/boundary/dirichlet_weight.h>

namespace moraine
{
  using namespace dealii;

  void
  EnforcementParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Enforcement",
      enforcement,
      "How the constraint is imposed: Nitsche's method (skew or symmetric), a "
      "penalty with multipliers that take its place until the constraint holds "
      "(augmented Lagrangian), the Dirichlet-weighted basis of a thin band, or "
      "a penalty alone. If left out with finite strain: augmented Lagrangian "
      "with a band of 0.01, because Nitsche's flux is linear in the increment "
      "of a step.",
      Patterns::Selection("skew Nitsche|symmetric Nitsche|augmented Lagrangian|"
                          "weighted|penalty"));
    prm.add_parameter("Band width",
                      band_width,
                      "Width of the band over the cell size, delta/h: of "
                      "'weighted', whose error is of its order, and of "
                      "'augmented Lagrangian', whose penalty is 4/(3 delta); "
                      "0.01 there if left out with finite strain.",
                      Patterns::Double(1e-12, 1.));
    prm.add_parameter(
      "Nitsche factor",
      nitsche_factor,
      "Of Nitsche's method: gamma in gamma/h, > 0. In dynamics, "
      "and of the symmetric one with finite strain, the depth "
      "of the material in the cell takes the place of h; "
      "elsewhere the symmetric one has at least 4 over this depth.",
      Patterns::Double(1e-12));
    prm.add_parameter("Penalty factor",
                      penalty_factor,
                      "Of 'penalty': beta in beta/h, > 0.",
                      Patterns::Double(1e-12));
  }



  Enforcement
  EnforcementParameters::enforcement_of() const
  {
    const DirichletWeight weight(band_width);
    const double          c3 = weight.integral_derivative_squared();
    // The multiplier takes the place of the flux through the band. Both at once
    // lose definiteness where the points of a cut cell hold little energy
    // against the flux on its surface, and updates of t diverge.
    if (enforcement == "augmented Lagrangian")
      return {0., 0., 0., c3, true, true, enforcement};
    if (enforcement == "weighted")
      return {weight.integral_value_derivative(),
              weight.integral_derivative(),
              1.,
              c3,
              false,
              false,
              enforcement};
    if (enforcement == "symmetric Nitsche")
      return {1., 1., 1., nitsche_factor, true, false, enforcement};
    if (enforcement == "skew Nitsche")
      return {1., 1., -1., nitsche_factor, true, false, enforcement};
    return {0., 0., 0., penalty_factor, false, false, enforcement};
  }
} // namespace moraine
