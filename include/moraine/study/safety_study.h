// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_safety_study_h
#define moraine_study_safety_study_h

#include <moraine/study/study.h>

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
   *
   * @return an exit code: done if each case has a factor of safety.
   * @throw InputError for a mistake in the text of any case, for bodies with
   * inertia, or if the folder holds results that may not be replaced.
   */
  int
  find_factor_of_safety(const StudySetting &setting);
} // namespace moraine

#endif
