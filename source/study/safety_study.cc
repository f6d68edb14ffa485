// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/safety_study.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/exit.h>
#include <moraine/core/version.h>
#include <moraine/core/words.h>
#include <moraine/output/on_root.h>
#include <moraine/scene/scene.h>
#include <moraine/scene/strength_reduction.h>
#include <moraine/study/study.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/table_handler.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string factor_path = "Strength reduction/Factor";
    const std::string stay        = "Method/Mesh after step = keep";



    /** What a study needs to know of a scene. */
    struct SceneOfSafety
    {
      std::string                 title;
      StrengthReductionParameters parameters;
      double                      start_time, end_time;
      bool                        points_move;
      bool                        may_stay; ///< points, as nothing is said
    };



    SceneOfSafety
    read_scene(const InputFile &input)
    {
      const auto of = [](const auto &scene) {
        refuse_inertia(scene.stages,
                       "factor of safety",
                       "bodies with inertia never lack equilibrium, they move, "
                       "and would count as standing at every factor");
        return SceneOfSafety{scene.title,
                             scene.strength_reduction,
                             scene.start_time(),
                             scene.end_time(),
                             scene.method.after_step() != MeshAfterStep::keep,
                             scene.method.mesh_after_step == "default" &&
                               scene.method.strain_measure() ==
                                 StrainMeasure::small};
      };
      return dimension_of(input) == 2 ? of(Scene<2>(input)) :
                                        of(Scene<3>(input));
    }



    /** With enough digits to read the same number. */
    std::string
    exactly(const double factor)
    {
      std::ostringstream text;
      text << std::setprecision(17) << factor;
      return text.str();
    }



    std::string
    fixed(const double value, const unsigned int digits)
    {
      std::ostringstream text;
      text << std::fixed << std::setprecision(digits) << value;
      return text.str();
    }
  } // namespace



  Json
  SafetyStudy::Result::to_json() const
  {
    Json json;
    if (!label.empty())
      json["case"] = label;
    json["status"] = status;
    if (!message.empty())
      json["message"] = message;
    if (status == "ok")
      json["factor_of_safety"] = factor_of_safety();
    if (stood)
      json["stood_at"] = *stood;
    if (failed)
      json["failed_at"] = *failed;
    json["trials"] = Json::array();
    for (const Trial &trial : trials)
      {
        const Summary &summary = trial.summary;
        Json           row;
        row["factor"] = trial.factor;
        row["status"] = summary.status;
        if (!summary.message.empty())
          row["message"] = summary.message;
        row["time"]              = summary.time;
        row["steps"]             = summary.steps;
        row["rejected_steps"]    = summary.rejected_steps;
        row["newton_iterations"] = summary.newton_iterations;
        row["wall_seconds"]      = summary.wall_seconds;
        row["unknowns"]          = summary.sizes.unknowns;
        row["probes"]            = Json::object();
        for (const auto &[name, value] : summary.last.probes)
          row["probes"][name] = value;
        json["trials"].push_back(row);
      }
    return json;
  }



  SafetyStudy::SafetyStudy(const InputFile   &input,
                           const std::string &folder,
                           const bool         overwrite,
                           const MPI_Comm    &communicator,
                           Console           &console)
    : input(input)
    , folder(folder)
    , communicator(communicator)
    , console(console)
    , cases(study_cases(input))
  {
    // Soil that has slid into another shape would stand in it.
    for (StudyCase &study_case : cases)
      if (read_scene(study_case.input).may_stay)
        study_case.input.apply_override(stay);
    refuse_results_of_run(folder, communicator);
    make_study_folder(folder, input, overwrite, communicator);
  }



  int
  SafetyStudy::run()
  {
    console << "Moraine " << version
            << ", factor of safety by strength reduction\n";
    bool found = true, input_is_right = true;
    for (const StudyCase &study_case : cases)
      {
        print_head(study_case);
        results.push_back(search(study_case));
        const Result &result = results.back();
        print(result, study_case);
        write_summary();
        found          = found && result.status == "ok";
        input_is_right = input_is_right && result.status != "wrong input";
        if (result.status == "interrupted")
          break;
      }
    if (results.size() > 1)
      print_table();
    console << "  results in " << folder << "/summary.json" << std::endl;
    return !input_is_right ? wrong_input : found ? done : not_converged;
  }



  SafetyStudy::Result
  SafetyStudy::search(const StudyCase &study_case)
  {
    const SceneOfSafety                scene = read_scene(study_case.input);
    const StrengthReductionParameters &parameters = scene.parameters;
    Result                             result;
    result.label       = study_case.label;
    result.points_move = scene.points_move;
    const auto end_as  = [&](const std::string &status,
                            const std::string &message) {
      result.status  = status;
      result.message = message;
      return result;
    };
    for (double factor = parameters.lower_factor;;)
      {
        result.trials.push_back(attempt(study_case, factor));
        const Trial &trial = result.trials.back();
        if (trial.stood())
          result.stood = factor;
        else if (trial.failed())
          result.failed = factor;
        else if (trial.undecided())
          return end_as("undecided",
                        "with F = " + text_of(factor, 6) +
                          " the path ended at t = " +
                          text_of(trial.summary.time, 6) + ", 'End time' is " +
                          text_of(scene.end_time, 6) +
                          "; more 'Steps' tell whether the scene stands, or "
                          "no 'Arc length', without which there is no "
                          "equilibrium where it fails");
        else
          return end_as(trial.summary.status, trial.summary.message);

        if (!result.stood)
          return end_as("fails at lower factor",
                        "'Lower factor' = " + text_of(factor, 6) +
                          " is too large, the scene fails at it: " +
                          trial.summary.message);
        if (!result.failed && factor == parameters.upper_factor)
          return end_as("stands at upper factor",
                        "'Upper factor' = " + text_of(factor, 6) +
                          " is too small, the scene stands at it");
        if (result.failed &&
            *result.failed - *result.stood <= parameters.tolerance)
          return result;
        factor =
          result.failed ? result.factor_of_safety() : parameters.upper_factor;
        if (factor == result.stood || factor == result.failed)
          return result; // no number between them
      }
  }



  SafetyStudy::Trial
  SafetyStudy::attempt(const StudyCase &study_case, const double factor)
  {
    console.progress("  F = " + fixed(factor, 4));
    StudyCase with_factor = study_case;
    with_factor.choices.emplace_back(factor_path, exactly(factor));
    with_factor.input.apply_override(factor_path + " = " + exactly(factor));
    const Summary summary = summary_of_case(with_factor.input, communicator);
    rows.push_back({with_factor, summary, {}, {}});
    on_root(communicator, [&]() {
      StudyReport{folder, "", "", "", "", "", cases, rows}.write_csv();
    });

    const SceneOfSafety scene = read_scene(with_factor.input);
    const Trial         trial{factor,
                      summary,
                      summary.time >=
                        scene.end_time -
                          1e-10 * (scene.end_time - scene.start_time)};
    console << std::setw(8) << fixed(factor, 4) << "  " << std::left
            << std::setw(20)
            << (trial.stood()  ? "stood" :
                trial.failed() ? "failed at t = " + text_of(summary.time, 5) :
                trial.undecided() ? "undecided" :
                                    summary.status)
            << std::right << std::setw(7) << summary.steps << std::setw(10)
            << summary.rejected_steps << std::setw(8)
            << summary.newton_iterations << std::setw(9)
            << text_of(summary.wall_seconds, 3) << '\n';
    console.stream() << std::flush;
    return trial;
  }



  void
  SafetyStudy::print_head(const StudyCase &study_case)
  {
    const SceneOfSafety                scene = read_scene(study_case.input);
    const StrengthReductionParameters &parameters = scene.parameters;
    console << (scene.title.empty() ? "" : scene.title + "\n")
            << (study_case.label.empty() ? "" : "  " + study_case.label + "\n")
            << "  shear strength of "
            << (parameters.materials.empty() ? "all materials" :
                                               list_of(parameters.materials))
            << " over F; F from " << parameters.lower_factor << " to "
            << parameters.upper_factor << ", to within " << parameters.tolerance
            << '\n'
            << (scene.points_move ?
                  "  note: points move with the soil, and soil that failed may "
                  "come to rest in another\n        shape and count as "
                  "standing; 'Mesh after step = keep' finds where it begins\n" :
                  "  points stay where they are ('Mesh after step = keep')\n")
            << '\n'
            << "       F  result                steps  rejected  Newton  "
               "seconds\n";
    console.stream() << std::flush;
  }



  void
  SafetyStudy::print(const Result &result, const StudyCase &study_case)
  {
    const bool compares_meshes =
      std::any_of(study_case.choices.begin(),
                  study_case.choices.end(),
                  [](const auto &choice) {
                    return choice.first.rfind("Mesh/", 0) == 0;
                  });
    if (result.status != "ok")
      console << "\n  no factor of safety: " << result.message << "\n\n";
    else
      {
        const auto failure =
          std::find_if(result.trials.begin(),
                       result.trials.end(),
                       [&](const Trial &trial) {
                         return trial.factor == *result.failed;
                       });
        console << "\n  factor of safety "
                << fixed(result.factor_of_safety(), 4) << ": it stood at "
                << fixed(*result.stood, 4) << " and failed at "
                << fixed(*result.failed, 4)
                << "\n  how it failed: " << failure->summary.message
                << "\n  to see it: moraine run " << one_word(input.name());
        // What a series sets is among the overrides.
        for (const std::string &setting : study_case.input.overrides())
          console << " --set " << one_word(setting);
        for (const auto &[path, value] : study_case.choices)
          if (path != "Series")
            console << " --set " << one_word(path + " = " + value);
        console << " --set "
                << one_word(factor_path + " = " + exactly(*result.failed))
                << " --output " << one_word(folder + "/failed") << '\n'
                << (compares_meshes ?
                      "" :
                      "  note: cells bear more than the ground, the coarser "
                      "the more; repeat with\n        half the cell size to "
                      "see how much\n")
                << '\n';
      }
    console.stream() << std::flush;
  }



  void
  SafetyStudy::print_table() const
  {
    const auto   paths = choice_paths(cases);
    const auto   names = short_names(paths);
    TableHandler table;
    for (std::size_t i = 0; i < results.size(); ++i)
      {
        const Result &result    = results[i];
        const auto    or_dash   = [](const std::optional<double> &factor) {
          return factor ? fixed(*factor, 4) : std::string("-");
        };
        double seconds = 0;
        for (const Trial &trial : result.trials)
          seconds += trial.summary.wall_seconds;
        for (std::size_t p = 0; p < paths.size(); ++p)
          table.add_value(names[p], value_of(cases[i], paths[p]));
        table.add_value("factor of safety",
                        result.status == "ok" ?
                          fixed(result.factor_of_safety(), 4) :
                          "-");
        table.add_value("stood at", or_dash(result.stood));
        table.add_value("failed at", or_dash(result.failed));
        table.add_value("trials", std::to_string(result.trials.size()));
        table.add_value("unknowns",
                        std::to_string(
                          result.trials.back().summary.sizes.unknowns));
        table.add_value("seconds", text_of(seconds, 3));
        table.add_value("status", result.status);
      }
    std::ostringstream text;
    table.write_text(text, TableHandler::org_mode_table);
    console << text.str() << '\n';
  }



  void
  SafetyStudy::write_summary() const
  {
    Json json;
    json["version"] = version;
    json["ranks"]   = Utilities::MPI::n_mpi_processes(communicator);
    json["cases"]   = Json::array();
    for (const Result &result : results)
      json["cases"].push_back(result.to_json());
    on_root(communicator, [&]() { json.save(folder + "/summary.json"); });
  }
} // namespace moraine
