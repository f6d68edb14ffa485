// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/words.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

namespace moraine
{
  std::string
  lower_case(std::string text)
  {
    std::transform(text.begin(),
                   text.end(),
                   text.begin(),
                   [](const unsigned char c) { return std::tolower(c); });
    return text;
  }



  std::string
  one_word(const std::string &text)
  {
    std::string word = "'";
    for (const char c : text)
      word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
  }



  namespace
  {
    std::size_t
    edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const std::size_t replaced = diagonal + (a[i] != b[j]);
              diagonal                   = row[j + 1];
              row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row.back();
    }
  } // namespace



  bool
  contains(const std::vector<std::string> &words, const std::string &word)
  {
    return std::find(words.begin(), words.end(), word) != words.end();
  }



  std::string
  nearest(const std::string &word, const std::vector<std::string> &known)
  {
    std::string best;
    std::size_t best_distance =
      std::max<std::size_t>(1, (word.size() + 2) / 3) + 1;
    for (const std::string &candidate : known)
      {
        const std::size_t distance =
          edit_distance(lower_case(word), lower_case(candidate));
        if (distance < best_distance)
          {
            best          = candidate;
            best_distance = distance;
          }
      }
    return best;
  }



  std::string
  suggest(const std::string &word, const std::vector<std::string> &known)
  {
    const std::string near = nearest(word, known);
    return (near.empty() ? std::string(".") :
                           "; did you mean '" + near + "'?") +
           " Allowed here: " + list_of(known);
  }



  std::string
  text_of(const double value, const unsigned int digits)
  {
    return fmt::format("{:.{}g}", value, digits);
  }



  std::string
  per_cent(const double share)
  {
    return (std::abs(share) < 0.095 ? text_of(100 * share, 2) :
                                      text_of(std::round(100 * share))) +
           " %";
  }



  std::string
  list_of(const std::vector<std::string> &words)
  {
    return words.empty() ? "nothing" :
                           fmt::format("{}", fmt::join(words, ", "));
  }
} // namespace moraine
