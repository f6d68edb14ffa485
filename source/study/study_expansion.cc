// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/study_expansion.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** More than anybody waits for; their inputs fill the memory. */
    constexpr std::size_t most_cases = 10000;



    /** The choices of one text, split at '|' outside brackets. */
    std::vector<std::string>
    alternatives(const std::string &text, const std::string &where)
    {
      std::vector<std::string> words(1);
      int                      depth = 0;
      for (const char c : text)
        {
          depth += (c == '(') - (c == ')');
          if (c == '|' && depth == 0)
            words.emplace_back();
          else
            words.back() += c;
        }
      for (std::string &word : words)
        {
          word = Utilities::trim(word);
          if (word.empty())
            throw InputError(where + ": found '{{" + text +
                             "}}', which has an empty choice; allowed: "
                             "{{first|second|...}}");
        }
      return words;
    }



    /** All values that an entry's text stands for, its last choice fastest. */
    std::vector<std::string>
    expansions_of(const std::string &text, const std::string &where)
    {
      const auto begin = text.find("{{");
      if (begin == std::string::npos)
        {
          if (text.find("}}") != std::string::npos)
            throw InputError(where + ": found '" + text +
                             "', a '}}' without '{{'");
          return {text};
        }
      const auto end = text.find("}}", begin);
      if (end == std::string::npos)
        throw InputError(where + ": found '" + text + "', a '{{' without '}}'");

      std::vector<std::string> values;
      const auto tails = expansions_of(text.substr(end + 2), where);
      for (const std::string &word :
           alternatives(text.substr(begin + 2, end - begin - 2), where))
        for (const std::string &tail : tails)
          {
            if (values.size() == most_cases)
              throw InputError(where + ": found more than " +
                               std::to_string(most_cases) +
                               " choices in a value, allowed: a study of at "
                               "most that many cases");
            values.push_back(text.substr(0, begin) + word + tail);
          }
      return values;
    }



    std::string
    path_of(const InputFile::Entry &entry)
    {
      return entry.section.empty() ? entry.key :
                                     entry.section + "/" + entry.key;
    }



    void
    check_names(const InputFile::Entry &entry)
    {
      if (path_of(entry).find("{{") != std::string::npos)
        throw InputError(entry.origin + ": " + place(entry.section, entry.key) +
                         ": '{{' is allowed in values only");
    }



    std::string
    label_of(const std::vector<InputFile::Entry>                    &keys,
             const std::vector<std::pair<std::string, std::string>> &choices)
    {
      std::string label;
      for (std::size_t i = 0; i < keys.size(); ++i)
        {
          const auto same = std::count_if(keys.begin(),
                                          keys.end(),
                                          [&](const InputFile::Entry &other) {
                                            return other.key == keys[i].key;
                                          });
          label += (i == 0 ? "" : ", ") +
                   (same > 1 ? choices[i].first : keys[i].key) + " = " +
                   choices[i].second;
        }
      return label;
    }
  } // namespace



  std::vector<StudyCase>
  expand_study(const InputFile &input)
  {
    std::vector<InputFile::Entry> keys;
    std::vector<StudyCase>        cases{{input, {}, ""}};
    for (std::size_t e = 0; e < input.entries().size(); ++e)
      {
        const InputFile::Entry &entry = input.entries()[e];
        check_names(entry);
        const auto values =
          expansions_of(entry.value,
                        entry.origin + ": " + place(entry.section, entry.key));
        if (values.size() == 1 && values[0] == entry.value)
          continue;

        if (values.size() > most_cases / cases.size())
          throw InputError(entry.origin + ": " +
                           place(entry.section, entry.key) + ": found " +
                           std::to_string(values.size()) + " choices for " +
                           std::to_string(cases.size()) +
                           " combinations of those before, allowed: a study "
                           "of at most " +
                           std::to_string(most_cases) + " cases");
        keys.push_back(entry);
        std::vector<StudyCase> finer;
        for (const StudyCase &coarse : cases)
          for (const std::string &value : values)
            {
              finer.push_back(
                {coarse.input.with_value(e, value), coarse.choices, ""});
              finer.back().choices.emplace_back(path_of(entry), value);
            }
        cases = std::move(finer);
      }
    for (StudyCase &study_case : cases)
      study_case.label = label_of(keys, study_case.choices);
    return cases;
  }



  bool
  names_choice(const std::string &key, const std::string &path)
  {
    return key == path || (path.size() > key.size() &&
                           path.compare(path.size() - key.size() - 1,
                                        std::string::npos,
                                        "/" + key) == 0);
  }



  std::string
  value_of(const StudyCase &study_case, const std::string &key)
  {
    for (const auto &[path, value] : study_case.choices)
      if (names_choice(key, path))
        return value;
    return "";
  }



  std::vector<std::string>
  choice_paths(const std::vector<StudyCase> &cases)
  {
    std::vector<std::string> paths;
    for (const StudyCase &study_case : cases)
      for (const auto &choice : study_case.choices)
        if (!contains(paths, choice.first))
          paths.push_back(choice.first);
    return paths;
  }



  std::string
  refined_choice(const std::vector<StudyCase> &cases)
  {
    const auto paths = choice_paths(cases);
    const auto found =
      std::find_if(paths.rbegin(), paths.rend(), [](const auto &path) {
        return path.rfind("Mesh/", 0) == 0;
      });
    return found != paths.rend() ? *found :
           paths.empty()         ? std::string() :
                                   paths.back();
  }
} // namespace moraine
