// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/history.h>

#include <moraine/core/exceptions.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace moraine
{
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



  History::History(const std::string &path,
                   const MPI_Comm    &communicator,
                   const Units       &units)
    : path(path)
    , communicator(communicator)
    , units(units)
  {}



  void
  History::add_row(const std::vector<NamedValue> &row)
  {
    std::vector<std::string> titles;
    for (const NamedValue &value : row)
      titles.push_back(csv_cell(
        value.unit == "-" ? value.name :
                            value.name + " [" + units.of(value.unit) + "]"));
    const bool first = columns.empty();
    if (first)
      columns = titles;
    AssertThrow(titles == columns,
                dealii::ExcMessage("the columns of " + path + " changed"));

    std::vector<double> row_values;
    for (const NamedValue &value : row)
      row_values.push_back(value.value);
    write_rows(row_values, first);
    values.insert(values.end(), row_values.begin(), row_values.end());
  }



  void
  History::write_rows(const std::vector<double> &rows, const bool first)
  {
    on_root(communicator, [&]() {
      if (first)
        {
          file.close();
          file.open(path);
          for (unsigned int i = 0; i < columns.size(); ++i)
            file << (i > 0 ? "," : "") << columns[i];
          file << '\n';
        }
      file << std::setprecision(15);
      for (std::size_t i = 0; i < rows.size(); ++i)
        file << (i % columns.size() > 0 ? "," : "") << rows[i]
             << ((i + 1) % columns.size() == 0 ? "\n" : "");
      file << std::flush;
      if (!file)
        throw InputError("cannot write the file " + path +
                         ": is the folder there, is the disk full?");
    });
  }



  void
  History::write(Archive &archive) const
  {
    archive.write_lines("output/history/columns", columns);
    archive.write("output/history/rows",
                  values,
                  std::max<unsigned int>(1, columns.size()));
  }



  void
  History::read(const Archive &archive)
  {
    const std::vector<std::string> read_columns =
      archive.lines("output/history/columns");
    const auto &read_values =
      archive.numbers("output/history/rows",
                      std::max<unsigned int>(1, read_columns.size()));
    if (read_columns == columns && read_values == values)
      return;
    columns = read_columns;
    values  = read_values;
    write_rows(values, true);
  }
} // namespace moraine
