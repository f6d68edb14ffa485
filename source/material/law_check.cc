// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Trials of a law of the user's, before it is used.

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/material/material_test.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Strain paths from the stress-free start; shears are angles. */
    const std::pair<const char *, SixNumbers> paths[] = {
      {"compression along 11", {{-1}}},
      {"tension along 11", {{1}}},
      {"shear 12", {{0, 0, 0, 1}}},
      {"shear 23", {{0, 0, 0, 0, 0, 1}}},
      {"isotropic compression", {{-1, -1, -1}}},
      {"compression and shear", {{-1, 0.4, 0.3, 0.8, -0.5, 0.6}}}};



    /** @f$\max |c_{IJ} - c_{JI}|@f$ over the largest entry. */
    double
    asymmetry(const VoigtMatrix<3> &c)
    {
      double difference = 0, largest = 0;
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = 0; J < 6; ++J)
          {
            difference = std::max(difference, std::abs(c[I][J] - c[J][I]));
            largest    = std::max(largest, std::abs(c[I][J]));
          }
      return largest > 0 ? difference / largest : 0;
    }



    MaterialTestLeg
    leg_to(const double strain, const SixNumbers &direction)
    {
      MaterialTestLeg leg;
      for (unsigned int I = 0; I < 6; ++I)
        {
          leg.sums[I].of_strain[I] = 1;
          leg.values[I]            = strain * direction[I];
        }
      return leg;
    }
  } // namespace



  std::vector<std::string>
  faults_of(const std::shared_ptr<const Material> &material)
  {
    struct Worst
    {
      double      size = 0;
      std::string trial;
    };
    std::map<std::string, Worst> worst;
    std::vector<std::string>     faults;
    double                       skew = 0;
    for (const auto &[name, direction] : paths)
      try
        {
          MaterialTest test(material, StrainMeasure::small, {});
          for (const double strain : {1e-5, 1e-4, 1e-3, 1e-2})
            {
              const auto add = [&, name = name](const std::string &fault,
                                                const double       size,
                                                const double       allowed) {
                Worst &of = worst[fault];
                if (size > std::max(of.size, allowed))
                  of = {size, name + (" to " + text_of(strain))};
              };
              const MaterialTestLeg leg   = leg_to(strain, direction);
              MaterialTest          again = test;
              test.lead(leg, [] {});
              again.lead(leg, [] {});
              const auto stress = test.stress();
              add("the same input gives another answer the second time",
                  again.stress() != stress ||
                    again.internal() != test.internal(),
                  0);
              again.lead(leg, [] {}); // without a further strain
              add("the stress changes without a strain",
                  (again.stress() - stress).norm() / (1e-300 + stress.norm()),
                  1e-9);
              add("the tangent (DDSDDE) is not the derivative of the stress",
                  test.tangent_error(),
                  1e-3);
              if (strain == 1e-5)
                add("compression makes sigma_11 >= 0; tension is positive",
                    direction[0] < 0 && !(stress[0][0] < 0),
                    0);
              skew = std::max(skew, asymmetry(test.tangent()));
            }
        }
      catch (const ComputationError &error)
        {
          faults.push_back(std::string(name) + ": " + error.what());
        }
    for (const auto &[fault, of] : worst)
      if (of.size > 0)
        faults.push_back(fault + " (" + of.trial +
                         (of.size == 1 ? "" : ", by " + per_cent(of.size)) +
                         ")");
    if (skew < 1e-9 && !material->has_symmetric_tangent())
      faults.push_back("the tangent is symmetric in all trials: 'Tangent = "
                       "symmetric' saves time at small strain");
    return faults;
  }
} // namespace moraine
