// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/safety_study.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/ranges.h>
#include <moraine/core/version.h>
#include <moraine/core/words.h>
#include <moraine/scene/scene.h>
#include <moraine/scene/strength_reduction.h>

#include <deal.II/base/table_handler.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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
        return SceneOfSafety{scene.output.title,
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
      return fmt::format("{:.17g}", factor);
    }



    std::string
    rounded(const double factor)
    {
      return fmt::format("{:.4f}", factor);
    }



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
      std::string        status = "ok";
      std::string        message;
      std::vector<Trial> trials;

      /** The largest factor that it stood, the smallest at which it failed. */
      std::optional<double> stood, failed;

      /** In the middle between both. */
      double
      factor_of_safety() const
      {
        return (*stood + *failed) / 2;
      }
    };



    Json
    to_json(const Trial &trial)
    {
      const Summary &summary = trial.summary;
      Json           json{{"factor", trial.factor}, {"status", summary.status}};
      if (!summary.message.empty())
        json["message"] = summary.message;
      json["time"]              = summary.time;
      json["steps"]             = summary.steps;
      json["rejected_steps"]    = summary.rejected_steps;
      json["newton_iterations"] = summary.newton_iterations;
      json["wall_seconds"]      = summary.wall_seconds;
      json["unknowns"]          = summary.sizes.unknowns;
      json["probes"]            = Json::object();
      for (const auto &[name, value] : summary.last.probes)
        json["probes"][name] = value;
      return json;
    }



    Json
    to_json(const Result &result, const std::string &label)
    {
      Json json;
      if (!label.empty())
        json["case"] = label;
      json["status"] = result.status;
      if (!result.message.empty())
        json["message"] = result.message;
      if (result.status == "ok")
        json["factor_of_safety"] = result.factor_of_safety();
      if (result.stood)
        json["stood_at"] = *result.stood;
      if (result.failed)
        json["failed_at"] = *result.failed;
      json["trials"] = Json::array();
      for (const Trial &trial : result.trials)
        json["trials"].push_back(to_json(trial));
      return json;
    }



    /** Run a case with its strength over @p factor, add a row to study.csv and
     * print a line. */
    Trial
    attempt(const StudySetting       &setting,
            const StudyCase          &study_case,
            const double              factor,
            std::vector<StudyResult> &rows)
    {
      setting.console.progress("  F = " + rounded(factor));
      StudyCase with_factor = study_case;
      with_factor.choices.emplace_back(factor_path, exactly(factor));
      with_factor.input.apply_override(factor_path + " = " + exactly(factor));
      const Summary summary =
        summary_of_case(with_factor.input, setting.communicator);
      rows.push_back({with_factor, summary, {}, {}});
      write_csv(setting, rows);

      const SceneOfSafety scene   = read_scene(with_factor.input);
      const double      round_off = 1e-10 * (scene.end_time - scene.start_time);
      const Trial       trial{factor,
                        summary,
                        summary.time >= scene.end_time - round_off};
      const std::string result =
        trial.stood()     ? "stood" :
        trial.failed()    ? fmt::format("failed at t = {:.5g}", summary.time) :
        trial.undecided() ? "undecided" :
                            summary.status;
      setting.console << fmt::format("{:8.4f}  {:20}{:7}{:10}{:8}{:9.3g}\n",
                                     factor,
                                     result,
                                     summary.steps,
                                     summary.rejected_steps,
                                     summary.newton_iterations,
                                     summary.wall_seconds)
                      << std::flush;
      return trial;
    }



    /** Halve the interval of one case. */
    Result
    search(const StudySetting       &setting,
           const StudyCase          &study_case,
           std::vector<StudyResult> &rows)
    {
      const SceneOfSafety                scene = read_scene(study_case.input);
      const StrengthReductionParameters &parameters = scene.parameters;
      Result                             result;
      const auto                         end_as = [&](const std::string &status,
                              const std::string &message) {
        result.status  = status;
        result.message = message;
        return result;
      };
      for (double factor = parameters.lower_factor;;)
        {
          result.trials.push_back(attempt(setting, study_case, factor, rows));
          const Trial   &trial   = result.trials.back();
          const Summary &summary = trial.summary;
          if (trial.stood())
            result.stood = factor;
          else if (trial.failed())
            result.failed = factor;
          else if (trial.undecided())
            return end_as(
              "undecided",
              fmt::format("with F = {:.6g} the path ended at t = {:.6g}, 'End "
                          "time' is {:.6g}; more 'Steps' tell whether the "
                          "scene stands, or no 'Arc length', without which "
                          "there is no equilibrium where it fails",
                          factor,
                          summary.time,
                          scene.end_time));
          else
            return end_as(summary.status, summary.message);

          if (!result.stood)
            return end_as("fails at lower factor",
                          fmt::format("'Lower factor' = {:.6g} is too large, "
                                      "the scene fails at it: {}",
                                      factor,
                                      summary.message));
          if (!result.failed && factor == parameters.upper_factor)
            return end_as("stands at upper factor",
                          fmt::format("'Upper factor' = {:.6g} is too small, "
                                      "the scene stands at it",
                                      factor));
          if (result.failed &&
              *result.failed - *result.stood <= parameters.tolerance)
            return result;
          factor =
            result.failed ? result.factor_of_safety() : parameters.upper_factor;
          if (factor == result.stood || factor == result.failed)
            return result; // no number between them
        }
    }



    std::string
    head_of(const StudyCase &study_case)
    {
      const SceneOfSafety                scene = read_scene(study_case.input);
      const StrengthReductionParameters &parameters = scene.parameters;
      const std::string                  from       = parameters.stage.empty() ?
                                                        "" :
                                                        " from stage '" + parameters.stage + "' on" +
                                   (parameters.excess_pressure == "frozen" ?
                                                             ", excess pressures frozen" :
                                                             "");
      return (scene.title.empty() ? "" : scene.title + "\n") +
             (study_case.label.empty() ? "" : "  " + study_case.label + "\n") +
             fmt::format("  shear strength of {} over F{}; F from {:.6g} to "
                         "{:.6g}, to within {:.6g}\n",
                         parameters.materials.empty() ?
                           "all materials" :
                           list_of(parameters.materials),
                         from,
                         parameters.lower_factor,
                         parameters.upper_factor,
                         parameters.tolerance) +
             (scene.points_move ?
                "  note: points move with the soil, and soil that failed may "
                "come to rest in another\n        shape and count as "
                "standing; 'Mesh after step = keep' finds where it begins\n" :
                "  points stay where they are ('Mesh after step = keep')\n") +
             "\n       F  result                steps  rejected  Newton  "
             "seconds\n";
    }



    /** The command that shows how a case failed. */
    std::string
    command_of(const StudySetting &setting,
               const StudyCase    &study_case,
               const double        failed)
    {
      std::string command = "moraine run " + one_word(setting.input.name());
      const auto  add     = [&command](const std::string &text) {
        command += " --set " + one_word(text);
      };
      // What a series sets is among the overrides.
      for (const std::string &text : study_case.input.overrides())
        add(text);
      for (const auto &[path, value] : study_case.choices)
        if (path != "Series")
          add(path + " = " + value);
      add(factor_path + " = " + exactly(failed));
      return command + " --output " + one_word(setting.folder + "/failed");
    }



    /** The factor of safety, or why there is none. */
    std::string
    conclusion(const StudySetting &setting,
               const StudyCase    &study_case,
               const Result       &result)
    {
      if (result.status != "ok")
        return "\n  no factor of safety: " + result.message + "\n\n";
      const bool compares_meshes =
        any_of(study_case.choices, [](const auto &choice) {
          return choice.first.rfind("Mesh/", 0) == 0;
        });
      const auto failure = std::find_if(result.trials.begin(),
                                        result.trials.end(),
                                        [&](const Trial &trial) {
                                          return trial.factor == *result.failed;
                                        });
      return fmt::format("\n  factor of safety {:.4f}: it stood at {:.4f} and "
                         "failed at {:.4f}\n  how it failed: {}\n"
                         "  to see it: {}\n{}\n",
                         result.factor_of_safety(),
                         *result.stood,
                         *result.failed,
                         failure->summary.message,
                         command_of(setting, study_case, *result.failed),
                         compares_meshes ?
                           "" :
                           "  note: cells bear more than the ground, the "
                           "coarser the more; repeat with\n        half the "
                           "cell size to see how much\n");
    }



    /** All cases, if there are several. */
    std::string
    table_of(const std::vector<StudyCase> &cases,
             const std::vector<Result>    &results)
    {
      const auto   paths = choice_paths(cases);
      const auto   names = short_names(paths);
      TableHandler table;
      for (std::size_t i = 0; i < results.size(); ++i)
        {
          const Result &result  = results[i];
          const auto    or_dash = [](const std::optional<double> &factor) {
            return factor ? rounded(*factor) : "-";
          };
          double seconds = 0;
          for (const Trial &trial : result.trials)
            seconds += trial.summary.wall_seconds;
          for (std::size_t p = 0; p < paths.size(); ++p)
            table.add_value(names[p], value_of(cases[i], paths[p]));
          table.add_value("factor of safety",
                          result.status == "ok" ?
                            rounded(result.factor_of_safety()) :
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
      return text.str() + "\n";
    }
  } // namespace



  int
  find_factor_of_safety(const StudySetting &setting)
  {
    std::vector<StudyCase> cases = study_cases(setting.input);
    // Soil that has slid into another shape would stand in it.
    for (StudyCase &study_case : cases)
      if (read_scene(study_case.input).may_stay)
        study_case.input.apply_override(stay);
    make_study_folder(setting, true);

    Console &console = setting.console;
    console << "Moraine " << version
            << ", factor of safety by strength reduction\n";
    std::vector<StudyResult> rows;
    std::vector<Result>      results;
    std::vector<Json>        json;
    for (const StudyCase &study_case : cases)
      {
        console << head_of(study_case) << std::flush;
        results.push_back(search(setting, study_case, rows));
        const Result &result = results.back();
        console << conclusion(setting, study_case, result) << std::flush;
        json.push_back(to_json(result, study_case.label));
        write_study_summary(setting, json);
        if (result.status == "interrupted")
          break;
      }
    if (results.size() > 1)
      console << table_of(cases, results);
    console << "  results in " << setting.file("summary.json") << std::endl;
    std::vector<std::string> statuses;
    for (const Result &result : results)
      statuses.push_back(result.status);
    return exit_code_of(statuses);
  }
} // namespace moraine
