// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_patterns_h
#define moraine_core_patterns_h

#include <deal.II/base/patterns.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * The values keys may have. All are deal.II patterns, so they go straight
   * into ParameterHandler::add_parameter(). None of them takes nan or inf.
   */
  namespace patterns
  {
    /** A number > 0: the smallest value taken is the smallest normal double. */
    dealii::Patterns::Double
    positive();

    /** A number >= 0. */
    dealii::Patterns::Double
    non_negative();

    /** Any number. */
    dealii::Patterns::Double
    number();

    /**
     * A whole number >= 1. Give a pattern to every unsigned member: the one
     * that deal.II chooses takes -2 and makes 4294967294 of it.
     */
    dealii::Patterns::Integer
    positive_integer();

    /** A whole number from @p lower to @p upper, both included. */
    dealii::Patterns::Integer
    integer_in_range(const int lower, const int upper);

    /** Numbers separated by commas, at least @p n_min, at most @p n_max. */
    dealii::Patterns::List
    numbers(
      const unsigned int n_min = 0,
      const unsigned int n_max = std::numeric_limits<unsigned int>::max());

    /** Whole numbers >= 1 separated by commas. */
    dealii::Patterns::List
    positive_integers(
      const unsigned int n_min = 0,
      const unsigned int n_max = std::numeric_limits<unsigned int>::max());

    /**
     * A text of numbers, as the corners of a polygon "0 0; 1 0; 1 1": any text
     * for deal.II, but arithmetic between blanks, ',', ';' and ':' is done when
     * it is read.
     */
    class NumberText : public dealii::Patterns::Anything
    {
    public:
      static const char *const description_init;

      std::string
      description(const OutputStyle style = Machine) const override;

      std::unique_ptr<dealii::Patterns::PatternBase>
      clone() const override;
    };

    /** One of the words. */
    dealii::Patterns::Selection
    selection(const std::vector<std::string> &words);

    /** Any number of the words, separated by commas. */
    dealii::Patterns::MultipleSelection
    several_of(const std::vector<std::string> &words);
  } // namespace patterns

  /**
   * What a pattern allows, in words: "a number > 0", "2 numbers, separated by
   * commas". Takes what PatternBase::description() gives (and so what deal.II
   * stores for each declared entry); a text it does not know comes back as is.
   */
  std::string
  describe(const std::string &pattern_description);

  /** The same for a pattern. */
  std::string
  describe(const dealii::Patterns::PatternBase &pattern);
} // namespace moraine

#endif
