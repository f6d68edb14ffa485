// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/arithmetic.h>

#include <moraine/core/silent_errors.h>
#include <moraine/core/words.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Whether muParser has to be asked at all. */
    bool
    may_be_arithmetic(const std::string &text)
    {
      constexpr std::size_t longest = 10000;
      for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
            std::string("_.+-*/^(), \t<>=!&|?:").find(c) == std::string::npos)
          return false;
      return !text.empty() && text.size() <= longest && !is_random(text) &&
             split_outside_brackets(text, ",").size() == 1;
    }



    /** A whole number that is missed by round-off, as 0.3/0.1, is meant. */
    std::string
    in_17_digits(const double value)
    {
      constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
      const double     whole     = std::round(value);
      const bool       is_whole =
        std::abs(value - whole) <= round_off * std::abs(value);
      return text_of(is_whole ? whole : value, 17);
    }
  } // namespace



  std::vector<std::string>
  split_outside_brackets(const std::string &text, const std::string &separators)
  {
    std::vector<std::string> parts(1);
    int                      depth = 0;
    for (const char c : text)
      {
        depth += (c == '(') - (c == ')');
        if (depth == 0 && separators.find(c) != std::string::npos)
          parts.emplace_back();
        else
          parts.back() += c;
      }
    for (std::string &part : parts)
      part = Utilities::trim(part);
    return parts;
  }



  std::optional<double>
  plain_number(const std::string &text)
  {
    try
      {
        const double number = Utilities::string_to_double(text);
        if (std::isfinite(number))
          return number;
      }
    catch (const ExceptionBase &)
      {}
    return std::nullopt;
  }



  std::optional<double>
  number_from(const std::string &text)
  {
    if (const auto number = plain_number(text))
      return number;
    if (!may_be_arithmetic(text))
      return std::nullopt;
    const SilentErrors silent;
    try
      {
        // The parser wants a variable; no user writes this one.
        FunctionParser<1> parser(1);
        parser.initialize("no_variable", text, {{"pi", numbers::PI}});
        const double number = parser.value(Point<1>());
        if (std::isfinite(number))
          return number;
      }
    catch (...) // muParser's own are no standard exceptions
      {}
    return std::nullopt;
  }



  bool
  is_compound(const std::string &text)
  {
    if (plain_number(text) || !may_be_arithmetic(text) ||
        split_outside_brackets(text, "+-*/^<>=!&|?").size() == 1)
      return false;
    const SilentErrors silent;
    try
      {
        FunctionParser<3> parser(1);
        parser.initialize("x,y,z,t", text, {{"pi", numbers::PI}}, true);
        parser.value(Point<3>());
        return true;
      }
    catch (...) // muParser's own are no standard exceptions
      {
        return false;
      }
  }



  std::string
  with_numbers(const std::string &text, const std::string &separators)
  {
    std::string result, part;
    const auto  close_part = [&]() {
      const std::string word = Utilities::trim(part);
      if (!plain_number(word))
        if (const auto value = number_from(word))
          part.replace(part.find(word), word.size(), in_17_digits(*value));
      result += part;
      part.clear();
    };
    int depth = 0;
    for (const char c : text)
      {
        depth += (c == '(') - (c == ')');
        if (depth == 0 && separators.find(c) != std::string::npos)
          {
            close_part();
            result += c;
          }
        else
          part += c;
      }
    close_part();
    return result;
  }



  bool
  has_name(const std::string &expression, const std::vector<std::string> &names)
  {
    const auto in_name = [](const char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    for (auto begin = expression.begin(); begin != expression.end();)
      {
        const auto end = std::find_if_not(begin, expression.end(), in_name);
        if (contains(names, std::string(begin, end)))
          return true;
        begin = std::find_if(end, expression.end(), in_name);
      }
    return false;
  }



  bool
  is_random(const std::string &expression)
  {
    return has_name(expression, {"rand", "rand_seed"});
  }
} // namespace moraine
