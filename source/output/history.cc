// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/history.h>

#include <moraine/core/exceptions.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/exceptions.h>

#include <iomanip>

namespace moraine
{
  namespace
  {
    /** The name of a column with its unit, quoted as CSV asks for. */
    std::string
    column_title(const NamedValue &value)
    {
      const std::string title =
        value.unit == "-" ? value.name : value.name + " [" + value.unit + "]";
      if (title.find_first_of(",\"\n") == std::string::npos)
        return title;
      std::string quoted = "\"";
      for (const char c : title)
        quoted += (c == '"' ? std::string("\"\"") : std::string(1, c));
      return quoted + "\"";
    }
  } // namespace



  History::History(const std::string &path, const MPI_Comm &communicator)
    : path(path)
    , communicator(communicator)
  {}



  void
  History::add_row(const std::vector<NamedValue> &row)
  {
    std::vector<std::string> titles;
    for (const NamedValue &value : row)
      titles.push_back(column_title(value));
    const bool first = columns.empty();
    if (first)
      columns = titles;
    AssertThrow(titles == columns,
                dealii::ExcMessage("the columns of " + path + " changed"));

    on_root(communicator, [&]() {
      if (first)
        {
          file.open(path);
          for (unsigned int i = 0; i < titles.size(); ++i)
            file << (i > 0 ? "," : "") << titles[i];
          file << '\n';
        }
      write_row(row);
    });
  }



  void
  History::write_row(const std::vector<NamedValue> &row)
  {
    file << std::setprecision(15);
    for (unsigned int i = 0; i < row.size(); ++i)
      file << (i > 0 ? "," : "") << row[i].value;
    file << '\n' << std::flush;
    if (!file)
      throw InputError("cannot write the file " + path +
                       ": is the folder there, is the disk full?");
  }
} // namespace moraine
