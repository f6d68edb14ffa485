// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/linear_elastic.h>

#include <moraine/core/exceptions.h>

#include <sstream>

namespace moraine
{
  using namespace dealii;

  void
  MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Model",
                      model,
                      "The constitutive law.",
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



  LinearElastic::LinearElastic(const double E,
                               const double nu,
                               const double rho)
    : stiffness{E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))}
    , rho(rho)
  {}



  void
  LinearElastic::update_stress(
    const ArrayView<const SymmetricTensor<2, 3>> &strain_increment,
    const ArrayView<SymmetricTensor<2, 3>>       &stress) const
  {
    for (unsigned int p = 0; p < stress.size(); ++p)
      stress[p] += stiffness * strain_increment[p];
  }



  std::shared_ptr<const Material>
  make_material(const MaterialParameters &parameters,
                const std::string        &section)
  {
    const auto reject = [&section](const std::string &key,
                                   const double       found,
                                   const std::string &allowed) {
      std::ostringstream message;
      message << "section '" << section << "', key '" << key << "': found "
              << found << ", allowed: " << allowed;
      throw InputError(message.str());
    };
    if (!(parameters.young_modulus > 0))
      reject("Young modulus", parameters.young_modulus, "a number > 0");
    if (!(parameters.poisson_ratio > -1 && parameters.poisson_ratio < 0.5))
      reject("Poisson ratio",
             parameters.poisson_ratio,
             "a number > -1 and < 0.5");
    return std::make_shared<LinearElastic>(parameters.young_modulus,
                                           parameters.poisson_ratio,
                                           parameters.density);
  }
} // namespace moraine
