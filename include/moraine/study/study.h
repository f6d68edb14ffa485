// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_study_h
#define moraine_study_study_h

#include <moraine/core/json.h>
#include <moraine/run/simulation.h>
#include <moraine/study/study_report.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * The cases of a study: every combination of the choices in the scene, for
   * every series of section `Study/Series` if there are any. The choice of the
   * series comes first, with the path "Series".
   *
   * @throw InputError for mistakes in the choices or in a series.
   */
  std::vector<StudyCase>
  study_cases(const InputFile &input);

  /**
   * Simulate a scene without output. How it failed is the status of the
   * summary, "wrong input" if by a mistake in the scene; what fails before the
   * first step, or in @p after_2d or @p after_3d, has no version. Collective.
   */
  Summary
  summary_of_case(const InputFile   &input,
                  const MPI_Comm    &communicator,
                  const AfterRun<2> &after_2d = {},
                  const AfterRun<3> &after_3d = {});

  /**
   * @throw InputError for a stage with inertia, with which a study of @p kind
   * makes no sense: @p why.
   */
  void
  refuse_inertia(const NamedStages &stages,
                 const std::string &kind,
                 const std::string &why);

  /**
   * Make the folder of a study, or take the one that is there, and keep the
   * input in it as study.prm. Collective.
   * @throw InputError if it holds a study that may not be replaced, or a run
   * although the study @p has_summary of its own, or if it cannot be made.
   */
  void
  make_study_folder(const StudySetting &setting, const bool has_summary);

  /** Write summary.json with what there is to say of each case. Collective. */
  void
  write_study_summary(const StudySetting      &setting,
                      const std::vector<Json> &cases);

  /** The code of the case that went worst; @p statuses are those of all. */
  int
  exit_code_of(const std::vector<std::string> &statuses);

  /**
   * Runs the cases of a study one after the other in this process and keeps,
   * in the output folder, study.csv (rewritten after each case), and at the end
   * study.gp and study.png, error against unknowns and against wall time.
   *
   * A case that fails is a row whose status says so. Peak memory is that of
   * the case where the system lets us reset it, and else of all so far. A case
   * below 0.1 s is run five times, and the run with the median time counts. A
   * first case below 10 s is run once more before, because the first run of a
   * process takes longer.
   *
   * @return an exit code: that of the case that went worst.
   * @throw InputError for a mistake in the text of any case, if what is to be
   * plotted differs between them, or if the folder holds a study that may not
   * be replaced.
   */
  int
  run_study(const StudySetting &setting);
} // namespace moraine

#endif
