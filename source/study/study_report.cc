// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/study_report.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/atomic_file.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/output/history.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/table_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  std::string
  StudySetting::file(const std::string &name) const
  {
    return (std::filesystem::path(folder) / name).string();
  }



  namespace
  {
    using Cells = std::vector<std::pair<std::string, std::string>>;

    /** Everything a row has, by column. */
    Cells
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
      if (result.value)
        number("value", *result.value);
      for (const auto &[name, value] : summary.errors)
        if (value)
          number(name, *value);
      for (const auto &[name, value] : summary.last.probes)
        number(name, value);
      number("wall_seconds", summary.wall_seconds);
      for (const auto &[name, seconds] : summary.timings)
        number("seconds in " + name, seconds);
      number("cells", summary.sizes.cells);
      number("active_cells", summary.sizes.active_cells);
      number("unknowns", summary.sizes.unknowns);
      number("points", summary.sizes.points);
      number("time", summary.time);
      number("steps", summary.steps);
      number("rejected_steps", summary.rejected_steps);
      number("newton_iterations", summary.newton_iterations);
      number("linear_iterations", summary.linear.iterations);
      if (summary.linear.condition_number)
        number("condition_number", *summary.linear.condition_number);
      number("bytes_per_point", summary.sizes.bytes_per_point);
      number("peak_memory_mib", summary.sizes.peak_memory_mib);
      number("ranks", summary.sizes.ranks);
      cells.emplace_back("version", summary.version);
      return cells;
    }



    /** Key of the choice in which two cases differ, if it is one alone. */
    std::string
    only_difference(const StudyCase &a, const StudyCase &b)
    {
      std::string path;
      if (a.choices.size() != b.choices.size())
        return "";
      for (std::size_t c = 0; c < a.choices.size(); ++c)
        if (a.choices[c] != b.choices[c])
          {
            if (!path.empty() || a.choices[c].first != b.choices[c].first)
              return "";
            path = a.choices[c].first;
          }
      return path;
    }



    /**
     * The first numbers in which two texts differ: 10 and 20 of "2: 10: 72" and
     * "2: 20: 144"; zeros if there are none.
     */
    std::pair<double, double>
    differing_numbers(const std::string &a, const std::string &b)
    {
      const auto numbers_of = [](std::string text) {
        for (char &c : text)
          if (std::string(",;:").find(c) != std::string::npos)
            c = ' ';
        std::vector<double> numbers;
        std::istringstream  in(text);
        for (std::string word; in >> word;)
          numbers.push_back(number_from(word).value_or(0.));
        return numbers;
      };
      const auto x = numbers_of(a), y = numbers_of(b);
      for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
        if (x[i] != y[i])
          return {x[i], y[i]};
      return {0., 0.};
    }



    /** Whether it says how large cells are. */
    bool
    sizes_cells(const InputFile::Entry &entry)
    {
      return entry.section == "Mesh" && contains({"Cell size",
                                                  "Cells",
                                                  "Refinements",
                                                  "Arguments",
                                                  "Extrusion layers"},
                                                 entry.key);
    }



    /** Whether it says how long steps are. */
    bool
    sizes_steps(const InputFile::Entry &entry)
    {
      return contains({"Steps", "Largest step", "Arc length"}, entry.key) &&
             (entry.section == "Time" ||
              (entry.section.rfind("Stages/", 0) == 0 &&
               names_choice("Time", entry.section)));
    }



    /**
     * |ln(v/v0)| of the first value that differs between two cases of a study
     * and for which @p counts: whether it is a choice or has its constants from
     * one. 0 if there is none.
     */
    double
    difference_of_sizes(const InputFile &a,
                        const InputFile &b,
                        bool (*counts)(const InputFile::Entry &))
    {
      for (const InputFile::Entry &entry : a.entries())
        if (counts(entry))
          {
            const auto [v0, v1] =
              differing_numbers(a.require(entry.section, entry.key),
                                b.get(entry.section, entry.key, ""));
            if (entry.key == "Refinements" && v0 != v1)
              return std::abs(v1 - v0) * std::log(2.);
            if (v0 != v1 && v0 > 0 && v1 > 0)
              return std::abs(std::log(v1 / v0));
          }
      return 0.;
    }



    /**
     * ln(e0/e) / |ln(v/v0)|, where e0 belongs to the last result before with
     * another value of key @p path and all other choices equal, and v are sizes
     * of cells or, if these are equal, of steps. Nothing if that key changes
     * neither.
     */
    std::string
    observed_order(const std::vector<StudyResult> &results,
                   const std::size_t               now,
                   const std::string              &path)
    {
      const StudyResult &result = results[now];
      for (std::size_t i = now; i-- > 0;)
        {
          const StudyResult &before = results[i];
          if (only_difference(before.study_case, result.study_case) != path)
            continue;
          if (!before.error || !result.error || !(*before.error > 0) ||
              !(*result.error > 0))
            return "";
          const InputFile &a         = before.study_case.input;
          const InputFile &b         = result.study_case.input;
          const double     of_cells  = difference_of_sizes(a, b, sizes_cells);
          const bool       has_cells = of_cells > 0;
          const double     difference =
            has_cells ? of_cells : difference_of_sizes(a, b, sizes_steps);
          const auto count = [has_cells](const Summary &summary) -> double {
            return has_cells ? summary.sizes.unknowns : summary.steps;
          };
          const double n0 = count(before.summary), n1 = count(result.summary);
          if (!(difference > 0) || n0 == n1)
            return "";
          return text_of(std::log(*before.error / *result.error) / difference *
                           (n1 < n0 ? -1 : 1),
                         3);
        }
      return "";
    }



    bool
    is_less_fine(const StudyResult *a, const StudyResult *b)
    {
      return std::make_pair(a->summary.sizes.unknowns, a->summary.steps) <
             std::make_pair(b->summary.sizes.unknowns, b->summary.steps);
    }



    bool
    any_value(const std::vector<StudyResult> &results)
    {
      return any_of(results, [](const StudyResult &result) {
        return result.value.has_value();
      });
    }



    /** For gnuplot, which has no way to put an apostrophe into it. */
    std::string
    single_quoted(std::string text)
    {
      std::replace(text.begin(), text.end(), '\'', ' ');
      return "'" + text + "'";
    }
  } // namespace



  std::string
  column_of_error(const std::string &error)
  {
    for (const std::string kind : {"probe ", "history "})
      if (error.rfind(kind, 0) == 0)
        return Utilities::trim(error.substr(kind.size()));
    return error;
  }



  void
  compare_neighbours(const std::vector<StudyCase> &cases,
                     std::vector<StudyResult>     &results)
  {
    for (StudyResult &result : results)
      {
        const StudyResult *next = nullptr;
        for (const StudyResult &other : results)
          if (result.value && other.value && is_less_fine(&result, &other) &&
              only_difference(result.study_case, other.study_case) ==
                refined_choice(cases) &&
              (!next || is_less_fine(&other, next)))
            next = &other;
        if (next && *next->value != 0.)
          result.error = std::abs(*result.value / *next->value - 1);
      }
  }



  std::vector<std::string>
  short_names(const std::vector<std::string> &paths)
  {
    std::vector<std::string> names;
    for (const std::string &path : paths)
      {
        const std::string key = path.substr(path.rfind('/') + 1);
        const bool        once =
          std::count_if(paths.begin(), paths.end(), [&](const auto &other) {
            return names_choice(key, other);
          }) == 1;
        names.push_back(once ? key : path);
      }
    return names;
  }



  void
  write_csv(const StudySetting             &setting,
            const std::vector<StudyResult> &results)
  {
    std::vector<Cells>       rows;
    std::vector<std::string> columns;
    for (const StudyResult &result : results)
      {
        rows.push_back(cells_of(result));
        for (const auto &[name, text] : rows.back())
          if (!contains(columns, name))
            columns.push_back(name);
      }
    on_root(setting.communicator, [&]() {
      AtomicFile file(setting.file("study.csv"));
      for (std::size_t c = 0; c < columns.size(); ++c)
        file.stream() << (c > 0 ? "," : "") << csv_cell(columns[c]);
      for (const Cells &cells : rows)
        for (std::size_t c = 0; c < columns.size(); ++c)
          {
            file.stream() << (c > 0 ? "," : "\n");
            for (const auto &[name, text] : cells)
              if (name == columns[c])
                file.stream() << csv_cell(text);
          }
      file.stream() << '\n';
      file.commit();
    });
  }



  void
  print_table(const StudySetting             &setting,
              const std::vector<StudyCase>   &cases,
              const std::vector<StudyResult> &results)
  {
    const auto   paths       = choice_paths(cases);
    const auto   names       = short_names(paths);
    const bool   has_values  = any_value(results);
    const bool   conditioned = any_of(results, [](const auto &result) {
      return result.summary.linear.condition_number.has_value();
    });
    TableHandler table;
    for (std::size_t i = 0; i < results.size(); ++i)
      {
        const StudyResult &result  = results[i];
        const Summary     &summary = result.summary;
        const auto         add     = [&table](const std::string &name,
                                  const std::string &text) {
          table.add_value(name, text.empty() ? "-" : text);
        };
        const auto number = [&add](const std::string          &name,
                                   const std::optional<double> value,
                                   const unsigned int          digits) {
          add(name, value ? text_of(*value, digits) : "");
        };
        const auto count = [&](const std::string &name, const auto n) {
          add(name, summary.status == "ok" ? std::to_string(n) : "");
        };
        const auto if_ok = [&](const double value) {
          return summary.status == "ok" ? std::optional<double>(value) :
                                          std::nullopt;
        };
        for (std::size_t p = 0; p < paths.size(); ++p)
          add(names[p], value_of(result.study_case, paths[p]));
        if (has_values)
          number("value", result.value, 6);
        number("error", result.error, 4);
        add("order", observed_order(results, i, refined_choice(cases)));
        number("seconds", if_ok(summary.wall_seconds), 3);
        count("unknowns", summary.sizes.unknowns);
        count("points", summary.sizes.points);
        number("MiB", if_ok(summary.sizes.peak_memory_mib), 4);
        count("Newton", summary.newton_iterations);
        count("linear", summary.linear.iterations);
        if (conditioned)
          number("condition", summary.linear.condition_number, 3);
        add("status", summary.status);
      }
    std::ostringstream text;
    table.write_text(text, TableHandler::org_mode_table);
    setting.console << '\n'
                    << text.str() << '\n'
                    << "  rows in " << setting.file("study.csv") << std::endl;
  }



  namespace
  {
    /** Results that differ in one choice only, the coarsest first. */
    struct Curve
    {
      std::string                      name;
      std::vector<const StudyResult *> results;
    };



    /** In a panel: each has a colour and a symbol of its own. */
    constexpr unsigned int most_curves = 8;



    std::vector<Curve>
    curves_of(const std::string              &group_by,
              const std::vector<StudyCase>   &cases,
              const std::vector<StudyResult> &results)
    {
      auto keys = Utilities::split_string_list(group_by, ',');
      if (keys.empty())
        for (const std::string &path : choice_paths(cases))
          if (path != refined_choice(cases))
            keys.push_back(path);
      std::vector<Curve> all;
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
            return c.name == name;
          });
          if (curve == all.end())
            curve = all.insert(all.end(), {name, {}});
          curve->results.push_back(&result);
        }
      for (Curve &curve : all)
        std::stable_sort(curve.results.begin(),
                         curve.results.end(),
                         is_less_fine);
      return all;
    }



    /** Numbers of the curves in each panel. */
    std::vector<std::vector<unsigned int>>
    panels_of(const std::string &panels, const std::vector<Curve> &all)
    {
      std::vector<std::vector<unsigned int>> chosen;
      for (const std::string &panel : Utilities::split_string_list(panels, ';'))
        {
          chosen.emplace_back();
          const auto beginnings = Utilities::split_string_list(panel, '|');
          for (unsigned int c = 0; c < all.size(); ++c)
            if (any_of(beginnings, [&](const std::string &begin) {
                  return all[c].name.rfind(begin, 0) == 0;
                }))
              chosen.back().push_back(c);
        }
      if (all_of(chosen, [](const auto &panel) { return panel.empty(); }))
        for (unsigned int c = 0; c < all.size(); ++c)
          {
            if (chosen.empty() || chosen.back().size() == most_curves)
              chosen.emplace_back();
            chosen.back().push_back(c);
          }
      // Nobody tells more curves apart.
      std::vector<std::vector<unsigned int>> readable;
      for (const auto &panel : chosen)
        for (std::size_t c = 0; c < panel.size(); c += most_curves)
          readable.emplace_back(panel.begin() + c,
                                panel.begin() +
                                  std::min<std::size_t>(c + most_curves,
                                                        panel.size()));
      return readable;
    }



    std::string
    error_label(const StudyParameters          &parameters,
                const std::vector<StudyResult> &results)
    {
      const std::string &reference = parameters.reference_value;
      std::string        shown     = parameters.error;
      for (const StudyResult &result : results)
        if (shown.empty() && result.error)
          shown = result.summary.errors.front().first;
      if (any_value(results))
        return (reference.empty() ?
                  "relative change to the next finer case of " :
                  "relative error of ") +
               column_of_error(shown) + " [-]";
      if (!reference.empty())
        return shown + " / " + reference + " [-]";
      return shown + (shown == "max_u" ? " [length]" :
                      shown == "max_sigma" || shown == "mean_sigma" ?
                                         " [stress]" :
                                         " [-]");
    }



    void
    write_script(const std::string        &path,
                 const StudyParameters    &parameters,
                 const std::string        &label,
                 const std::vector<Curve> &all)
    {
      AtomicFile    file(path);
      std::ostream &out = file.stream();
      for (std::size_t c = 0; c < all.size(); ++c)
        {
          out << "$curve" << c << " << EOD\n";
          for (const StudyResult *result : all[c].results)
            out << result->summary.sizes.unknowns << ' '
                << text_of(result->summary.wall_seconds, 6) << ' '
                << text_of(*result->error, 10) << '\n';
          out << "EOD\n";
        }
      const auto panel_list = panels_of(parameters.panels, all);
      out << "set terminal pngcairo size 1400," << 40 + 460 * panel_list.size()
          << " font ',12'\n"
          << "set output 'study.png'\n"
          << "set multiplot layout " << panel_list.size() << ",2 title "
          << single_quoted(parameters.title) << " noenhanced\n"
          << "set ylabel " << single_quoted(label) << " noenhanced\n"
          << "set logscale xy\nset format xy '10^{%T}'\nset grid\n"
          << "set colorsequence podo\n";
      // Both panels of a row are as wide; names of curves are right of them.
      for (const auto &panel : panel_list)
        for (const bool over_time : {false, true})
          {
            out << "set xlabel "
                << (over_time ? "'wall time [s]'" : "'unknowns'") << '\n'
                << (over_time ? "set lmargin at screen 0.43\n"
                                "set rmargin at screen 0.72\n"
                                "set key outside right top noenhanced\n" :
                                "set lmargin at screen 0.065\n"
                                "set rmargin at screen 0.355\nunset key\n")
                << "plot ";
            for (std::size_t k = 0; k < panel.size(); ++k)
              {
                const std::string &name = all[panel[k]].name;
                out << (k > 0 ? ", \\\n     " : "") << "$curve" << panel[k]
                    << " using " << (over_time ? 2 : 1)
                    << ":3 with linespoints lw 1.5 lt " << k + 1 << " pt "
                    << k + 4 << " title "
                    << single_quoted(name.empty() ? "all" : name);
              }
            out << '\n';
          }
      out << "unset multiplot\n";
      file.commit();
    }
  } // namespace



  void
  plot(const StudySetting             &setting,
       const StudyParameters          &parameters,
       const std::vector<StudyCase>   &cases,
       const std::vector<StudyResult> &results)
  {
    Console   &console = setting.console;
    const auto all     = curves_of(parameters.group_by, cases, results);
    if (all.empty())
      {
        console << "  no plot: no case has an error above zero (from an exact "
                   "solution, or a column of the history)"
                << std::endl;
        return;
      }
    write_script(setting.file("study.gp"),
                 parameters,
                 error_label(parameters, results),
                 all);
    const std::string command =
      "cd " + one_word(setting.folder) + " && gnuplot study.gp";
    if (std::system(("command -v gnuplot >/dev/null 2>&1")) != 0)
      console << "  no picture: gnuplot is not installed; later: " << command
              << std::endl;
    else if (std::system(command.c_str()) != 0)
      console << "  no picture: gnuplot failed; try: " << command << std::endl;
    else
      console << "  plot in " << setting.file("study.png") << std::endl;
  }
} // namespace moraine
