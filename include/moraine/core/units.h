// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_units_h
#define moraine_core_units_h

#include <string>
#include <vector>

namespace moraine
{
  /**
   * The units of a scene, from which all others follow. They only name numbers
   * in results and change none. Without units a quantity is named instead.
   */
  struct Units
  {
    std::string length, force, time; ///< all empty: none

    Units() = default;

    /** Of three words or none, as `Units = m, kN, s`.
     * @throw InputError for another number of words */
    explicit Units(const std::vector<std::string> &words);

    /**
     * The unit of a quantity made of the words length, force, time, stress and
     * mass: "force/length^2" is "kN/m^2", "stress" "kPa". Without units, and
     * for "-", it is @p quantity itself.
     */
    std::string
    of(const std::string &quantity) const;
  };
} // namespace moraine

#endif
