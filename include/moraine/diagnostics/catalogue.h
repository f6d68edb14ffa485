// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_diagnostics_catalogue_h
#define moraine_diagnostics_catalogue_h

#include <ostream>
#include <string>
#include <vector>

namespace moraine
{
  enum class Severity
  {
    warning, ///< numbers may be wrong by more than 5 %
    hint     ///< in log.txt, and on the console with --verbose
  };

  /** A diagnostic as users read of it; see 'moraine explain'. */
  struct Diagnostic
  {
    std::string id;
    Severity    severity;
    std::string asked; ///< when
    std::string cause;
    std::string size; ///< how large the effect is; what value and limit are
    std::string cure;
  };

  /** All diagnostics, in the order of their ids. */
  const std::vector<Diagnostic> &
  catalogue();

  /** @throws InputError for an @p id that is not there; @p origin: who asks. */
  const Diagnostic &
  diagnostic(const std::string &id, const std::string &origin);

  /** The text of 'moraine explain ID'. */
  std::string
  explanation(const std::string &id);

  /** All of them as Markdown: doc/diagnostics.md. */
  void
  print_catalogue(std::ostream &out);
} // namespace moraine

#endif
