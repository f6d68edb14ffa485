// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_contact_parameters_h
#define moraine_scene_contact_parameters_h

#include <moraine/boundary/contact_law.h>

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** Keys of a boundary whose `Constraint` is contact. */
  struct ContactParameters
  {
    double friction         = 0;
    double friction_angle   = 0; ///< degrees
    double adhesion         = 0;
    double tensile_strength = 0;
    bool   separation       = true;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** Whether the key is one of these. */
    static bool
    has(const std::string &key);

    /** @throws InputError for keys that contradict each other in section
     * @p section. */
    ContactLaw
    law(const std::string &section) const;
  };
} // namespace moraine

#endif
