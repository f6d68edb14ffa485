// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What of an input file a ParameterHandler declares: the part of InputFile that
// sets it.

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/input_file.h>
#include <moraine/core/input_text.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

// Keeps boost 1.74 from printing a note about its own code.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    using Tree = boost::property_tree::ptree;

    /** deal.II's entries hold their pattern; sections hold only trees. */
    bool
    is_entry(const Tree &node)
    {
      const auto pattern = node.find("pattern_description");
      return pattern != node.not_found() && pattern->second.empty();
    }



    /** deal.II writes all but letters and digits as "_2e". */
    std::string
    plain_name(const std::string &mangled)
    {
      std::string name;
      for (std::size_t i = 0; i < mangled.size(); ++i)
        if (mangled[i] == '_' && i + 2 < mangled.size())
          {
            name += static_cast<char>(
              std::stoi(mangled.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          name += mangled[i];
      return name;
    }

    Tree
    with_plain_names(const Tree &mangled)
    {
      Tree tree(mangled.data());
      for (const auto &[name, node] : mangled)
        tree.push_back({is_entry(mangled) ? name : plain_name(name),
                        with_plain_names(node)});
      return tree;
    }

    /** What the handler knows, as a tree of sections and entries. As JSON, a
     * name with a point would become two. */
    Tree
    declared_tree(ParameterHandler &prm)
    {
      std::stringstream xml;
      prm.print_parameters(xml,
                           ParameterHandler::XML |
                             ParameterHandler::KeepDeclarationOrder);
      Tree tree;
      boost::property_tree::read_xml(xml, tree);
      return with_plain_names(tree.get_child("ParameterHandler"));
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
      for (const std::string &part : parts_of_path(section))
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
          sections_with(child.second, join_path(path, child.first), key, found);
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
      for (const std::string &part : parts_of_path(section))
        {
          path.push_back(part);
          if (!prm.subsection_path_exists(path))
            {
              const Tree *node  = node_of(tree, parent);
              const auto  known = node == nullptr ? std::vector<std::string>() :
                                                    names_of(*node, false);
              throw InputError(origin + ": section '" +
                               join_path(parent, part) + "': unknown section" +
                               suggest(part, known));
            }
          parent = join_path(parent, part);
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
      const auto        path  = parts_of_path(entry.section);
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
