// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_study_report_h
#define moraine_study_study_report_h

#include <moraine/core/console.h>
#include <moraine/output/summary.h>
#include <moraine/study/study_expansion.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** One row of a study. */
  struct StudyResult
  {
    StudyCase             study_case;
    Summary               summary;
    std::optional<double> error; ///< the one that is plotted
    std::optional<double> value; ///< of a column of the history, at the end
  };

  /** The column of the history that `Study / Error` names, with or without
   * 'probe' or 'history' before it. */
  std::string
  column_of_error(const std::string &error);

  /**
   * Without a reference value: the error of each result with a value becomes
   * @f$|v/v' - 1|@f$, where @f$v'@f$ is that of the next finer case (more
   * unknowns or steps, all other choices equal); the finest has none.
   */
  void
  compare_neighbours(const std::vector<StudyCase> &cases,
                     std::vector<StudyResult>     &results);

  /** Keys of choices as short as they are distinct. */
  std::vector<std::string>
  short_names(const std::vector<std::string> &paths);

  /** A number with so many digits. */
  std::string
  text_of(const double value, const unsigned int digits);

  /** A text in quotes such that the shell takes it as it is. */
  std::string
  one_word(const std::string &text);

  /**
   * What a study leaves for its reader: study.csv, a table on the console,
   * study.gp and study.png.
   */
  struct StudyReport
  {
    std::string                     folder;
    std::string                     title;
    std::string                     error;     ///< its name; empty: the first
    std::string                     reference; ///< to name; empty: none
    std::string                     group_by;
    std::string                     panels;
    const std::vector<StudyCase>   &cases;
    const std::vector<StudyResult> &results;

    /** A row for each result so far. On one rank only. */
    void
    write_csv() const;

    void
    print_table(Console &console) const;

    /**
     * Error over unknowns and over wall time, side by side. On one rank only.
     */
    void
    plot(Console &console) const;

    /** Results that differ in one choice only, the coarsest first. */
    struct Curve
    {
      std::string                      name;
      std::vector<const StudyResult *> results;
    };

    std::vector<Curve>
    curves() const;

    /** Most curves in a panel: each has a colour and a symbol of its own. */
    static constexpr unsigned int most_curves = 8;

    /** Numbers of the curves in each panel. */
    std::vector<std::vector<unsigned int>>
    panels_of(const std::vector<Curve> &all) const;

  private:
    std::string
    error_label() const;

    void
    write_script(const std::vector<Curve> &all) const;
  };
} // namespace moraine

#endif
