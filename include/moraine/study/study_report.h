// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_study_report_h
#define moraine_study_study_report_h

#include <moraine/core/console.h>
#include <moraine/output/summary.h>
#include <moraine/scene/study_parameters.h>
#include <moraine/study/study_expansion.h>

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** What a study is of and where its results go. */
  struct StudySetting
  {
    const InputFile &input;
    std::string      folder;
    bool             overwrite; ///< the results of an earlier study
    MPI_Comm         communicator;
    Console         &console;

    /** Path of a file in the folder. */
    std::string
    file(const std::string &name) const;
  };

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

  /** Write study.csv with a row for each result so far. Collective. */
  void
  write_csv(const StudySetting             &setting,
            const std::vector<StudyResult> &results);

  /** Print a table with a line for each result. */
  void
  print_table(const StudySetting             &setting,
              const std::vector<StudyCase>   &cases,
              const std::vector<StudyResult> &results);

  /**
   * Write study.gp and, if gnuplot is there, study.png: error over unknowns and
   * over wall time, side by side. On one rank only.
   */
  void
  plot(const StudySetting             &setting,
       const StudyParameters          &parameters,
       const std::vector<StudyCase>   &cases,
       const std::vector<StudyResult> &results);
} // namespace moraine

#endif
