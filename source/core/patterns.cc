// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/patterns.h>

#include <moraine/core/words.h>

#include <fmt/format.h>

#include <regex>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr double smallest = std::numeric_limits<double>::min();

    /** "a|b|c " as "a, b, c"; a word without letters as "nothing". */
    std::string
    words_of(const std::string &selection)
    {
      std::string words;
      for (const std::string &word :
           Utilities::split_string_list(selection, '|'))
        words += (words.empty() ? "" : ", ") +
                 (word.empty() ? std::string("nothing") : word);
      return words;
    }



    /** @p no_lower and @p no_upper are deal.II's words for "no bound". */
    std::string
    bounded(const std::string &kind,
            const std::string &lower,
            const std::string &upper,
            const std::string &no_lower,
            const std::string &no_upper)
    {
      const bool has_lower = lower != no_lower, has_upper = upper != no_upper;
      if (has_lower && has_upper)
        return kind + " from " + lower + " to " + upper;
      if (has_lower)
        return kind + " >= " + lower;
      return has_upper ? kind + " <= " + upper : kind;
    }



    std::string
    plural(const std::string &allowed)
    {
      std::string text =
        std::regex_replace(allowed, std::regex("^an? "), std::string());
      return std::regex_replace(text,
                                std::regex("^(whole )?number"),
                                "$1numbers");
    }



    std::string
    describe_list(const std::string &inner,
                  const std::string &n_min,
                  const std::string &n_max,
                  const std::string &separator)
    {
      const std::string one  = describe(inner);
      const std::string many = plural(one);
      const std::string unbounded =
        std::to_string(std::numeric_limits<unsigned int>::max());
      const std::string end =
        ", separated by " + (separator.empty() || separator == "," ?
                               std::string("commas") :
                               "'" + separator + "'");
      if (n_min == n_max)
        return n_min == "1" ? one : n_min + " " + many + end;
      if (n_max != unbounded)
        return n_min + " to " + n_max + " " + many + end;
      if (n_min == "0" || n_min == "1")
        return (n_min == "0" ? "" : "one or more ") + many + end;
      return n_min + " or more " + many + end;
    }
  } // namespace



  namespace patterns
  {
    Patterns::Double
    positive()
    {
      return Patterns::Double(smallest);
    }

    Patterns::Double
    non_negative()
    {
      return Patterns::Double(0.);
    }

    Patterns::Double
    number()
    {
      return Patterns::Double();
    }

    Patterns::Integer
    positive_integer()
    {
      return Patterns::Integer(1);
    }

    Patterns::Integer
    integer_in_range(const int lower, const int upper)
    {
      return Patterns::Integer(lower, upper);
    }

    Patterns::List
    numbers(const unsigned int n_min, const unsigned int n_max)
    {
      return Patterns::List(Patterns::Double(), n_min, n_max);
    }

    Patterns::List
    positive_integers(const unsigned int n_min, const unsigned int n_max)
    {
      return Patterns::List(positive_integer(), n_min, n_max);
    }

    const char *const NumberText::description_init = "[NumberText]";

    std::string
    NumberText::description(const OutputStyle) const
    {
      return description_init;
    }

    std::unique_ptr<Patterns::PatternBase>
    NumberText::clone() const
    {
      return std::make_unique<NumberText>();
    }

    Patterns::Selection
    selection(const std::vector<std::string> &words)
    {
      return Patterns::Selection(fmt::format("{}", fmt::join(words, "|")));
    }

    Patterns::MultipleSelection
    several_of(const std::vector<std::string> &words)
    {
      return Patterns::MultipleSelection(
        fmt::format("{}", fmt::join(words, "|")));
    }
  } // namespace patterns



  std::string
  describe(const std::string &pattern_description)
  {
    static const std::regex number(
      R"(\[Double (\S+)\.\.\.(\S+) \(inclusive\)\])");
    static const std::regex integer(
      R"(\[Integer range (\S+?)\.\.\.(\S+) \(inclusive\)\])");
    static const std::regex list(
      R"(\[List of <(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\)(?: separated by <(.*)>)?\])");
    static const std::regex map(
      R"(\[Map of <(.*)>:<(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\)\])");
    static const std::regex selection(R"(\[Selection (.*)\])");
    static const std::regex several(R"(\[MultipleSelection (.*)\])");

    const std::string text = Utilities::trim(pattern_description);
    std::smatch       m;
    if (text == "[Bool]")
      return "true or false";
    if (text == "[Anything]")
      return "any text";
    if (text == patterns::NumberText::description_init)
      return "numbers in a text";
    if (text == "[DirectoryName]")
      return "the name of a directory";
    if (text.compare(0, 9, "[FileName") == 0)
      return "the name of a file";
    if (text == "[Double]")
      return "a number";
    if (text == "[Integer]")
      return "a whole number";
    if (std::regex_match(text, m, number))
      {
        if (m[1] == text_of(smallest))
          return m[2] == "MAX_DOUBLE" ? "a number > 0" :
                                        "a number > 0 and <= " + m[2].str();
        return bounded("a number", m[1], m[2], "-MAX_DOUBLE", "MAX_DOUBLE");
      }
    if (std::regex_match(text, m, integer))
      return bounded("a whole number",
                     m[1],
                     m[2],
                     std::to_string(std::numeric_limits<int>::min()),
                     std::to_string(std::numeric_limits<int>::max()));
    if (std::regex_match(text, m, list))
      return describe_list(m[1], m[2], m[3], m[4]);
    if (std::regex_match(text, m, map))
      return "pairs 'name: value', each value " + describe(m[2].str()) +
             ", separated by commas";
    if (std::regex_match(text, m, selection))
      return "one of " + words_of(m[1]);
    if (std::regex_match(text, m, several))
      return "any of " + words_of(m[1]) + ", separated by commas";
    return text;
  }



  std::string
  describe(const Patterns::PatternBase &pattern)
  {
    return describe(pattern.description());
  }
} // namespace moraine
