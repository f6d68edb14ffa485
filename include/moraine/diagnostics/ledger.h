// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_diagnostics_ledger_h
#define moraine_diagnostics_ledger_h

#include <moraine/core/finding.h>
#include <moraine/core/simulation_state.h>

#include <map>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * The findings of a run, one for each id, and the numbers that diagnostics
   * carry from step to step.
   */
  class Ledger : public StatePart
  {
  public:
    Ledger() = default;

    Ledger(const Ledger &) = delete;

    /** Whether a finding with this id is there. */
    bool
    has(const std::string &id) const;

    /** Keep the finding unless there is one with its id. @return whether it is
     * kept. */
    bool
    add(const Finding &finding);

    const std::vector<Finding> &
    findings() const
    {
      return all;
    }

    /** A number by name, 0 at first; the reference stays valid. */
    double &
    number(const std::string &name)
    {
      return numbers[name];
    }

    bool
    has_number(const std::string &name) const
    {
      return numbers.count(name) > 0;
    }

    /** Forget the numbers whose names begin so. */
    void
    forget(const std::string &beginning);

    /** Data sets "ledger/...". */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    std::vector<Finding>          all;
    std::map<std::string, double> numbers;
  };
} // namespace moraine

#endif
