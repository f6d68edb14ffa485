// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/units.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <cctype>

namespace moraine
{
  namespace
  {
    /** A unit made of others that has a name of its own. */
    struct Named
    {
      const char *force, *length, *name;
    };

    constexpr Named stresses[] = {{"N", "m", "Pa"},
                                  {"kN", "m", "kPa"},
                                  {"MN", "m", "MPa"},
                                  {"N", "mm", "MPa"},
                                  {"kN", "mm", "GPa"}};
    /** With seconds. */
    constexpr Named masses[] = {{"N", "m", "kg"},
                                {"kN", "m", "t"},
                                {"MN", "m", "kt"},
                                {"N", "mm", "t"}};

    template <class List>
    std::string
    named(const List &list, const Units &units, const std::string &otherwise)
    {
      for (const Named &unit : list)
        if (units.force == unit.force && units.length == unit.length)
          return unit.name;
      return otherwise;
    }
  } // namespace



  Units::Units(const std::vector<std::string> &words)
  {
    if (words.empty())
      return;
    if (words.size() != 3)
      reject("",
             "Units",
             list_of(words),
             "units of length, force and time, as m, kN, s; or nothing");
    length = words[0];
    force  = words[1];
    time   = words[2];
  }



  std::string
  Units::of(const std::string &quantity) const
  {
    if (length.empty())
      return quantity;
    const auto unit = [this](const std::string &word) {
      if (word == "length")
        return length;
      if (word == "force")
        return force;
      if (word == "time")
        return time;
      if (word == "stress")
        return named(stresses, *this, force + "/" + length + "^2");
      if (word == "mass")
        {
          const std::string mass = force + " " + time + "^2/" + length;
          return time == "s" ? named(masses, *this, mass) : mass;
        }
      return word;
    };
    std::string text, word;
    for (const char c : quantity + '\n')
      if (std::isalpha(static_cast<unsigned char>(c)))
        word += c;
      else
        {
          text += unit(word) + c;
          word.clear();
        }
    text.pop_back();
    return text;
  }
} // namespace moraine
