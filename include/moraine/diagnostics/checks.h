// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_diagnostics_checks_h
#define moraine_diagnostics_checks_h

#include <moraine/diagnostics/facts.h>
#include <moraine/diagnostics/ledger.h>

#include <optional>

namespace moraine
{
  /**
   * The diagnostics, each a function of the facts of a moment and of the
   * numbers that it keeps in the ledger. Each returns the worst it finds; see
   * diagnostics.cc for when it is asked and catalogue.cc for what it means. All
   * are collective.
   */
  namespace checks
  {
    template <int dim>
    using Check = std::optional<Finding> (*)(Facts<dim> &, Ledger &);

    /** The object with the largest value above a limit. */
    struct Worst : Finding
    {
      Worst(const std::string &id, const double limit)
        : Finding{id, "", limit, limit, ""}
      {}

      /** @return whether it is the worst so far. */
      bool
      take(const std::string &name, const double of_name)
      {
        if (!(of_name > value))
          return false;
        object = name;
        value  = of_name;
        return true;
      }

      /** The finding with this sentence, or nothing. */
      std::optional<Finding>
      with(const std::string &sentence)
      {
        text = sentence;
        return object.empty() ? std::nullopt : std::optional<Finding>(*this);
      }
    };

#define MORAINE_CHECK(name) \
  template <int dim>        \
  std::optional<Finding> name(Facts<dim> &facts, Ledger &ledger);

    // As the scene or a stage begins
    MORAINE_CHECK(ends_in_cells)
    MORAINE_CHECK(held_beside_bodies)
    MORAINE_CHECK(away_from_bodies)
    MORAINE_CHECK(inside_bodies)
    MORAINE_CHECK(nitsche_flux)
    MORAINE_CHECK(idle_conditions)
    MORAINE_CHECK(coarse_loads)
    MORAINE_CHECK(loads_outside)
    MORAINE_CHECK(full_cells)
    MORAINE_CHECK(uneven_cells)
    MORAINE_CHECK(volume_twice)
    MORAINE_CHECK(thin_bodies)
    MORAINE_CHECK(shared_cells)
    MORAINE_CHECK(near_bodies)
    MORAINE_CHECK(conflicting_constraints)
    MORAINE_CHECK(absorbing_at_rest)
    MORAINE_CHECK(absorbing_on_new_bodies)
    // Before bodies go
    MORAINE_CHECK(removed_bodies)
    // As a step begins
    MORAINE_CHECK(separation)
    MORAINE_CHECK(lost_boundaries)
    MORAINE_CHECK(pushed_off_nodes)
    MORAINE_CHECK(cell_crossing)
    MORAINE_CHECK(bodies_meet)
    // After a step
    MORAINE_CHECK(missed_boundaries)
    MORAINE_CHECK(passed_boundaries)
    MORAINE_CHECK(grown_past_ends)
    MORAINE_CHECK(points_apart)
    MORAINE_CHECK(turned_at_small_strain)
    MORAINE_CHECK(slide)
    MORAINE_CHECK(energy_growth)
    MORAINE_CHECK(domains_beyond_cells)
    MORAINE_CHECK(returned_points)
    // At the end, or before displacements are reset
    MORAINE_CHECK(strained_at_small_strain)
    MORAINE_CHECK(moved_at_small_strain)
    MORAINE_CHECK(nothing_happened)
    MORAINE_CHECK(stress_resolution)

#undef MORAINE_CHECK

#define MORAINE_INSTANTIATE_CHECK(name)                       \
  template std::optional<Finding> name(Facts<2> &, Ledger &); \
  template std::optional<Finding> name(Facts<3> &, Ledger &);
  } // namespace checks
} // namespace moraine

#endif
