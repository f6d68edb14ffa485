// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_absorbing_parameters_h
#define moraine_scene_absorbing_parameters_h

#include <moraine/boundary/absorbing_boundary.h>

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** Keys of a boundary or a grid condition whose `Constraint` is absorbing. */
  struct AbsorbingParameters
  {
    std::vector<double> dashpot_factors   = {1., 1.};
    double              spring_radius     = 0;
    double              virtual_thickness = 0;
    std::vector<double> spring_stiffness;
    double              outer_density = 0;
    std::vector<double> outer_wave_speeds;
    std::vector<double> outer_impedances;
    std::string         incident_velocity;
    std::string         incident_curve;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** Whether the key is one of these. */
    static bool
    has(const std::string &key);

    /** @throws InputError for keys that contradict each other in section
     * @p section. */
    AbsorbingLaw
    law(const std::string &section) const;
  };
} // namespace moraine

#endif
