// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_input_text_h
#define moraine_core_input_text_h

#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** The @p text of a file without the byte order mark that some editors begin
   * UTF-8 with, and which nobody sees. */
  std::string
  without_mark(const std::string &text);

  /**
   * A line of an input file from which comments are cut off.
   * @throw InputError, beginning with @p origin, for bytes that are no text in
   * UTF-8 and for a line of more than 100000 characters.
   */
  void
  check_text(const std::string &statement, const std::string &origin);

  /** Path of what has this name in a section, "" for the top level. */
  std::string
  join_path(const std::string &section, const std::string &name);

  /** The names in the path of a section. */
  std::vector<std::string>
  parts_of_path(const std::string &section);

  /**
   * The value @p text of a key with every `$name` replaced by the value of that
   * constant: where an operator is beside it, a negative number and a compound
   * expression in brackets.
   * @throw InputError, beginning with @p where, for a name that @p constants do
   * not have and for a text of more than 100000 characters.
   */
  std::string
  with_constants(
    const std::string                                      &text,
    const std::string                                      &where,
    const std::vector<std::pair<std::string, std::string>> &constants);

  /**
   * A value with its arithmetic done where the pattern, as deal.II describes
   * it, wants numbers.
   */
  std::string
  with_arithmetic(const std::string &value, const std::string &pattern);
} // namespace moraine

#endif
