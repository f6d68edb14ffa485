// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/contact_parameters.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  void
  ContactParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Friction",
                      friction,
                      "Of 'contact': coefficient of friction mu; the shear "
                      "traction is at most 'Adhesion' + mu times the pressure.",
                      patterns::non_negative());
    prm.add_parameter("Friction angle",
                      friction_angle,
                      "Of 'contact': angle of friction in degrees, instead of "
                      "the coefficient mu = tan(angle).",
                      Patterns::Double(0, 89));
    prm.add_parameter(
      "Adhesion",
      adhesion,
      "Of 'contact': shear strength at zero normal stress; lost at "
      "separation, restored on closure. Needs 'Tensile strength' "
      "or 'Separation = false'.",
      patterns::non_negative());
    prm.add_parameter("Tensile strength",
                      tensile_strength,
                      "Of 'contact': largest normal tension (stress); lost at "
                      "separation, restored on closure.",
                      patterns::non_negative());
    prm.add_parameter("Separation",
                      separation,
                      "Of 'contact': whether the interface can open. false: "
                      "where it touches it becomes a roller with friction that "
                      "also carries tension.");
  }



  bool
  ContactParameters::has(const std::string &key)
  {
    return contains(std::vector<std::string>{"Friction",
                                             "Friction angle",
                                             "Adhesion",
                                             "Tensile strength",
                                             "Separation"},
                    key);
  }



  ContactLaw
  ContactParameters::law(const std::string &section) const
  {
    if (friction > 0 && friction_angle > 0)
      reject(section,
             "Friction angle",
             Patterns::Tools::to_string(friction_angle),
             "nothing beside key 'Friction'");
    if (!separation && tensile_strength > 0)
      reject(section,
             "Tensile strength",
             Patterns::Tools::to_string(tensile_strength),
             "nothing with 'Separation = false'");
    if (separation && adhesion > 0 && tensile_strength == 0)
      reject(section,
             "Adhesion",
             Patterns::Tools::to_string(adhesion),
             "0, or with a 'Tensile strength' or 'Separation = false'");
    return {friction > 0 ? friction :
                           std::tan(friction_angle * numbers::PI / 180.),
            adhesion,
            tensile_strength,
            separation};
  }
} // namespace moraine
