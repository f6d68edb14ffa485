// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Trials of a law of the user's, before it is used.

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/material/material_test.h>
#include <moraine/material/spectral.h>

#include <algorithm>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr double allowed_tangent_error = 1e-3;
    constexpr double no_asymmetry          = 1e-9;
    constexpr double no_change             = 1e-9; ///< over the stress

    /** Strain paths from the stress-free start; shears are angles. */
    const std::pair<const char *, SixNumbers> paths[] = {
      {"compression along 11", {{-1}}},
      {"tension along 11", {{1}}},
      {"shear 12", {{0, 0, 0, 1}}},
      {"shear 23", {{0, 0, 0, 0, 0, 1}}},
      {"isotropic compression", {{-1, -1, -1}}},
      {"compression and shear", {{-1, 0.4, 0.3, 0.8, -0.5, 0.6}}}};



    /** A fault in the trial where it is largest. */
    struct Fault
    {
      void
      add(const double value, const std::string &trial)
      {
        if (value > largest)
          {
            largest = value;
            where   = " (" + trial + ")";
          }
      }

      double      largest = 0;
      std::string where;
    };



    /** @f$\max |c_{IJ} - c_{JI}|@f$ over the largest entry. */
    double
    asymmetry(const MaterialPoint &point)
    {
      constexpr auto                       pairs = voigt_pairs<3>();
      std::array<SymmetricTensor<2, 3>, 6> columns;
      for (unsigned int J = 0; J < 6; ++J)
        {
          Tensor<2, 3> l;
          l[pairs[J][0]][pairs[J][1]] = 1;
          columns[J]                  = point.stress_rate(l);
        }
      double difference = 0, largest = 0;
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = 0; J < 6; ++J)
          {
            const double c = columns[J].access_raw_entry(I);
            difference     = std::max(difference,
                                  std::abs(c - columns[I].access_raw_entry(J)));
            largest        = std::max(largest, std::abs(c));
          }
      return largest > 0 ? difference / largest : 0;
    }
  } // namespace



  std::vector<std::string>
  faults_of(const std::shared_ptr<const Material> &material)
  {
    std::vector<std::string> faults;
    Fault                    tangent, change, repeat, sign, skew;
    for (const auto &[name, direction] : paths)
      try
        {
          MaterialTest test(material,
                            StrainMeasure::small,
                            SymmetricTensor<2, 3>());
          for (const double size : {1e-5, 1e-4, 1e-3, 1e-2})
            {
              const std::string trial =
                name + std::string(", strain ") + text_of(size);
              MaterialTestLeg leg;
              for (unsigned int I = 0; I < 6; ++I)
                {
                  leg.sums[I].of_strain[I] = 1;
                  leg.values[I]            = size * direction[I];
                }
              MaterialTest again = test;
              test.lead(leg, [] {});
              again.lead(leg, [] {});
              repeat.add(again.stress() != test.stress() ||
                           again.internal() != test.internal(),
                         trial);
              again.lead(leg, [] {}); // without a strain
              change.add((again.stress() - test.stress()).norm() /
                           (1e-300 + test.stress().norm()),
                         trial);
              tangent.add(test.tangent_error(), trial);
              skew.add(asymmetry(test.material_point()), trial);
              if (size == 1e-5 && direction[0] < 0)
                sign.add(!(test.stress()[0][0] < 0), trial);
            }
        }
      catch (const ComputationError &error)
        {
          faults.push_back(std::string(name) + ": " + error.what());
        }
    if (sign.largest > 0)
      faults.push_back("compression does not make sigma_11 < 0; tension is "
                       "positive" +
                       sign.where);
    if (repeat.largest > 0)
      faults.push_back("the same input gives another answer the second time" +
                       repeat.where);
    if (change.largest > no_change)
      faults.push_back("the stress changes by " + per_cent(change.largest) +
                       " without a strain" + change.where);
    if (tangent.largest > allowed_tangent_error)
      faults.push_back("the tangent is " + per_cent(tangent.largest) +
                       " off the derivative of the stress" + tangent.where);
    if (!material->has_symmetric_tangent() && skew.largest <= no_asymmetry)
      faults.push_back("the tangent is symmetric in all trials; 'Tangent = "
                       "symmetric' then saves time at small strain");
    return faults;
  }
} // namespace moraine
