// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/study_parameters.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

namespace moraine
{
  using namespace dealii;

  void
  StudyParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Kind",
      kind,
      "Of 'moraine study'. errors: one run for each case, error against time. "
      "factor of safety: of each case, quasi-static, by strength reduction, see "
      "section 'Strength reduction'. buckling: the three smallest factors of "
      "the stresses at the end of a quasi-static run of small strain at which "
      "the bodies buckle.",
      patterns::selection({"errors", "factor of safety", "buckling"}));
    prm.add_parameter(
      "Error",
      error,
      "Of 'moraine study': the error to plot against time. A name from 'errors' "
      "in summary.json (r_u, l2_u, ...), or a column of history.csv "
      "('u_y at corner', 'reaction_y of footing'), whose last value is compared "
      "with the reference value or, without one, with the next finer case. The "
      "first of the errors if left out.");
    prm.add_parameter("Reference value",
                      reference_value,
                      "Of 'moraine study': what the column should show at the "
                      "end; the error is |value/reference - 1|. Other errors "
                      "are divided by it, if it is given. Each case may have "
                      "its own.",
                      patterns::NumberText());
    prm.add_parameter(
      "Group by",
      group_by,
      "Of 'moraine study': keys with choices, separated by commas, whose values "
      "become curves; 'Series' is one. All but one choice, which makes the "
      "points of a curve: if left out, the last one in section 'Mesh', or else "
      "the last.");
    prm.add_parameter(
      "Panels",
      panels,
      "Of 'moraine study': the curves of each panel of the plot, panels "
      "separated by ';', in each the beginnings of names of curves separated by "
      "'|'. If left out, all curves, at most 8 in a panel.");
    prm.add_parameter("Title", title, "Of 'moraine study': title of the plot.");
  }



  void
  StudyParameters::check(const std::vector<InputFile::Entry> &given) const
  {
    if (kind == "errors")
      return;
    for (const auto &entry : given)
      if (entry.section == "Study" &&
          contains({"Error", "Reference value", "Group by", "Panels"},
                   entry.key))
        reject("Study",
               entry.key,
               entry.value,
               "nothing with 'Kind = " + kind + "'");
  }
} // namespace moraine
