// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/input_file.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/input_text.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string statements =
      "subsection NAME, set KEY = VALUE, end, # comment";



    std::string
    in_section(const std::string &section)
    {
      return section.empty() ? "" : "section '" + section + "', ";
    }



    bool
    begins_with(const std::string &line, const std::string &word)
    {
      return line == word || line.compare(0, word.size() + 1, word + " ") == 0;
    }



  } // namespace



  InputFile
  InputFile::read(const std::string &path)
  {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
      throw InputError(path + ": cannot be read: it is a directory");
    std::ifstream      file(path);
    std::ostringstream text;
    if (file && file.peek() != std::ifstream::traits_type::eof())
      text << file.rdbuf();
    if (!file.is_open() || file.bad())
      throw InputError(path + ": cannot be read: " + std::strerror(errno));
    return from_text(path, text.str());
  }



  InputFile
  InputFile::from_text(const std::string &name, const std::string &text)
  {
    InputFile file;
    file.file_name = name;

    std::istringstream stream(without_mark(text));
    std::string        line;
    bool               continued = false;
    for (unsigned int number = 1; std::getline(stream, line); ++number)
      {
        // deal.II drops the spaces on both sides of a continued line.
        if (continued)
          file.lines.back().text += Utilities::trim(line);
        else
          file.lines.push_back({line, name + ":" + std::to_string(number)});
        std::string &all     = file.lines.back().text;
        const auto   trimmed = Utilities::trim(all);
        continued            = !trimmed.empty() && trimmed.back() == '\\';
        if (continued)
          all.erase(all.rfind('\\'));
      }
    file.scan();
    return file;
  }



  void
  InputFile::scan()
  {
    found_entries.clear();
    line_of_entry.clear();
    sections.clear();
    open_sections.clear();
    for (std::size_t i = 0; i < lines.size(); ++i)
      {
        std::string statement =
          lines[i].text.substr(0, lines[i].text.find('#'));
        std::replace(statement.begin(), statement.end(), '\t', ' ');
        statement = Utilities::trim(statement);
        if (statement.empty())
          continue;
        check_text(statement, lines[i].origin);
        const std::string before =
          open_sections.empty() ? std::string() : open_sections.back().text;
        if (begins_with(statement, "set") || begins_with(statement, "SET"))
          scan_entry(i, Utilities::trim(statement.substr(3)));
        else if (begins_with(statement, "subsection") ||
                 begins_with(statement, "SUBSECTION"))
          {
            const std::string name = Utilities::trim(statement.substr(10));
            if (name.empty() || name.find('/') != std::string::npos ||
                name.find_first_not_of('.') == std::string::npos)
              throw InputError(lines[i].origin + ": " + in_section(before) +
                               "found '" + statement +
                               "'; a subsection needs a name without '/'");
            open_sections.push_back({join_path(before, name), lines[i].origin});
            if (none_of(sections, [&](const Line &known) {
                  return known.text == open_sections.back().text;
                }))
              sections.push_back(open_sections.back());
          }
        else if (statement == "end" || statement == "END")
          {
            if (open_sections.empty())
              throw InputError(lines[i].origin +
                               ": 'end' without a 'subsection' it could close");
            open_sections.pop_back();
          }
        else
          throw InputError(lines[i].origin + ": " + in_section(before) +
                           "found '" + statement + "', allowed: " + statements);
      }
    if (!open_sections.empty())
      throw InputError(open_sections.back().origin + ": section '" +
                       open_sections.back().text +
                       "' is opened here, but its 'end' is missing");
  }



  void
  InputFile::scan_entry(const std::size_t line, const std::string &statement)
  {
    const std::string &origin = lines[line].origin;
    const std::string  section =
      open_sections.empty() ? std::string() : open_sections.back().text;
    const auto equals = statement.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(origin + ": " + in_section(section) + "found 'set " +
                       statement + "', allowed: set KEY = VALUE");
    const Entry entry{section,
                      Utilities::trim(statement.substr(0, equals)),
                      Utilities::trim(statement.substr(equals + 1)),
                      origin};
    for (const Entry &earlier : found_entries)
      if (earlier.section == entry.section && earlier.key == entry.key)
        throw InputError(origin + ": " + place(entry.section, entry.key) +
                         ": is set twice; first at " + earlier.origin);
    found_entries.push_back(entry);
    line_of_entry.push_back(line);
  }



  void
  InputFile::apply_override(const std::string &setting)
  {
    const std::string origin = "--set '" + setting + "'";
    const auto        equals = setting.find('=');
    const std::string path   = Utilities::trim(setting.substr(0, equals));
    const auto        slash  = path.rfind('/');
    const std::string key    = Utilities::trim(
      slash == std::string::npos ? path : path.substr(slash + 1));
    if (equals == std::string::npos || key.empty() ||
        setting.find_first_of("#\n\\") != std::string::npos)
      throw InputError(origin + ": allowed: --set \"Section/Key = value\", "
                                "without '#' and '\\'");
    std::vector<std::string> parts;
    if (slash != std::string::npos)
      parts = parts_of_path(path.substr(0, slash));
    std::string section;
    for (const std::string &part : parts)
      if (part.empty())
        throw InputError(origin + ": a section without a name; allowed: --set "
                                  "\"Section/Key = value\"");
      else
        section = join_path(section, part);

    const auto star = std::find(parts.begin(), parts.end(), "*");
    if (star != parts.end())
      {
        std::string before, after;
        for (auto part = parts.begin(); part != star; ++part)
          before = join_path(before, *part);
        for (auto part = star + 1; part != parts.end(); ++part)
          after += "/" + *part;
        const auto names = names_in(before);
        if (setting.find("{{") != std::string::npos)
          throw InputError(origin +
                           ": found '*' and a choice, which would vary "
                           "for each name on its own; allowed: one "
                           "of them, or series in 'Study/Series'");
        if (names.empty())
          throw InputError(origin + ": section '" + before +
                           "': found no name that '*' could stand for");
        for (const std::string &name : names)
          apply_override(join_path(before, name) + after + "/" + key + " =" +
                         setting.substr(equals + 1));
        return;
      }

    applied.push_back(setting);
    const std::string line =
      "set " + key + " = " + Utilities::trim(setting.substr(equals + 1));
    for (std::size_t i = 0; i < found_entries.size(); ++i)
      if (found_entries[i].section == section && found_entries[i].key == key)
        {
          lines[line_of_entry[i]] = {line, origin};
          return scan();
        }
    for (const std::string &part : parts)
      lines.push_back({"subsection " + part, origin});
    lines.push_back({line, origin});
    for (std::size_t i = 0; i < parts.size(); ++i)
      lines.push_back({"end", origin});
    scan();
  }



  InputFile
  InputFile::with_value(const std::size_t entry, const std::string &value) const
  {
    AssertIndexRange(entry, found_entries.size());
    InputFile    file   = *this;
    std::string &line   = file.lines[line_of_entry[entry]].text;
    const auto   indent = line.find_first_not_of(" \t");
    line = line.substr(0, indent) + "set " + found_entries[entry].key + " = " +
           value;
    file.scan();
    return file;
  }



  const std::vector<InputFile::Entry> &
  InputFile::entries() const
  {
    return found_entries;
  }



  bool
  InputFile::has(const std::string &section, const std::string &key) const
  {
    return any_of(found_entries, [&](const Entry &entry) {
      return entry.section == section && entry.key == key;
    });
  }



  std::string
  InputFile::get(const std::string &section,
                 const std::string &key,
                 const std::string &fallback) const
  {
    return has(section, key) ? require(section, key) : fallback;
  }



  std::string
  InputFile::require(const std::string &section, const std::string &key) const
  {
    const auto all = values();
    for (std::size_t e = 0; e < found_entries.size(); ++e)
      if (found_entries[e].section == section && found_entries[e].key == key)
        return all[e];

    std::string origin = file_name;
    for (const Line &known : sections)
      if (known.text == section)
        origin = known.origin;
    throw InputError(origin + ": " + place(section, key) +
                     ": is not set, and has no default");
  }



  std::vector<std::string>
  InputFile::names_in(const std::string &section) const
  {
    std::vector<std::string> names;
    const std::string        prefix = section.empty() ? "" : section + "/";
    for (const Line &known : sections)
      if (known.text.size() > prefix.size() &&
          known.text.compare(0, prefix.size(), prefix) == 0 &&
          known.text.find('/', prefix.size()) == std::string::npos)
        names.push_back(known.text.substr(prefix.size()));
    return names;
  }



  std::string
  InputFile::located(const std::string &message) const
  {
    const auto begins = [&message](const std::string &text) {
      return message.compare(0, text.size(), text) == 0;
    };
    if (!begins("section '") && !begins("key '"))
      return message;
    for (const Entry &entry : found_entries)
      if (begins(place(entry.section, entry.key)))
        return entry.origin + ": " + message;
    for (const Line &section : sections)
      if (begins("section '" + section.text + "'"))
        return section.origin + ": " + message;
    return file_name + ": " + message;
  }



  const std::string &
  InputFile::name() const
  {
    return file_name;
  }



  std::string
  InputFile::text() const
  {
    std::string all;
    for (const Line &line : lines)
      all += line.text + "\n";
    return all;
  }



  std::vector<std::string>
  InputFile::values() const
  {
    std::vector<std::string>                         all(found_entries.size());
    std::vector<std::pair<std::string, std::string>> constants;
    // A constant sees those before it, so none needs itself; all else sees all.
    for (const bool is_constant : {true, false})
      for (std::size_t e = 0; e < found_entries.size(); ++e)
        {
          const Entry &entry = found_entries[e];
          if ((entry.section == constants_section) != is_constant)
            continue;
          all[e] = with_constants(entry.value,
                                  entry.origin + ": " +
                                    place(entry.section, entry.key),
                                  constants);
          if (is_constant)
            constants.emplace_back(entry.key, with_numbers(all[e], ""));
        }
    return all;
  }
} // namespace moraine
