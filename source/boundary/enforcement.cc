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
      "a penalty alone. If left out with finite strain, with a material that "
      "yields or with 'Integrator = energy-momentum': augmented Lagrangian "
      "with a band of 0.01, because Nitsche's flux is elastic, linear in the "
      "increment of a step and that of its end; else in dynamics symmetric "
      "Nitsche, because the skew flux feeds vibrations. Of contact: incomplete "
      "Nitsche (without the adjoint flux) in statics at small strain, else and "
      "beside free water augmented Lagrangian.",
      Patterns::Selection("skew Nitsche|symmetric Nitsche|incomplete Nitsche|"
                          "augmented Lagrangian|weighted|penalty"));
    prm.add_parameter("Band width",
                      band_width,
                      "Width of the band over the cell size, delta/h: of "
                      "'weighted', whose error is of its order, and of "
                      "'augmented Lagrangian', whose penalty is 4/(3 delta); "
                      "0.01 there if it is the default and this is left out.",
                      Patterns::Double(1e-12, 1.));
    prm.add_parameter(
      "Nitsche factor",
      nitsche_factor,
      "Of Nitsche's method: gamma in gamma/h, > 0. In dynamics, "
      "and of the symmetric one with finite strain, the depth "
      "of the material in the cell takes the place of h; "
      "elsewhere the symmetric one has at least 4 over this depth. Of "
      "'augmented Lagrangian' with means, at finite strain, where points move "
      "through cells: that of what varies along the piece in a cell.",
      Patterns::Double(1e-12));
    prm.add_parameter("Penalty factor",
                      penalty_factor,
                      "Of 'penalty': beta in beta/h, > 0.",
                      Patterns::Double(1e-12));
    prm.add_parameter(
      "Held in a cell",
      held_in_a_cell,
      "What of the piece of the surface in a cell is held. mean: the mean over "
      "it, unless it runs along the faces of the cell. places: the places that "
      "integrate exactly; cells of degree 1 that the surface cuts at an angle "
      "lock then with all but Nitsche's method. auto: mean, but places with "
      "Nitsche's method, with degree 2 and, for a roller on a curve in "
      "dynamics, but by generalised-alpha (above a spectral radius of 0) and "
      "by Newmark on nodes that stay with the material.",
      Patterns::Selection("auto|mean|places"));
  }



  Enforcement
  EnforcementParameters::enforcement_of() const
  {
    const DirichletWeight weight(band_width);
    const double          c3 = weight.integral_derivative_squared();
    Enforcement how{0., 0., 0., penalty_factor, false, false, enforcement};
    // The multiplier takes the place of the flux through the band. Both at once
    // lose definiteness where the points of a cut cell hold little energy
    // against the flux on its surface, and updates of t diverge.
    if (enforcement == "augmented Lagrangian")
      {
        how              = {0., 0., 0., c3, true, true, enforcement};
        how.slope_factor = nitsche_factor;
      }
    else if (enforcement == "weighted")
      how = {weight.integral_value_derivative(),
             weight.integral_derivative(),
             1.,
             c3,
             false,
             false,
             enforcement};
    else if (enforcement == "symmetric Nitsche")
      how = {1., 1., 1., nitsche_factor, true, false, enforcement};
    else if (enforcement == "skew Nitsche")
      how = {1., 1., -1., nitsche_factor, true, false, enforcement};
    else if (enforcement == "incomplete Nitsche")
      how = {1., 1., 0., nitsche_factor, true, false, enforcement};
    if (held_in_a_cell != "auto")
      how.held = held_in_a_cell == "mean" ? Enforcement::Held::mean :
                                            Enforcement::Held::places;
    return how;
  }



  bool
  Enforcement::holds_means(const unsigned int degree,
                           const bool         curved_roller,
                           const bool         in_motion) const
  {
    if (held != Held::automatic)
      return held == Held::mean;
    return !is_nitsche() && degree == 1 && !(curved_roller && in_motion);
  }
} // namespace moraine
