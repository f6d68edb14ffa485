// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/study.h>

#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/memory.h>
#include <moraine/core/nearest.h>
#include <moraine/core/version.h>
#include <moraine/output/on_root.h>
#include <moraine/run/command_line.h>
#include <moraine/run/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/table_handler.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;
  namespace fs = std::filesystem;

  void
  StudyParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Error",
      error,
      "Of 'moraine study': the error to plot against time. A name from 'errors' "
      "in summary.json (r_u, l2_u, ...), or 'probe' and a column of a probe "
      "('probe u_y at corner'), measured against the reference value. The "
      "first of the errors if left out.");
    prm.add_parameter("Reference value",
                      reference_value,
                      "Of 'moraine study': what the probe should show; the "
                      "error is |value/reference - 1|.");
    prm.add_parameter(
      "Group by",
      group_by,
      "Of 'moraine study': keys with choices, separated by commas, whose values "
      "become curves; 'Series' is one. All but the last choice if left out.");
    prm.add_parameter("Title", title, "Of 'moraine study': title of the plot.");
  }



  namespace
  {
    const std::string series_section = "Study/Series";



    /** Whether @p key, as written by the user, means the choice @p path. */
    bool
    names_choice(const std::string &key, const std::string &path)
    {
      return key == path || (path.size() > key.size() &&
                             path.compare(path.size() - key.size() - 1,
                                          std::string::npos,
                                          "/" + key) == 0);
    }



    std::string
    value_of(const StudyCase &study_case, const std::string &key)
    {
      for (const auto &[path, value] : study_case.choices)
        if (names_choice(key, path))
          return value;
      return "";
    }



    /** Columns in the order in which the cases bring them. */
    void
    add_columns(std::vector<std::string>       &columns,
                const std::vector<std::string> &more)
    {
      for (const std::string &name : more)
        if (std::find(columns.begin(), columns.end(), name) == columns.end())
          columns.push_back(name);
    }



    std::vector<std::string>
    choice_paths(const std::vector<StudyCase> &cases)
    {
      std::vector<std::string> paths;
      for (const StudyCase &study_case : cases)
        for (const auto &choice : study_case.choices)
          add_columns(paths, {choice.first});
      return paths;
    }



    std::string
    text_of(const double value, const unsigned int digits)
    {
      std::ostringstream text;
      text << std::setprecision(digits) << value;
      return text.str();
    }



    std::string
    csv_cell(const std::string &text)
    {
      if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
      std::string cell = "\"";
      for (const char c : text)
        cell += c == '"' ? std::string("\"\"") : std::string(1, c);
      return cell + "\"";
    }



    /** Everything a row has, by column. */
    std::vector<std::pair<std::string, std::string>>
    cells_of(const StudyResult &result)
    {
      const Summary &summary = result.summary;
      auto           cells   = result.study_case.choices;
      const auto     number  = [&cells](const std::string &name,
                                   const double       value) {
        cells.emplace_back(name, text_of(value, 10));
      };
      cells.emplace_back("status", summary.status);
      cells.emplace_back("message", summary.message);
      if (summary.version.empty())
        return cells;
      if (result.error)
        number("error", *result.error);
      for (const auto &[name, value] : summary.errors)
        if (value)
          number(name, *value);
      for (const auto &[name, value] : summary.probes)
        number(name, value);
      number("wall_seconds", summary.wall_seconds);
      for (const auto &[name, seconds] : summary.timings)
        number("seconds in " + name, seconds);
      number("cells", summary.cells);
      number("active_cells", summary.active_cells);
      number("unknowns", summary.unknowns);
      number("points", summary.points);
      number("steps", summary.steps);
      number("rejected_steps", summary.rejected_steps);
      number("newton_iterations", summary.newton_iterations);
      number("linear_iterations", summary.linear_iterations);
      if (summary.condition_number)
        number("condition_number", *summary.condition_number);
      number("bytes_per_point", summary.bytes_per_point);
      number("peak_memory_mib", summary.peak_memory_mib);
      number("ranks", summary.ranks);
      cells.emplace_back("version", summary.version);
      return cells;
    }



    template <int dim>
    Summary
    run_scene(const InputFile &input, const MPI_Comm &communicator)
    {
      std::ostringstream unseen;
      Console            quiet(communicator, unseen);
      Scene<dim>         scene(input);
      Simulation<dim>    simulation(scene, communicator, quiet);
      RunOptions         options;
      options.write_output = false;
      return simulation.run(options, input);
    }



    void
    read_scene(const InputFile &input, StudyParameters &parameters)
    {
      if (dimension_of(input) == 2)
        parameters = Scene<2>(input).study;
      else
        parameters = Scene<3>(input).study;
    }



    /** ln(e/e0) / ln(v/v0) if the last choice alone changed, and is a number.
     */
    std::string
    observed_order(const StudyResult &before, const StudyResult &now)
    {
      const auto &a = before.study_case.choices, &b = now.study_case.choices;
      if (a.size() != b.size() || a.empty() || !before.error || !now.error ||
          !std::equal(a.begin(), a.end() - 1, b.begin()))
        return "";
      const double v0 = std::atof(a.back().second.c_str());
      const double v1 = std::atof(b.back().second.c_str());
      if (!(v0 > 0) || !(v1 > 0) || v0 == v1 || !(*before.error > 0) ||
          !(*now.error > 0))
        return "";
      return text_of(std::log(*now.error / *before.error) / std::log(v1 / v0),
                     3);
    }
  } // namespace



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
             Utilities::split_string_list(input.require(section, "Settings"),
                                          ';'))
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
      read_scene(study_case.input, parameters);

    const auto paths = choice_paths(cases);
    for (const std::string &key :
         Utilities::split_string_list(parameters.group_by, ','))
      if (std::none_of(paths.begin(),
                       paths.end(),
                       [&](const std::string &path) {
                         return names_choice(key, path);
                       }))
        throw InputError(place("Study", "Group by") + ": found '" + key +
                         "', allowed: keys with choices" + suggest(key, paths));
    if (parameters.error.rfind("probe ", 0) == 0 &&
        std::atof(parameters.reference_value.c_str()) == 0.)
      throw InputError(place("Study", "Reference value") + ": found '" +
                       parameters.reference_value +
                       "', allowed with an error of a probe: a number other "
                       "than 0");

    on_root(communicator, [&]() {
      if (fs::exists(fs::path(folder) / "study.csv") && !overwrite)
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
      AtomicFile original((fs::path(folder) / "study.prm").string());
      original.stream() << input.text();
      original.commit();
    });
  }



  int
  Study::run()
  {
    console << "Moraine " << version << ", study of " << cases.size()
            << " cases\n"
            << (parameters.title.empty() ? "" : parameters.title + "\n")
            << std::flush;
    bool converged = true, input_is_right = true;
    for (std::size_t i = 0; i < cases.size(); ++i)
      {
        console.progress("  case " + std::to_string(i + 1) + " of " +
                         std::to_string(cases.size()) + ": " + cases[i].label);
        run_case(cases[i]);
        // The first run of a process also loads libraries.
        if (i == 0 && Utilities::MPI::max(results[0].summary.wall_seconds,
                                          communicator) < 1)
          {
            results.clear();
            run_case(cases[i]);
          }
        const Summary &summary = results.back().summary;
        console << "  case " << std::setw(4) << i + 1 << "  " << cases[i].label
                << ": " << text_of(summary.wall_seconds, 3) << " s";
        if (results.back().error)
          console << ", error " << text_of(*results.back().error, 3);
        if (summary.status != "ok")
          console << ", " << summary.status << ": " << summary.message;
        console.stream() << std::endl;
        on_root(communicator, [this]() { write_csv(); });
        converged      = converged && summary.status == "ok";
        input_is_right = input_is_right && summary.status != "wrong input";
        if (summary.status == "interrupted")
          break;
      }
    print_table();
    on_root(communicator, [this]() { plot(); });
    return !input_is_right ? wrong_input : converged ? done : not_converged;
  }



  void
  Study::run_case(const StudyCase &study_case)
  {
    reset_peak_memory();
    Summary summary;
    try
      {
        summary = dimension_of(study_case.input) == 2 ?
                    run_scene<2>(study_case.input, communicator) :
                    run_scene<3>(study_case.input, communicator);
      }
    catch (const InputError &error)
      {
        summary.status  = "wrong input";
        summary.message = study_case.input.located(error.what());
        end_if_alone(wrong_input, summary.message);
      }
    catch (const ComputationError &error)
      {
        end_if_alone(not_converged, error.what());
        summary.status  = "not converged";
        summary.message = error.what();
      }
    results.push_back({study_case, summary, error_of(summary)});
  }



  std::optional<double>
  Study::error_of(const Summary &summary) const
  {
    if (summary.status != "ok")
      return std::nullopt;
    std::vector<std::string> known;
    for (const auto &[name, value] : summary.errors)
      {
        if (name == parameters.error || parameters.error.empty())
          return value;
        known.push_back(name);
      }
    for (const auto &[name, value] : summary.probes)
      {
        if ("probe " + name == parameters.error)
          return std::abs(
            value / std::atof(parameters.reference_value.c_str()) - 1);
        known.push_back("probe " + name);
      }
    if (parameters.error.empty())
      return std::nullopt;
    throw InputError(place("Study", "Error") + ": found '" + parameters.error +
                     "', which this scene does not have" +
                     suggest(parameters.error, known));
  }



  void
  Study::write_csv() const
  {
    std::vector<std::string> columns;
    for (const StudyResult &result : results)
      {
        std::vector<std::string> names;
        for (const auto &cell : cells_of(result))
          names.push_back(cell.first);
        add_columns(columns, names);
      }
    AtomicFile file((fs::path(folder) / "study.csv").string());
    for (std::size_t c = 0; c < columns.size(); ++c)
      file.stream() << (c > 0 ? "," : "") << csv_cell(columns[c]);
    for (const StudyResult &result : results)
      {
        const auto cells = cells_of(result);
        file.stream() << '\n';
        for (std::size_t c = 0; c < columns.size(); ++c)
          {
            file.stream() << (c > 0 ? "," : "");
            for (const auto &[name, text] : cells)
              if (name == columns[c])
                file.stream() << csv_cell(text);
          }
      }
    file.stream() << '\n';
    file.commit();
  }



  void
  Study::print_table() const
  {
    const auto paths = choice_paths(cases);
    const bool conditioned =
      std::any_of(results.begin(), results.end(), [](const auto &result) {
        return result.summary.condition_number.has_value();
      });
    TableHandler table;
    for (std::size_t i = 0; i < results.size(); ++i)
      {
        const StudyResult &result  = results[i];
        const Summary     &summary = result.summary;
        const bool         ok      = summary.status == "ok";
        const auto or_dash = [](const bool has, const std::string &text) {
          return has && !text.empty() ? text : std::string("-");
        };
        for (const std::string &path : paths)
          {
            const std::string key = path.substr(path.rfind('/') + 1);
            const bool        once =
              std::count_if(paths.begin(), paths.end(), [&](const auto &other) {
                return names_choice(key, other);
              }) == 1;
            table.add_value(once ? key : path,
                            or_dash(true, value_of(result.study_case, path)));
          }
        table.add_value("error",
                        or_dash(result.error.has_value(),
                                text_of(result.error.value_or(0.), 4)));
        table.add_value(
          "order",
          or_dash(i > 0, observed_order(results[i > 0 ? i - 1 : 0], result)));
        table.add_value("seconds",
                        or_dash(ok, text_of(summary.wall_seconds, 3)));
        table.add_value("unknowns",
                        or_dash(ok, std::to_string(summary.unknowns)));
        table.add_value("points", or_dash(ok, std::to_string(summary.points)));
        table.add_value("MiB",
                        or_dash(ok, text_of(summary.peak_memory_mib, 4)));
        table.add_value("Newton",
                        or_dash(ok, std::to_string(summary.newton_iterations)));
        table.add_value("linear",
                        or_dash(ok, std::to_string(summary.linear_iterations)));
        if (conditioned)
          table.add_value("condition",
                          or_dash(summary.condition_number.has_value(),
                                  text_of(summary.condition_number.value_or(0.),
                                          3)));
        table.add_value("status", summary.status);
      }
    std::ostringstream text;
    table.write_text(text, TableHandler::org_mode_table);
    console << '\n'
            << text.str() << '\n'
            << "  rows in " << (fs::path(folder) / "study.csv").string()
            << std::endl;
  }



  std::vector<std::pair<std::string, std::vector<const StudyResult *>>>
  Study::curves() const
  {
    auto keys = Utilities::split_string_list(parameters.group_by, ',');
    if (keys.empty())
      {
        keys = choice_paths(cases);
        if (!keys.empty())
          keys.pop_back();
      }
    std::vector<std::pair<std::string, std::vector<const StudyResult *>>> all;
    for (const StudyResult &result : results)
      {
        if (!result.error || !(*result.error > 0))
          continue;
        std::string name;
        for (const std::string &key : keys)
          {
            const std::string value = value_of(result.study_case, key);
            if (!value.empty())
              name += (name.empty() ? "" : ", ") +
                      (key == "Series" ?
                         value :
                         key.substr(key.rfind('/') + 1) + " = " + value);
          }
        auto curve = std::find_if(all.begin(), all.end(), [&](const auto &c) {
          return c.first == name;
        });
        if (curve == all.end())
          curve = all.insert(all.end(), {name, {}});
        curve->second.push_back(&result);
      }
    return all;
  }



  void
  Study::plot() const
  {
    const auto all = curves();
    if (all.empty())
      {
        console << "  no plot: no case has an error above zero (an exact "
                   "solution, or a probe with a reference, gives one)"
                << std::endl;
        return;
      }
    const auto single_quoted = [](std::string text) {
      std::replace(text.begin(), text.end(), '\'', ' ');
      return "'" + text + "'";
    };
    AtomicFile    file((fs::path(folder) / "study.gp").string());
    std::ostream &out = file.stream();
    for (std::size_t c = 0; c < all.size(); ++c)
      {
        out << "$curve" << c << " << EOD\n";
        for (const StudyResult *result : all[c].second)
          out << text_of(result->summary.wall_seconds, 6) << ' '
              << text_of(*result->error, 10) << '\n';
        out << "EOD\n";
      }
    std::string error = parameters.error;
    if (error.empty())
      error = results.front().summary.errors.front().first;
    const std::string unit = error == "max_u" ? " [length]" :
                             error == "max_sigma" || error == "mean_sigma" ?
                                                " [stress]" :
                                                " [-]";
    if (error.rfind("probe ", 0) == 0)
      error = "relative error of " + error.substr(6);
    out << "set terminal pngcairo noenhanced size 1100,700 font ',12'\n"
        << "set output 'study.png'\n"
        << "set title " << single_quoted(parameters.title) << '\n'
        << "set xlabel 'wall time [s]'\n"
        << "set ylabel " << single_quoted(error + unit) << '\n'
        << "set logscale xy\nset format xy '%.0e'\nset grid\n"
        << "set key outside right top\n"
        << "plot ";
    for (std::size_t c = 0; c < all.size(); ++c)
      out << (c > 0 ? ", \\\n     " : "") << "$curve" << c
          << " with linespoints lw 1.5 pt " << c % 13 + 1 << " title "
          << single_quoted(all[c].first.empty() ? "all" : all[c].first);
    out << '\n';
    file.commit();

    const std::string command =
      "cd " + single_quoted(folder) + " && gnuplot study.gp";
    if (std::system(("command -v gnuplot >/dev/null 2>&1")) != 0)
      console << "  no picture: gnuplot is not installed; later: " << command
              << std::endl;
    else if (std::system(command.c_str()) != 0)
      console << "  no picture: gnuplot failed; try: " << command << std::endl;
    else
      console << "  plot in " << (fs::path(folder) / "study.png").string()
              << std::endl;
  }
} // namespace moraine
