// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/input_file.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/input_text.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

// Keeps boost 1.74 from printing a note about its own code.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

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
    /** The section whose keys are names for values. */
    const std::string constants_section = "Constants";



    using Tree = boost::property_tree::ptree;

    const std::string statements =
      "subsection NAME, set KEY = VALUE, end, # comment";



    std::string
    join(const std::string &section, const std::string &name)
    {
      return section.empty() ? name : section + "/" + name;
    }



    std::string
    in_section(const std::string &section)
    {
      return section.empty() ? "" : "section '" + section + "', ";
    }



    std::vector<std::string>
    parts_of(const std::string &section)
    {
      return section.empty() ? std::vector<std::string>() :
                               Utilities::split_string_list(section, '/');
    }



    bool
    begins_with(const std::string &line, const std::string &word)
    {
      return line == word || line.compare(0, word.size() + 1, word + " ") == 0;
    }



    /** What the handler knows, as a tree of sections and entries. */
    Tree
    declared_tree(ParameterHandler &prm)
    {
      std::stringstream json;
      prm.print_parameters(json,
                           ParameterHandler::JSON |
                             ParameterHandler::KeepDeclarationOrder);
      Tree tree;
      boost::property_tree::read_json(json, tree);
      return tree;
    }



    /** deal.II's entries hold their pattern; sections hold only trees. */
    bool
    is_entry(const Tree &node)
    {
      const auto pattern = node.find("pattern_description");
      return pattern != node.not_found() && pattern->second.empty();
    }



    /** Names directly in @p node: its keys, or its sections. */
    std::vector<std::string>
    names_of(const Tree &node, const bool entries)
    {
      std::vector<std::string> names;
      for (const auto &child : node)
        if (is_entry(child.second) == entries)
          names.push_back(child.first);
      return names;
    }



    const Tree *
    child_of(const Tree &node, const std::string &name, const bool entry)
    {
      for (const auto &child : node)
        if (child.first == name && is_entry(child.second) == entry)
          return &child.second;
      return nullptr;
    }



    /** The node of a section that exists, or nothing if it declares no key. */
    const Tree *
    node_of(const Tree &tree, const std::string &section)
    {
      const Tree *node = &tree;
      for (const std::string &part : parts_of(section))
        if (node != nullptr)
          node = child_of(*node, part, false);
      return node;
    }



    /** Paths of the sections that declare @p key, in @p node. */
    void
    sections_with(const Tree               &node,
                  const std::string        &path,
                  const std::string        &key,
                  std::vector<std::string> &found)
    {
      for (const auto &child : node)
        if (!is_entry(child.second))
          sections_with(child.second, join(path, child.first), key, found);
        else if (child.first == key)
          found.push_back("'" + path + "'");
    }



    void
    check_section(const ParameterHandler &prm,
                  const Tree             &tree,
                  const std::string      &section,
                  const std::string      &origin)
    {
      std::vector<std::string> path;
      std::string              parent;
      for (const std::string &part : parts_of(section))
        {
          path.push_back(part);
          if (!prm.subsection_path_exists(path))
            {
              const Tree *node  = node_of(tree, parent);
              const auto  known = node == nullptr ? std::vector<std::string>() :
                                                    names_of(*node, false);
              throw InputError(origin + ": section '" + join(parent, part) +
                               "': unknown section" + suggest(part, known));
            }
          parent = join(parent, part);
        }
    }



    /** @return what is declared for the key. */
    const Tree &
    check_key(const Tree &tree, const InputFile::Entry &entry)
    {
      const Tree *node = node_of(tree, entry.section);
      const Tree *leaf =
        node == nullptr ? nullptr : child_of(*node, entry.key, true);
      if (leaf != nullptr)
        return *leaf;

      const auto known =
        node == nullptr ? std::vector<std::string>() : names_of(*node, true);
      std::vector<std::string> elsewhere;
      sections_with(tree, "", entry.key, elsewhere);
      std::string message =
        entry.origin + ": " + place(entry.section, entry.key) + ": unknown key";
      if (nearest(entry.key, known).empty() && !elsewhere.empty())
        message += "; it belongs in section " + elsewhere.front();
      throw InputError(message + suggest(entry.key, known));
    }



    /** Whether two texts are equal, as words or as numbers. */
    bool
    are_equal(const std::string &a, const std::string &b)
    {
      return a == b || (plain_number(a) && plain_number(a) == plain_number(b));
    }



    void
    set_value(ParameterHandler       &prm,
              const InputFile::Entry &entry,
              const std::string      &pattern)
    {
      if (entry.value.find("{{") != std::string::npos)
        throw InputError(
          entry.origin + ": " + place(entry.section, entry.key) + ": found '" +
          entry.value +
          "', a choice for 'moraine study'; allowed: " + describe(pattern));

      const std::string value = with_arithmetic(entry.value, pattern);
      const auto        path  = parts_of(entry.section);
      for (const std::string &part : path)
        prm.enter_subsection(part);
      std::string mistake;
      try
        {
          prm.set(entry.key, value);
        }
      catch (const ExceptionBase &)
        {
          mistake =
            entry.origin + ": " + place(entry.section, entry.key) + ": found " +
            (entry.value.empty() ? "nothing" : "'" + entry.value + "'") +
            (value == entry.value ? "" : ", which is " + value) +
            ", allowed: " + describe(pattern);
        }
      for (std::size_t i = 0; i < path.size(); ++i)
        prm.leave_subsection();
      if (!mistake.empty())
        throw InputError(mistake);
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
            if (name.empty() || name.find_first_of("/.") != std::string::npos)
              throw InputError(
                lines[i].origin + ": " + in_section(before) + "found '" +
                statement + "'; a subsection needs a name without '/' and '.'");
            open_sections.push_back({join(before, name), lines[i].origin});
            if (std::none_of(sections.begin(),
                             sections.end(),
                             [&](const Line &known) {
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
      parts = parts_of(path.substr(0, slash));
    std::string section;
    for (const std::string &part : parts)
      if (part.empty())
        throw InputError(origin + ": a section without a name; allowed: --set "
                                  "\"Section/Key = value\"");
      else
        section = join(section, part);

    const auto star = std::find(parts.begin(), parts.end(), "*");
    if (star != parts.end())
      {
        std::string before, after;
        for (auto part = parts.begin(); part != star; ++part)
          before = join(before, *part);
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
          apply_override(join(before, name) + after + "/" + key + " =" +
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
    return std::any_of(found_entries.begin(),
                       found_entries.end(),
                       [&](const Entry &entry) {
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



  std::vector<InputFile::Entry>
  InputFile::parse(ParameterHandler &prm) const
  {
    const Tree tree = declared_tree(prm);
    for (const Line &section : sections)
      if (section.text != constants_section)
        check_section(prm, tree, section.text, section.origin);
    const auto         all = values();
    std::vector<Entry> given;
    for (std::size_t e = 0; e < found_entries.size(); ++e)
      if (found_entries[e].section != constants_section)
        {
          Entry entry      = found_entries[e];
          entry.value      = all[e];
          const Tree &leaf = check_key(tree, entry);
          set_value(prm, entry, leaf.get<std::string>("pattern_description"));
          if (!are_equal(entry.value, leaf.get<std::string>("default_value")))
            given.push_back(entry);
        }
    return given;
  }
} // namespace moraine
