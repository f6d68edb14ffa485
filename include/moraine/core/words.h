// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_words_h
#define moraine_core_words_h

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace moraine
{
  /** Whether @p word is one of @p words. */
  bool
  contains(const std::vector<std::string> &words, const std::string &word);

  /**
   * The word of @p known that is most like @p word (Levenshtein distance, upper
   * and lower case alike), or an empty text if none is near: more than a third
   * of the letters would have to change.
   */
  std::string
  nearest(const std::string &word, const std::vector<std::string> &known);

  /**
   * "; did you mean 'X'? Allowed here: X, Y, Z" for a message about an unknown
   * @p word; the question is left out if nothing is near.
   */
  std::string
  suggest(const std::string &word, const std::vector<std::string> &known);

  /** A number with at most so many significant digits. */
  std::string
  text_of(const double value, const unsigned int digits = 6);

  std::string
  lower_case(std::string text);

  /** A text in quotes such that the shell takes it as it is. */
  std::string
  one_word(const std::string &text);

  /** The components of a place or vector. */
  template <int dim>
  std::string
  coordinates(const dealii::Tensor<1, dim> &x,
              const unsigned int            digits    = 6,
              const std::string            &separator = " ")
  {
    std::string text = text_of(x[0], digits);
    for (unsigned int d = 1; d < dim; ++d)
      text += separator + text_of(x[d], digits);
    return text;
  }

  /** A @p share as "0.12 %", "7.5 %" or "130 %". */
  std::string
  per_cent(const double share);

  /** The words joined by ", "; "nothing" if there are none. */
  std::string
  list_of(const std::vector<std::string> &words);
} // namespace moraine

#endif
