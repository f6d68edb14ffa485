// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/material_library.h>

#include <moraine/core/exceptions.h>
#include <moraine/material/linear_elastic.h>

#include <sstream>

namespace moraine
{
  using namespace dealii;

  void
  MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Model",
                      model,
                      "The constitutive law. linear elastic: stress linear in "
                      "strain; at finite strain Kirchhoff stress in "
                      "logarithmic strain (Hencky).",
                      Patterns::Selection("linear elastic"));
    prm.add_parameter("Young modulus",
                      young_modulus,
                      "Young's modulus E > 0 (stress).",
                      Patterns::Double());
    prm.add_parameter("Poisson ratio",
                      poisson_ratio,
                      "Poisson's ratio, larger than -1 and smaller than 0.5.",
                      Patterns::Double());
    prm.add_parameter("Density",
                      density,
                      "Mass density (mass / length^3); needed for gravity.",
                      Patterns::Double(0));
  }



  std::shared_ptr<const Material>
  make_material(const MaterialParameters &parameters,
                const std::string        &section)
  {
    const auto number = [](const double value) {
      std::ostringstream text;
      text << value;
      return text.str();
    };
    if (!(parameters.young_modulus > 0))
      reject(section,
             "Young modulus",
             number(parameters.young_modulus),
             "a number > 0");
    if (!(parameters.poisson_ratio > -1 && parameters.poisson_ratio < 0.5))
      reject(section,
             "Poisson ratio",
             number(parameters.poisson_ratio),
             "a number > -1 and < 0.5");
    return std::make_shared<LinearElastic>(parameters.young_modulus,
                                           parameters.poisson_ratio,
                                           parameters.density);
  }
} // namespace moraine
