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
      "How the constraint is imposed: the Dirichlet-weighted basis of a thin "
      "band, Nitsche's method (symmetric or skew), or a penalty. If left out "
      "with finite strain: weighted, with a band of 0.01 and the reaction "
      "carried, because Nitsche's flux is linear in the increment of a step.",
      Patterns::Selection("weighted|symmetric Nitsche|skew Nitsche|penalty"));
    prm.add_parameter("Band width",
                      band_width,
                      "Of 'weighted': width of the band over the cell size, "
                      "delta/h; 0.01 if left out with finite strain.",
                      Patterns::Double(1e-12, 1.));
    prm.add_parameter("Nitsche factor",
                      nitsche_factor,
                      "Of Nitsche's method: gamma in gamma/h, > 0.",
                      Patterns::Double(1e-12));
    prm.add_parameter("Penalty factor",
                      penalty_factor,
                      "Of 'penalty': beta in beta/h, > 0.",
                      Patterns::Double(1e-12));
    prm.add_parameter(
      "Carry reaction",
      carry_reaction,
      "Of 'weighted' and 'penalty': let the surface carry its reaction and "
      "repeat the solution with the same factorisation until the constraint "
      "holds. Without it the error is of the order of the band width.");
  }



  Enforcement
  EnforcementParameters::enforcement_of() const
  {
    if (enforcement == "weighted")
      {
        const DirichletWeight weight(band_width);
        const double          c3 = weight.integral_derivative_squared();
        // The reaction takes the place of the flux through the band. Both at
        // once lose definiteness where the points of a cut cell hold little
        // energy against the flux on its surface, and updates of t diverge.
        if (carry_reaction)
          return {0., 0., 0., c3, true, true};
        return {weight.integral_value_derivative(),
                weight.integral_derivative(),
                1.,
                c3,
                false,
                false};
      }
    if (enforcement == "symmetric Nitsche")
      return {1., 1., 1., nitsche_factor, true, false};
    if (enforcement == "skew Nitsche")
      return {1., 1., -1., nitsche_factor, true, false};
    return {0., 0., 0., penalty_factor, carry_reaction, carry_reaction};
  }
} // namespace moraine
