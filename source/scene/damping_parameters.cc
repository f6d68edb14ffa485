// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/damping_parameters.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>

#include <deal.II/base/numbers.h>


#include <fmt/format.h>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    std::string
    as_text(const std::vector<double> &numbers)
    {
      return fmt::format("{:.6g}", fmt::join(numbers, ", "));
    }
  } // namespace



  void
  DampingParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Mass damping",
                      mass_factor,
                      "In dynamics: alpha of Rayleigh's damping alpha M + beta "
                      "K (1/time).",
                      patterns::non_negative());
    prm.add_parameter("Stiffness damping",
                      stiffness_factor,
                      "In dynamics: beta of Rayleigh's damping (time), with "
                      "the elastic stiffness K; rotation is not damped.",
                      patterns::non_negative());
    prm.add_parameter("Damping ratio",
                      ratio,
                      "In dynamics, instead of alpha and beta: the part of the "
                      "critical damping at the two 'Damping frequencies'.",
                      patterns::non_negative());
    prm.add_parameter("Damping frequencies",
                      frequencies,
                      "Of 'Damping ratio': two, in cycles (1/time). Between "
                      "them damping is less, outside it is more.",
                      patterns::numbers(0, 2));
  }



  RayleighFactors
  DampingParameters::factors(const std::string &section,
                             const bool         quasi_static) const
  {
    const auto refuse = [&](const std::string         &key,
                            const std::vector<double> &found,
                            const std::string         &allowed) {
      reject(section, key, as_text(found), allowed);
    };
    for (const auto &[key, value] :
         {std::make_pair("Mass damping", mass_factor),
          std::make_pair("Stiffness damping", stiffness_factor),
          std::make_pair("Damping ratio", ratio)})
      {
        if (value > 0 && quasi_static)
          refuse(key,
                 {value},
                 "0; 'Integrator' of section 'Time' is "
                 "'quasi-static', and nothing has a velocity");
        if (value > 0 && key != std::string("Damping ratio") && ratio > 0)
          refuse(key,
                 {value},
                 "0; 'Damping ratio' and 'Damping frequencies' give both "
                 "factors");
      }
    if (!(ratio > 0) && !frequencies.empty())
      refuse("Damping frequencies",
             frequencies,
             "nothing; there is no 'Damping ratio'");
    if (!(ratio > 0))
      return {mass_factor, stiffness_factor};
    if (frequencies.size() != 2 || !(frequencies[0] > 0) ||
        !(frequencies[1] > frequencies[0]))
      refuse("Damping frequencies",
             frequencies,
             "two numbers > 0, the larger one last; the damping is "
             "'Damping ratio' there");
    return RayleighFactors::of_ratio(ratio,
                                     2 * numbers::PI * frequencies[0],
                                     2 * numbers::PI * frequencies[1]);
  }
} // namespace moraine
