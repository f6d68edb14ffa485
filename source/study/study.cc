// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/study.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/exit.h>
#include <moraine/core/memory.h>
#include <moraine/core/patterns.h>
#include <moraine/core/version.h>
#include <moraine/core/words.h>
#include <moraine/output/on_root.h>
#include <moraine/output/output_directory.h>
#include <moraine/scene/located.h>
#include <moraine/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
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
        if (std::none_of(paths.begin(), paths.end(), [&](const auto &path) {
              return names_choice(key, path);
            }))
          throw InputError(place("Study", "Group by") + ": found '" + key +
                           "', allowed: keys with choices" +
                           suggest(key, paths));
      paths.erase(std::remove_if(paths.begin(),
                                 paths.end(),
                                 [&](const auto &path) {
                                   return std::any_of(keys.begin(),
                                                      keys.end(),
                                                      [&](const auto &key) {
                                                        return names_choice(
                                                          key, path);
                                                      });
                                 }),
                  paths.end());
      if (paths.size() > 1)
        throw InputError(place("Study", "Group by") + ": found '" + group_by +
                         "', which leaves " + list_of(paths) +
                         " to vary along a curve, allowed: all keys with "
                         "choices but one");
    }



    /** In seconds: where the clock and the system disturb a measured time. */
    constexpr double short_time = 0.1;
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
  refuse_results_of_run(const std::string &folder, const MPI_Comm &communicator)
  {
    if (OutputDirectory::holds_results(folder, communicator))
      throw InputError("the output directory '" + folder +
                       "' holds results of a run; choose another one with "
                       "--output");
  }



  void
  make_study_folder(const std::string &folder,
                    const InputFile   &input,
                    const bool         overwrite,
                    const MPI_Comm    &communicator)
  {
    on_root(communicator, [&]() {
      if (OutputDirectory::holds_study(folder) && !overwrite)
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
      AtomicFile original((fs::path(folder) / "study.prm").string());
      original.stream() << input.text();
      original.commit();
    });
  }



  Study::Study(const InputFile   &input,
               const std::string &folder,
               const bool         overwrite,
               const MPI_Comm    &communicator,
               Console           &console)
    : folder(folder)
    , communicator(communicator)
    , console(console)
    , cases(study_cases(input))
  {
    for (const StudyCase &study_case : cases)
      parameters.push_back(parameters_of(study_case.input));
    refuse_other_plots(cases, parameters);
    check_groups(cases, parameters[0].group_by);
    for (const StudyParameters &of_case : parameters)
      check_reference(of_case);

    make_study_folder(folder, input, overwrite, communicator);
  }



  int
  Study::run()
  {
    console << "Moraine " << version << ", study of " << cases.size()
            << " cases\n"
            << (parameters[0].title.empty() ? "" : parameters[0].title + "\n")
            << std::flush;
    bool converged = true, input_is_right = true;
    for (std::size_t i = 0; i < cases.size(); ++i)
      {
        console.progress("  case " + std::to_string(i + 1) + " of " +
                         std::to_string(cases.size()) + ": " + cases[i].label);
        results.push_back(measured_case(i));
        // The first run of a process also loads libraries.
        if (i == 0 && longest_time(results[0]) < 10)
          results[0] = measured_case(i);
        const Summary &summary = results.back().summary;
        console << "  case " << std::setw(4) << i + 1 << "  " << cases[i].label
                << ": " << text_of(summary.wall_seconds, 3) << " s";
        if (results.back().value)
          console << ", " << column_of_error(parameters[i].error) << " = "
                  << text_of(*results.back().value, 6);
        if (results.back().error)
          console << ", error " << text_of(*results.back().error, 3);
        if (summary.status != "ok")
          console << ", " << summary.status << ": " << summary.message;
        console.stream() << std::endl;
        if (parameters[i].reference_value.empty())
          compare_neighbours(cases, results);
        on_root(communicator, [this]() { report().write_csv(); });
        converged      = converged && summary.status == "ok";
        input_is_right = input_is_right && summary.status != "wrong input";
        if (summary.status == "interrupted")
          break;
      }
    report().print_table(console);
    on_root(communicator, [this]() { report().plot(console); });
    return !input_is_right ? wrong_input : converged ? done : not_converged;
  }



  double
  Study::longest_time(const StudyResult &result) const
  {
    return Utilities::MPI::max(result.summary.wall_seconds, communicator);
  }



  StudyResult
  Study::measured_case(const std::size_t i)
  {
    constexpr unsigned int   n_runs = 5;
    std::vector<StudyResult> runs{run_case(i)};
    while (runs.size() < n_runs && runs.back().summary.status == "ok" &&
           longest_time(runs.front()) < short_time)
      runs.push_back(run_case(i));
    // All ranks take the same run: that with the median time of rank 0.
    std::vector<std::pair<double, unsigned int>> times;
    for (unsigned int r = 0; r < runs.size(); ++r)
      times.emplace_back(
        Utilities::MPI::broadcast(communicator, runs[r].summary.wall_seconds),
        r);
    std::sort(times.begin(), times.end());
    return runs[times[times.size() / 2].second];
  }



  StudyResult
  Study::run_case(const std::size_t i)
  {
    reset_peak_memory();
    StudyResult result{
      cases[i], summary_of_case(cases[i].input, communicator), {}, {}};
    if (result.summary.status == "ok")
      measure(parameters[i], result);
    return result;
  }



  void
  Study::measure(const StudyParameters &asked, StudyResult &result) const
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



  StudyReport
  Study::report() const
  {
    const StudyParameters &plot = parameters[0];
    const bool             is_common =
      std::all_of(parameters.begin(),
                  parameters.end(),
                  [&](const StudyParameters &other) {
                    return other.reference_value == plot.reference_value;
                  });
    return {folder,
            plot.title,
            plot.error,
            is_common ? plot.reference_value : "reference value",
            plot.group_by,
            plot.panels,
            cases,
            results};
  }
} // namespace moraine
