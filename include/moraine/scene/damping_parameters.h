// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_damping_parameters_h
#define moraine_scene_damping_parameters_h

#include <moraine/assembly/rayleigh_damping.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace moraine
{
  /** Keys of a section `Bodies/<name>` that damp the body: two factors, or the
   * damping ratio at two frequencies. */
  struct DampingParameters
  {
    double              mass_factor      = 0;
    double              stiffness_factor = 0;
    double              ratio            = 0;
    std::vector<double> frequencies;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** @throws InputError, naming @p section, for keys that contradict each
     * other, or that need what is missing; in a @p quasi_static run for any. */
    RayleighFactors
    factors(const std::string &section, const bool quasi_static) const;
  };
} // namespace moraine

#endif
