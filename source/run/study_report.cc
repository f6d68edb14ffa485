// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/study_report.h>

#include <moraine/core/atomic_file.h>

#include <deal.II/base/table_handler.h>
#include <deal.II/base/utilities.h>

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

  std::string
  text_of(const double value, const unsigned int digits)
  {
    std::ostringstream text;
    text << std::setprecision(digits) << value;
    return text.str();
  }



  namespace
  {
    /** Columns in the order in which the cases bring them. */
    void
    add_columns(std::vector<std::string>       &columns,
                const std::vector<std::string> &more)
    {
      for (const std::string &name : more)
        if (std::find(columns.begin(), columns.end(), name) == columns.end())
          columns.push_back(name);
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



  void
  StudyReport::write_csv() const
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
  StudyReport::print_table(Console &console) const
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
  StudyReport::curves() const
  {
    auto keys = Utilities::split_string_list(group_by, ',');
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
  StudyReport::plot(Console &console) const
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
    std::string shown = error;
    if (shown.empty())
      shown = results.front().summary.errors.front().first;
    const std::string unit = shown == "max_u" ? " [length]" :
                             shown == "max_sigma" || shown == "mean_sigma" ?
                                                " [stress]" :
                                                " [-]";
    if (shown.rfind("probe ", 0) == 0)
      shown = "relative error of " + shown.substr(6);
    out << "set terminal pngcairo noenhanced size 1100,700 font ',12'\n"
        << "set output 'study.png'\n"
        << "set title " << single_quoted(title) << '\n'
        << "set xlabel 'wall time [s]'\n"
        << "set ylabel " << single_quoted(shown + unit) << '\n'
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
