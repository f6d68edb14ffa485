// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_diagnostics_stress_h
#define moraine_diagnostics_stress_h

#include <moraine/diagnostics/facts.h>

#include <optional>

namespace moraine
{
  /** estimated_stress_error() of all bodies; nothing where there is next to no
   * stress, or next to none of the energy is that of strain. Collective. */
  template <int dim>
  std::optional<double>
  stress_error(const Facts<dim> &facts);
} // namespace moraine

#endif
