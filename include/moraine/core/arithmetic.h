// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_arithmetic_h
#define moraine_core_arithmetic_h

#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Parts of @p text between separators that stand outside all brackets,
   * without blanks around them.
   */
  std::vector<std::string>
  split_outside_brackets(const std::string &text,
                         const std::string &separators);

  /** The finite number that @p text is, as "1e3"; nothing if it is none. */
  std::optional<double>
  plain_number(const std::string &text);

  /**
   * The finite number that @p text is, or that it gives by arithmetic: "100/7",
   * "sqrt(2)*pi", in muParser syntax with the constant pi and without any other
   * name. Nothing if it is neither, or if it asks for random numbers.
   */
  std::optional<double>
  number_from(const std::string &text);

  /**
   * @p text with every part that is arithmetic replaced by its value in 17
   * digits; plain numbers and everything else stay as they are. Parts are
   * separated by the characters of @p separators that stand outside brackets.
   */
  std::string
  with_numbers(const std::string &text, const std::string &separators);

  /**
   * Whether @p text is an expression in x, y, z and t of which an operator
   * stands outside all brackets, so that it needs some beside another operator:
   * "1+t", and not "2", "sin(x)" or "slope-1".
   */
  bool
  is_compound(const std::string &text);

  /** Whether one of @p names stands in an expression as a whole word. */
  bool
  has_name(const std::string              &expression,
           const std::vector<std::string> &names);

  /** Whether an expression calls rand() or rand_seed(). */
  bool
  is_random(const std::string &expression);
} // namespace moraine

#endif
