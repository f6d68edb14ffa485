// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/study.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/exit.h>
#include <moraine/core/memory.h>
#include <moraine/core/patterns.h>
#include <moraine/core/ranges.h>
#include <moraine/core/version.h>
#include <moraine/core/words.h>
#include <moraine/output/on_root.h>
#include <moraine/output/output_directory.h>
#include <moraine/scene/located.h>
#include <moraine/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace moraine
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const std::string series_section = "Study/Series";



    template <int dim>
    Summary
    run_scene(const InputFile     &input,
              const MPI_Comm      &communicator,
              const AfterRun<dim> &after_run)
    {
      std::ostringstream unseen;
      Console            quiet(communicator, unseen);
      RunOptions         options;
      options.write_output = false;
      return simulate<dim>(input, options, communicator, quiet, after_run);
    }



    StudyParameters
    parameters_of(const InputFile &input)
    {
      return dimension_of(input) == 2 ? Scene<2>(input).study :
                                        Scene<3>(input).study;
    }



    /** @throw InputError for cases that do not belong in one plot. */
    void
    refuse_other_plots(const std::vector<StudyCase>       &cases,
                       const std::vector<StudyParameters> &parameters)
    {
      const std::vector<std::pair<std::string, std::string StudyParameters::*>>
        keys{{"Error", &StudyParameters::error},
             {"Group by", &StudyParameters::group_by},
             {"Panels", &StudyParameters::panels},
             {"Title", &StudyParameters::title}};
      for (const auto &[key, member] : keys)
        for (std::size_t i = 1; i < cases.size(); ++i)
          if (parameters[i].*member != parameters[0].*member)
            reject("Study",
                   key,
                   parameters[i].*member,
                   "'" + parameters[0].*member + "' in case '" +
                     cases[i].label +
                     "' too, as in the first; all are in one plot, and only "
                     "'Reference value' may differ");
    }



    void
    check_reference(const StudyParameters &parameters)
    {
      const auto reference = number_from(parameters.reference_value);
      if (reference ? *reference == 0. : !parameters.reference_value.empty())
        reject("Study",
               "Reference value",
               parameters.reference_value,
               "a number other than 0");
    }



    /** As written: a setting may change what its constants stand for. */
    std::string
    settings_of(const InputFile &input, const std::string &section)
    {
      for (const auto &entry : input.entries())
        if (entry.section == section && entry.key == "Settings")
          return entry.value;
      return input.require(section, "Settings");
    }



    /** @throw InputError unless all choices but one make curves. */
    void
    check_groups(const std::vector<StudyCase> &cases,
                 const std::string            &group_by)
    {
      if (group_by.empty())
        return;
      const auto keys  = Utilities::split_string_list(group_by, ',');
      auto       paths = choice_paths(cases);
      for (const std::string &key : keys)
        if (none_of(paths,
                    [&](const auto &path) { return names_choice(key, path); }))
          throw InputError(place("Study", "Group by") + ": found '" + key +
                           "', allowed: keys with choices" +
                           suggest(key, paths));
      paths.erase(std::remove_if(paths.begin(),
                                 paths.end(),
                                 [&](const auto &path) {
                                   return any_of(keys, [&](const auto &key) {
                                     return names_choice(key, path);
                                   });
                                 }),
                  paths.end());
      if (paths.size() > 1)
        throw InputError(place("Study", "Group by") + ": found '" + group_by +
                         "', which leaves " + list_of(paths) +
                         " to vary along a curve, allowed: all keys with "
                         "choices but one");
    }
  } // namespace



  Summary
  summary_of_case(const InputFile   &input,
                  const MPI_Comm    &communicator,
                  const AfterRun<2> &after_2d,
                  const AfterRun<3> &after_3d)
  {
    Summary summary;
    try
      {
        summary = dimension_of(input) == 2 ?
                    run_scene<2>(input, communicator, after_2d) :
                    run_scene<3>(input, communicator, after_3d);
      }
    catch (const InputError &error)
      {
        summary.status  = "wrong input";
        summary.message = located(input, error);
        end_if_alone(wrong_input, summary.message);
      }
    catch (const ComputationError &error)
      {
        end_if_alone(not_converged, error.what());
        summary.status  = "not converged";
        summary.message = error.what();
      }
    return summary;
  }



  void
  refuse_inertia(const NamedStages &stages,
                 const std::string &kind,
                 const std::string &why)
  {
    for (const auto &[name, stage] : stages)
      if (stage.time.integrator.dynamic())
        reject("Study",
               "Kind",
               kind,
               (name.empty() ? "" : "stages that are all quasi-static; ") +
                 std::string("'Integrator = quasi-static' in section '") +
                 time_section(name) + "', where it is '" +
                 stage.time.integrator.integrator + "': " + why);
  }



  std::vector<StudyCase>
  study_cases(const InputFile &input)
  {
    const auto names = input.names_in(series_section);
    if (names.empty())
      return expand_study(input);

    InputFile plain = input;
    for (std::size_t e = 0; e < input.entries().size(); ++e)
      if (input.entries()[e].section.rfind(series_section + "/", 0) == 0)
        plain = plain.with_value(e, "");

    std::vector<StudyCase> cases;
    for (const std::string &name : names)
      {
        const std::string section = series_section + "/" + name;
        InputFile         scene   = plain;
        for (const std::string &setting :
             Utilities::split_string_list(settings_of(input, section), ';'))
          try
            {
              if (!setting.empty())
                scene.apply_override(setting);
            }
          catch (const InputError &error)
            {
              throw InputError(place(section, "Settings") + ": " +
                               error.what());
            }
        for (StudyCase &study_case : expand_study(scene))
          {
            study_case.choices.insert(study_case.choices.begin(),
                                      {"Series", name});
            study_case.label =
              name + (study_case.label.empty() ? "" : ", " + study_case.label);
            cases.push_back(std::move(study_case));
          }
      }
    return cases;
  }



  void
  make_study_folder(const StudySetting &setting, const bool has_summary)
  {
    const std::string &folder = setting.folder;
    if (has_summary &&
        OutputDirectory::holds_results(folder, setting.communicator))
      throw InputError("the output directory '" + folder +
                       "' holds results of a run; choose another one with "
                       "--output");
    on_root(setting.communicator, [&]() {
      if (OutputDirectory::holds_study(folder) && !setting.overwrite)
        throw InputError("the output directory '" + folder +
                         "' holds results of an earlier study (study.csv); "
                         "choose another one with --output, or replace them "
                         "with --overwrite");
      std::error_code problem;
      fs::create_directories(folder, problem);
      if (problem)
        throw InputError("cannot make the output directory '" + folder +
                         "': " + problem.message() +
                         "; choose another one with --output");
      if (OutputDirectory::holds_study(folder))
        OutputDirectory::remove_study(folder);
      AtomicFile original(setting.file("study.prm"));
      original.stream() << setting.input.text();
      original.commit();
    });
  }



  void
  write_study_summary(const StudySetting      &setting,
                      const std::vector<Json> &cases)
  {
    const Json json{{"version", version},
                    {"ranks",
                     Utilities::MPI::n_mpi_processes(setting.communicator)},
                    {"cases", cases}};
    on_root(setting.communicator,
            [&]() { save(json, setting.file("summary.json")); });
  }



  int
  exit_code_of(const std::vector<std::string> &statuses)
  {
    return contains(statuses, "wrong input") ? wrong_input :
           std::count(statuses.begin(), statuses.end(), "ok") ==
               static_cast<std::ptrdiff_t>(statuses.size()) ?
                                               done :
                                               not_converged;
  }



  namespace
  {
    /** In seconds: where the clock and the system disturb a measured time. */
    constexpr double short_time = 0.1;



    /** Set the error of a result, or the value that is to be compared.
     * @throw InputError if the scene does not have what is @p asked for */
    void
    measure(const StudyParameters &asked, StudyResult &result)
    {
      const auto               reference = number_from(asked.reference_value);
      std::vector<std::string> known;
      for (const auto &[name, value] : result.summary.errors)
        {
          if (name == asked.error || asked.error.empty())
            {
              result.error =
                value && reference ? *value / std::abs(*reference) : value;
              return;
            }
          known.push_back(name);
        }
      if (asked.error.empty())
        return;
      const std::string column = column_of_error(asked.error);
      for (const auto &[name, value] : result.summary.last.history)
        {
          if (name == column)
            {
              result.value = value;
              if (reference)
                result.error = std::abs(value / *reference - 1);
              return;
            }
          known.push_back(name);
        }
      throw InputError(place("Study", "Error") + ": found '" + asked.error +
                       "', which this scene does not have" +
                       suggest(column, known));
    }



    StudyResult
    run_case(const StudyCase       &study_case,
             const StudyParameters &parameters,
             const MPI_Comm        &communicator)
    {
      reset_peak_memory();
      StudyResult result{study_case,
                         summary_of_case(study_case.input, communicator),
                         {},
                         {}};
      if (result.summary.status == "ok")
        measure(parameters, result);
      return result;
    }



    /** Wall time of the slowest rank. Collective. */
    double
    longest_time(const StudyResult &result, const MPI_Comm &communicator)
    {
      return Utilities::MPI::max(result.summary.wall_seconds, communicator);
    }



    /** The run with the median time of as many as its time asks for. */
    StudyResult
    measured_case(const StudyCase       &study_case,
                  const StudyParameters &parameters,
                  const MPI_Comm        &communicator)
    {
      constexpr unsigned int   n_runs = 5;
      std::vector<StudyResult> runs;
      do
        runs.push_back(run_case(study_case, parameters, communicator));
      while (runs.size() < n_runs && runs.back().summary.status == "ok" &&
             longest_time(runs.front(), communicator) < short_time);
      // All ranks take the same run: that with the median time of rank 0.
      std::vector<std::pair<double, unsigned int>> times;
      for (unsigned int r = 0; r < runs.size(); ++r)
        times.emplace_back(
          Utilities::MPI::broadcast(communicator, runs[r].summary.wall_seconds),
          r);
      std::sort(times.begin(), times.end());
      return runs[times[times.size() / 2].second];
    }



    std::string
    line_of(const std::size_t      i,
            const StudyResult     &result,
            const StudyParameters &parameters)
    {
      const Summary &summary = result.summary;
      std::string    line    = fmt::format("  case {:4}  {}: {:.3g} s",
                                     i + 1,
                                     result.study_case.label,
                                     summary.wall_seconds);
      if (result.value)
        line += fmt::format(", {} = {:.6g}",
                            column_of_error(parameters.error),
                            *result.value);
      if (result.error)
        line += fmt::format(", error {:.3g}", *result.error);
      if (summary.status != "ok")
        line += ", " + summary.status + ": " + summary.message;
      return line;
    }



    /** What is said of the plot of all cases. */
    StudyParameters
    common_parameters(const std::vector<StudyParameters> &of_cases)
    {
      StudyParameters common = of_cases[0];
      for (const StudyParameters &other : of_cases)
        if (other.reference_value != of_cases[0].reference_value)
          common.reference_value = "reference value";
      return common;
    }
  } // namespace



  int
  run_study(const StudySetting &setting)
  {
    const std::vector<StudyCase> cases = study_cases(setting.input);
    std::vector<StudyParameters> parameters;
    for (const StudyCase &study_case : cases)
      parameters.push_back(parameters_of(study_case.input));
    refuse_other_plots(cases, parameters);
    check_groups(cases, parameters[0].group_by);
    for (const StudyParameters &of_case : parameters)
      check_reference(of_case);
    make_study_folder(setting, false);

    const MPI_Comm communicator = setting.communicator;
    Console       &console      = setting.console;
    console << "Moraine " << version << ", study of " << cases.size()
            << " cases\n"
            << (parameters[0].title.empty() ? "" : parameters[0].title + "\n")
            << std::flush;
    std::vector<StudyResult> results;
    std::vector<std::string> statuses;
    for (std::size_t i = 0; i < cases.size(); ++i)
      {
        console.progress(fmt::format(
          "  case {} of {}: {}", i + 1, cases.size(), cases[i].label));
        const auto run_it = [&]() {
          return measured_case(cases[i], parameters[i], communicator);
        };
        results.push_back(run_it());
        // The first run of a process also loads libraries.
        if (i == 0 && longest_time(results[0], communicator) < 10)
          results[0] = run_it();
        console << line_of(i, results.back(), parameters[i]) << std::endl;
        if (parameters[i].reference_value.empty())
          compare_neighbours(cases, results);
        write_csv(setting, results);
        statuses.push_back(results.back().summary.status);
        if (statuses.back() == "interrupted")
          break;
      }
    print_table(setting, cases, results);
    on_root(communicator, [&]() {
      plot(setting, common_parameters(parameters), cases, results);
    });
    return exit_code_of(statuses);
  }
} // namespace moraine
