// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/absorbing_parameters.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <deal.II/base/parameter_handler.h>

#include <fmt/format.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Two numbers >= 0 of a key. */
    NormalAndAlong
    two_of(const std::vector<double> &numbers, const std::string &place)
    {
      if (numbers.size() != 2 || !(numbers[0] >= 0) || !(numbers[1] >= 0))
        throw InputError(fmt::format("{}: found '{:.6g}', allowed: 2 numbers "
                                     ">= 0",
                                     place,
                                     fmt::join(numbers, ", ")));
      return {numbers[0], numbers[1]};
    }
  } // namespace



  void
  AbsorbingParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Dashpot factors",
                      dashpot_factors,
                      "Of 'absorbing': factors of the dashpots normal to and "
                      "along the surface (-), a and b.",
                      patterns::numbers(2, 2));
    prm.add_parameter("Spring radius",
                      spring_radius,
                      "Of 'absorbing': the distance r_b to the source, from "
                      "the axis of a cavity (length), by which springs of 2 "
                      "G/r_b normal and G/(2 r_b) along the surface hold what "
                      "is static. 0: dashpots alone.",
                      patterns::non_negative());
    prm.add_parameter("Virtual thickness",
                      virtual_thickness,
                      "Of 'absorbing': springs of a layer of this thickness "
                      "(length), rho c^2 over it. 0: none.",
                      patterns::non_negative());
    prm.add_parameter("Spring stiffness",
                      spring_stiffness,
                      "Of 'absorbing': springs normal to and along the surface "
                      "(force/length^3).",
                      patterns::numbers(0, 2));
    prm.add_parameter("Outer density",
                      outer_density,
                      "Of 'absorbing', with 'Outer wave speeds': density of "
                      "the medium outside (mass/volume); that of the material "
                      "beside the boundary if left out.",
                      patterns::non_negative());
    prm.add_parameter("Outer wave speeds",
                      outer_wave_speeds,
                      "Of 'absorbing': speeds of pressure and of shear waves "
                      "outside (length/time).",
                      patterns::numbers(0, 2));
    prm.add_parameter("Outer impedances",
                      outer_impedances,
                      "Of 'absorbing': rho c of pressure and of shear waves "
                      "outside (force time/length^3), instead of density and "
                      "speeds.",
                      patterns::numbers(0, 2));
    prm.add_parameter("Incident velocity",
                      incident_velocity,
                      "Of 'absorbing': velocity in a wave that comes from "
                      "outside along the normal (length/time), dim expressions "
                      "in x, y, z, t separated by ';'; none if left out.");
    prm.add_parameter("Incident curve",
                      incident_curve,
                      "Of 'Incident velocity': factor over time, an expression "
                      "in t or a table 't: f, t: f, ...'; 1 if left out.");
  }



  bool
  AbsorbingParameters::has(const std::string &key)
  {
    const std::vector<std::string> keys{"Dashpot factors",
                                        "Spring radius",
                                        "Virtual thickness",
                                        "Spring stiffness",
                                        "Outer density",
                                        "Outer wave speeds",
                                        "Outer impedances",
                                        "Incident velocity",
                                        "Incident curve"};
    return contains(keys, key);
  }



  AbsorbingLaw
  AbsorbingParameters::law(const std::string &section) const
  {
    AbsorbingLaw law;
    law.dashpot_factors =
      two_of(dashpot_factors, place(section, "Dashpot factors"));
    if ((spring_radius > 0) + (virtual_thickness > 0) +
          !spring_stiffness.empty() >
        1)
      throw InputError("section '" + section +
                       "': found more than one of 'Spring radius', 'Virtual "
                       "thickness' and 'Spring stiffness', allowed: at most "
                       "one of them");
    if (spring_radius > 0)
      law.springs = AbsorbingLaw::Springs::radius;
    else if (virtual_thickness > 0)
      law.springs = AbsorbingLaw::Springs::thickness;
    law.spring_length = std::max(spring_radius, virtual_thickness);
    if (!spring_stiffness.empty())
      {
        law.springs = AbsorbingLaw::Springs::given;
        law.spring_stiffness =
          two_of(spring_stiffness, place(section, "Spring stiffness"));
      }
    if ((outer_density > 0) != !outer_wave_speeds.empty())
      throw InputError(
        "section '" + section + "': found '" +
        (outer_density > 0 ? "Outer density" : "Outer wave speeds") +
        "' alone, allowed: 'Outer density' and 'Outer wave "
        "speeds', or none of them");
    if (outer_density > 0 && !outer_impedances.empty())
      throw InputError("section '" + section +
                       "': found 'Outer density' and 'Outer impedances', "
                       "allowed: one of them");
    if (outer_density > 0)
      {
        const NormalAndAlong c =
          two_of(outer_wave_speeds, place(section, "Outer wave speeds"));
        law.medium = {outer_density, c.normal, c.along};
      }
    if (!outer_impedances.empty())
      law.impedances =
        two_of(outer_impedances, place(section, "Outer impedances"));
    if (incident_velocity.empty() && !incident_curve.empty())
      throw InputError(place(section, "Incident curve") + ": found '" +
                       incident_curve +
                       "', allowed: nothing without 'Incident velocity'");
    return law;
  }
} // namespace moraine
