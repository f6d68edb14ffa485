// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/input_text.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <deal.II/base/utilities.h>

#include <cctype>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Bytes of the character that begins at @p at; 0 if that is no UTF-8. */
    std::size_t
    character_length(const std::string &text, const std::size_t at)
    {
      const auto        byte   = static_cast<unsigned char>(text[at]);
      const std::size_t length = byte < 0x80                  ? 1 :
                                 byte >= 0xc2 && byte < 0xe0  ? 2 :
                                 byte >= 0xe0 && byte < 0xf0  ? 3 :
                                 byte >= 0xf0 && byte <= 0xf4 ? 4 :
                                                                0;
      for (std::size_t i = 1; i < length; ++i)
        if (at + i >= text.size() ||
            (static_cast<unsigned char>(text[at + i]) & 0xc0) != 0x80)
          return 0;
      return length;
    }



    /** What stands for a constant with this value between @p before and @p
     * after: where an operator is beside it, a negative number and a compound
     * expression in brackets. */
    std::string
    insertion(const std::string &value,
              const std::string &before,
              const std::string &after)
    {
      const std::string left  = Utilities::trim(before),
                        right = Utilities::trim(after);
      const auto is_beside    = [&](const std::string &operators_before,
                                 const std::string &operators_after) {
        return (!left.empty() &&
                operators_before.find(left.back()) != std::string::npos) ||
               (!right.empty() &&
                operators_after.find(right.front()) != std::string::npos);
      };
      const bool is_negative = value.front() == '-' && plain_number(value);
      const bool in_brackets =
        is_negative ?
          is_beside("+-*/^", "^") :
          is_beside("+-*/^<>&|", "+-*/^<>&|?") && is_compound(value);
      return in_brackets ? "(" + value + ")" : value;
    }
  } // namespace



  std::string
  without_mark(const std::string &text)
  {
    const std::string mark = "\xef\xbb\xbf";
    return text.compare(0, mark.size(), mark) == 0 ? text.substr(mark.size()) :
                                                     text;
  }



  void
  check_text(const std::string &statement, const std::string &origin)
  {
    constexpr std::size_t longest = 100000;
    if (statement.size() > longest)
      throw InputError(origin + ": found a line of " +
                       std::to_string(statement.size()) +
                       " characters, allowed: " + std::to_string(longest));
    std::size_t length = 1;
    for (std::size_t at = 0; at < statement.size(); at += length)
      {
        const auto byte = static_cast<unsigned char>(statement[at]);
        length          = character_length(statement, at);
        if (length == 0 || byte < ' ' || byte == 0x7f)
          throw InputError(origin + ": found the byte " + std::to_string(byte) +
                           " at character " + std::to_string(at + 1) +
                           ", allowed: text in UTF-8");
      }
  }



  std::string
  join_path(const std::string &section, const std::string &name)
  {
    return section.empty() ? name : section + "/" + name;
  }



  std::vector<std::string>
  parts_of_path(const std::string &section)
  {
    return section.empty() ? std::vector<std::string>() :
                             Utilities::split_string_list(section, '/');
  }



  std::string
  with_constants(
    const std::string                                      &text,
    const std::string                                      &where,
    const std::vector<std::pair<std::string, std::string>> &constants)
  {
    constexpr std::size_t longest = 100000;
    const auto            is_name = [](const char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    std::string value = text;
    std::size_t at    = value.find('$');
    while (at != std::string::npos)
      {
        std::size_t end = at + 1;
        while (end < value.size() && is_name(value[end]))
          ++end;
        const std::string        name     = value.substr(at + 1, end - at - 1);
        const std::string       *constant = nullptr;
        std::vector<std::string> known;
        for (const auto &[other, other_text] : constants)
          {
            known.push_back("$" + other);
            if (other == name)
              constant = &other_text;
          }
        if (constant == nullptr)
          throw InputError(
            where + ": found '$" + name + "'" +
            (known.empty() ? "; no constant is defined before it" : "") +
            suggest("$" + name, known));
        const std::string inserted =
          insertion(*constant, value.substr(0, at), value.substr(end));
        value.replace(at, end - at, inserted);
        if (value.size() > longest)
          throw InputError(where +
                           ": found a text that its constants make longer "
                           "than " +
                           std::to_string(longest) + " characters");
        at = value.find('$', at + inserted.size());
      }
    return value;
  }



  std::string
  with_arithmetic(const std::string &value, const std::string &pattern)
  {
    const auto wants = [&pattern](const std::string &begin) {
      return pattern.compare(0, begin.size(), begin) == 0;
    };
    if (wants("[Double") || wants("[Integer"))
      return with_numbers(value, "");
    if (wants("[List of <[Double") || wants("[List of <[Integer"))
      return with_numbers(value, ",");
    if (wants(patterns::NumberText::description_init))
      return with_numbers(value, " ,;:");
    if (!wants("[Map of <[Anything]>:<[Double"))
      return value;
    std::string pairs;
    for (const std::string &pair : split_outside_brackets(value, ","))
      {
        const auto colon = pair.find(':');
        pairs += (pairs.empty() ? "" : ", ") + pair.substr(0, colon);
        if (colon != std::string::npos)
          pairs += ":" + with_numbers(pair.substr(colon + 1), "");
      }
    return pairs;
  }
} // namespace moraine
