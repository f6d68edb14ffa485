// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/diagnostics/ledger.h>

#include <moraine/core/ranges.h>


namespace moraine
{
  bool
  Ledger::has(const std::string &id) const
  {
    return any_of(all,
                  [&id](const Finding &finding) { return finding.id == id; });
  }



  bool
  Ledger::add(const Finding &finding)
  {
    if (has(finding.id))
      return false;
    all.push_back(finding);
    return true;
  }



  void
  Ledger::forget(const std::string &beginning)
  {
    for (auto it = numbers.lower_bound(beginning);
         it != numbers.end() && it->first.rfind(beginning, 0) == 0;)
      it = numbers.erase(it);
  }



  void
  Ledger::write(Archive &archive) const
  {
    std::vector<std::string> texts, names;
    std::vector<double>      values, limits;
    for (const Finding &finding : all)
      {
        texts.insert(texts.end(), {finding.id, finding.object, finding.text});
        limits.insert(limits.end(), {finding.value, finding.limit, finding.t});
      }
    for (const auto &[name, value] : numbers)
      {
        names.push_back(name);
        values.push_back(value);
      }
    archive.write_lines("ledger/findings", texts);
    archive.write("ledger/values_limits_and_times", limits, 3);
    archive.write_lines("ledger/names", names);
    archive.write("ledger/numbers", values);
  }



  void
  Ledger::read(const Archive &archive)
  {
    const auto texts  = archive.lines("ledger/findings");
    const auto limits = archive.numbers("ledger/values_limits_and_times", 3);
    const auto names  = archive.lines("ledger/names");
    const auto values = archive.numbers("ledger/numbers");
    all.clear();
    for (auto &[name, value] : numbers) // to which there are references
      value = 0;
    for (unsigned int k = 0; 3 * k + 2 < texts.size(); ++k)
      all.push_back({texts[3 * k],
                     texts[3 * k + 1],
                     limits[3 * k],
                     limits[3 * k + 1],
                     texts[3 * k + 2],
                     limits[3 * k + 2]});
    for (unsigned int k = 0; k < names.size(); ++k)
      numbers[names[k]] = values[k];
  }
} // namespace moraine
