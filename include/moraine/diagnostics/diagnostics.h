// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_diagnostics_diagnostics_h
#define moraine_diagnostics_diagnostics_h

#include <moraine/diagnostics/energy_balance.h>
#include <moraine/diagnostics/facts.h>
#include <moraine/diagnostics/ledger.h>

#include <functional>
#include <string>

namespace moraine
{
  /** When diagnostics are asked. */
  enum class When
  {
    stage,       ///< it begins; the first one as well
    bodies_go,   ///< a stage is about to begin and changes bodies
    step_begins, ///< stencils and pieces are found
    step_ends,   ///< accepted
    strains_end, ///< displacements are about to be reset, or the run ends
    end          ///< of the run
  };

  /** Asks the checks of a run and keeps what they find. Collective. */
  template <int dim>
  class Diagnostics
  {
  public:
    explicit Diagnostics(const typename Facts<dim>::Objects &objects);

    /** Is told of each finding once. */
    std::function<void(const Finding &)> listener;

    /** Ask what is asked then. @return whether anything new was found. */
    bool
    ask(const When when, const typename Facts<dim>::Moment &moment);

    /** Keep a finding of the run itself. @return whether it is new and not
     * silenced. */
    bool
    report(Finding finding);

    /** Forget what belongs to the stage before. @p bodies_change: they come or
     * go; @p motion_starts: works are counted from here. */
    void
    stage_begins(const bool bodies_change, const bool motion_starts);

    /** Why the run cannot go on: see EnergyBalance::failure(). */
    std::string
    failure() const;

    const Facts<dim> &
    facts() const
    {
      return all_facts;
    }

    Ledger ledger;

  private:
    void
    ask_energy();

    Facts<dim>    all_facts;
    EnergyBalance energy;
  };
} // namespace moraine

#endif
