// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_study_expansion_h
#define moraine_study_study_expansion_h

#include <moraine/core/input_file.h>

#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** One combination of a study. */
  struct StudyCase
  {
    /** The scene with every choice made. */
    InputFile input;

    /** Path of each key with choices ("Mesh/Cell size") and its value. */
    std::vector<std::pair<std::string, std::string>> choices;

    /**
     * The choices in a line: "Cell size = 5, Method = GIMP". Keys that share a
     * name are given with their path.
     */
    std::string label;
  };

  /**
   * Every combination of the `{{a|b|c}}` in the values of a scene, the last one
   * in the file varying fastest. One value may hold several; equal ones vary
   * each on its own. A scene without any is one case without choices.
   *
   * @throw InputError naming file, line and key for a `{{` that is not closed,
   * an empty choice, or `{{` outside of a value.
   */
  std::vector<StudyCase>
  expand_study(const InputFile &input);

  /** Whether @p key, as written by the user, means the choice @p path. */
  bool
  names_choice(const std::string &key, const std::string &path);

  /** What a case chose for a key, as written by the user; empty if nothing. */
  std::string
  value_of(const StudyCase &study_case, const std::string &key);

  /** The paths of all choices, in the order in which the cases bring them. */
  std::vector<std::string>
  choice_paths(const std::vector<StudyCase> &cases);

  /**
   * The choice along which errors should fall: the last one in section 'Mesh',
   * or else the last; empty if there is none.
   */
  std::string
  refined_choice(const std::vector<StudyCase> &cases);
} // namespace moraine

#endif
