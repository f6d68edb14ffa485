// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/time/time_integrator.h>

#include <deal.II/base/parameter_handler.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>

#include <sstream>

namespace moraine
{
  using namespace dealii;

  void
  IntegratorParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Integrator",
      integrator,
      "quasi-static: every step is in equilibrium, and nothing has inertia. "
      "Newmark: by beta and gamma. generalised-alpha: by the spectral radius. "
      "Bathe: a step in two parts, by the spectral radius; the most accurate "
      "for waves. energy-momentum: conserves both at finite strain.",
      patterns::selection({"quasi-static",
                           "Newmark",
                           "generalised-alpha",
                           "Bathe",
                           "energy-momentum"}));
    prm.add_parameter(
      "Newmark beta",
      beta,
      "Of integrator Newmark: at least gamma / 2; (gamma + 1/2)^2 / 4 damps "
      "high frequencies most.",
      patterns::positive());
    prm.add_parameter(
      "Newmark gamma",
      gamma,
      "Of integrator Newmark: 1/2 for second order, more damps.",
      patterns::positive());
    prm.add_parameter(
      "Spectral radius",
      spectral_radius,
      "Of integrators generalised-alpha and Bathe: what is left of the highest "
      "frequencies after a step. 1: no damping, 0: they end at once. 0 if it is "
      "left out and there is contact.",
      Patterns::Double(0, 1));
    prm.add_parameter(
      "Mass",
      mass,
      "consistent, with the mass of nodes that have next to none lumped; or "
      "lumped: all of a point's share of a node at the node",
      patterns::selection({"consistent", "lumped"}));
    prm.add_parameter(
      "Velocity transfer",
      transfer,
      "How points that move through the mesh get their velocity from nodes. "
      "FLIP: theirs and the change of the nodes'. PIC: the nodes'. blend: a "
      "share of FLIP, the rest PIC. APIC: the nodes', and its gradient goes "
      "back to nodes. FMPM: the nodes', which are made from the points' by an "
      "approximate inverse of the consistent mass.",
      patterns::selection({"FLIP", "PIC", "blend", "APIC", "FMPM"}));
    prm.add_parameter("FLIP share",
                      flip_share,
                      "Of velocity transfer blend.",
                      Patterns::Double(0, 1));
    prm.add_parameter("FMPM order",
                      fmpm_order,
                      "Of velocity transfer FMPM: 1 is PIC.",
                      patterns::integer_in_range(1, 20));
  }



  void
  IntegratorParameters::check(const std::string &section) const
  {
    if (integrator != "Newmark" || (gamma >= 0.5 && 2 * beta >= gamma))
      return;
    std::ostringstream text;
    text << "section '" << section << "', key 'Newmark beta': found " << beta
         << " with Newmark gamma = " << gamma
         << ", allowed: gamma >= 1/2 and beta >= gamma / 2; others are not "
            "stable in steps of any size";
    throw InputError(text.str());
  }



  TimeIntegrator::TimeIntegrator(const double beta,
                                 const double gamma,
                                 const double alpha_m,
                                 const double alpha_f,
                                 const bool   in_the_middle)
    : beta(beta)
    , gamma(gamma)
    , alpha_m(alpha_m)
    , alpha_f(alpha_f)
    , in_the_middle(in_the_middle)
    , of_start(0.5 / beta - 1)
    , velocity_start(1 - gamma)
    , error((in_the_middle ? 0.25 : beta) - 1. / 6)
  {}



  TimeIntegrator
  TimeIntegrator::newmark(const double beta, const double gamma)
  {
    return {beta, gamma, 0., 0.};
  }



  TimeIntegrator
  TimeIntegrator::generalised_alpha(const double rho)
  {
    const double alpha_m = (2 * rho - 1) / (rho + 1);
    const double alpha_f = rho / (rho + 1);
    const double damping = alpha_f - alpha_m;
    return {(1 + damping) * (1 + damping) / 4, 0.5 + damping, alpha_m, alpha_f};
  }



  TimeIntegrator
  TimeIntegrator::second_part_of_bathe(const double rho, const double ratio)
  {
    const double s  = 1 / (1 + ratio); // where the first part ended
    const double q1 = (rho + 1) / (2 * s * (rho - 1) + 4);
    const double q2 = 0.5 - s * q1;
    // In units of this part; v_n of the step is v - ratio (a_n + a_{n+s}) / 2.
    const double   gamma = q2 / (1 - s);
    TimeIntegrator rule(gamma * gamma, gamma, 0., 0.);
    rule.velocity_before = 0.5 - q1;
    rule.velocity_start  = 1 - gamma - rule.velocity_before;
    const double of_v    = 0.5 * rule.velocity_before / ratio;
    const double before  = gamma * rule.velocity_before - of_v;
    rule.of_before       = before / rule.beta;
    rule.of_start        = (gamma * rule.velocity_start - of_v) / rule.beta;
    rule.error           = rule.beta - before / ratio - 1. / 6;
    return rule;
  }



  double
  IntegratorParameters::first_part() const
  {
    if (integrator != "Bathe")
      return 1.;
    const double rho = spectral_radius;
    return 2 / (2 + std::sqrt(2 + 2 * rho));
  }



} // namespace moraine
