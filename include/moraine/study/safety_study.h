// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_safety_study_h
#define moraine_study_safety_study_h

#include <moraine/core/console.h>
#include <moraine/core/input_file.h>
#include <moraine/core/json.h>
#include <moraine/output/summary.h>
#include <moraine/study/study_report.h>

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Finds the factor of safety of a scene, and of each case if it has choices
   * `{{a|b}}`, by strength reduction: the largest factor F by which the shear
   * strength can be divided such that there is still equilibrium at every step
   * to the end. The interval from `Lower factor` to `Upper factor` is halved;
   * each trial is a run of its own from the start. What is left of the interval
   * has the answer, and its middle is given.
   *
   * Source: Griffiths and Lane 1999, where a slope fails if the iteration finds
   * no equilibrium. Ours is stricter: a step that fails is cut first, down to
   * `Smallest step`.
   *
   * Keeps, in the output folder, study.csv with a row for each trial, rewritten
   * after each, and summary.json, rewritten after each case.
   */
  class SafetyStudy
  {
  public:
    /**
     * Read all cases and make the folder.
     * @throw InputError for a mistake in the text of any of them, for bodies
     * with inertia, or if the folder holds results and @p overwrite is not set.
     */
    SafetyStudy(const InputFile   &input,
                const std::string &folder,
                const bool         overwrite,
                const MPI_Comm    &communicator,
                Console           &console);

    /** @return an exit code: done if each case has a factor of safety. */
    int
    run();

  private:
    /** One run. */
    struct Trial
    {
      double  factor;
      Summary summary;
      bool    reached_end_time; ///< a path may end elsewhere

      /** There is equilibrium to the end. */
      bool
      stood() const
      {
        return summary.status == "ok" && reached_end_time;
      }

      /** There was until its steps were used up. */
      bool
      undecided() const
      {
        return summary.status == "ok" && !reached_end_time;
      }

      /** There is none, from some step on. Else, if it did not stand, there is
       * no answer: a mistake in the scene, an interruption, or a failure of
       * another kind (linear solver, memory). */
      bool
      failed() const
      {
        return summary.no_equilibrium;
      }
    };

    /** What was found for one case. */
    struct Result
    {
      std::string        label;
      std::string        status = "ok";
      std::string        message;
      std::vector<Trial> trials;
      bool               points_move = false;

      /** The largest factor that it stood, the smallest at which it failed. */
      std::optional<double> stood, failed;

      /** In the middle between both. */
      double
      factor_of_safety() const
      {
        return (*stood + *failed) / 2;
      }

      Json
      to_json() const;
    };

    /** Halve the interval of one case. */
    Result
    search(const StudyCase &study_case);

    /** Run a case with its strength over @p factor, and print a line. */
    Trial
    attempt(const StudyCase &study_case, const double factor);

    void
    print_head(const StudyCase &study_case);

    /** The factor of safety, or why there is none. */
    void
    print(const Result &result, const StudyCase &study_case);

    /** All cases, if there are several. */
    void
    print_table() const;

    void
    write_summary() const;

    const InputFile         &input;
    const std::string        folder;
    const MPI_Comm           communicator;
    Console                 &console;
    std::vector<StudyCase>   cases;
    std::vector<Result>      results;
    std::vector<StudyResult> rows; ///< of study.csv
  };
} // namespace moraine

#endif
