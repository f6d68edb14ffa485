// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/parameter_reference.h>

#include <moraine/core/patterns.h>
#include <moraine/core/words.h>
#include <moraine/scene/scene.h>

#include <nlohmann/json.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of sections and entries. */
    using Tree = nlohmann::ordered_json;



    bool
    is_entry(const Tree &node)
    {
      return node.contains("pattern_description");
    }



    /** Text that does not end a cell of a table or begin an HTML tag. */
    std::string
    in_cell(const std::string &text)
    {
      std::string cell;
      for (const char c : text)
        cell += c == '|'  ? std::string("\\|") :
                c == '<'  ? std::string("&lt;") :
                c == '>'  ? std::string("&gt;") :
                c == '*'  ? std::string("\\*") :
                c == '\n' ? std::string(" ") :
                            std::string(1, c);
      return cell;
    }



    /** A value, or both if they differ. */
    std::string
    both(const std::string &in_2d, const std::string &in_3d)
    {
      const auto quoted = [](const std::string &value) {
        return value.empty() ? "" : "`" + value + "`";
      };
      return in_2d == in_3d ? quoted(in_2d) :
                              quoted(in_2d) + ", 3D " + quoted(in_3d);
    }



    /** Of a section, in 2D and in 3D; either may lack it. */
    void
    print_section(const Tree        &in_2d,
                  const Tree        &in_3d,
                  const std::string &path,
                  std::ostream      &out)
    {
      static const Tree nothing = Tree::object();
      const auto        other   = [](const Tree        &tree,
                            const std::string &name) -> const Tree          &{
        const auto found = tree.find(name);
        return found == tree.end() ? nothing : *found;
      };
      // In the order of 3D, and what 2D has alone.
      std::vector<std::string> names;
      for (const Tree *tree : {&in_3d, &in_2d})
        for (const auto &[name, child] : tree->items())
          if (!contains(names, name))
            names.push_back(name);
      bool has_entries = false;
      for (const std::string &name : names)
        {
          const Tree &a = other(in_2d, name), &b = other(in_3d, name);
          if (!is_entry(a) && !is_entry(b))
            continue;
          if (!has_entries)
            out << "\n## " << (path.empty() ? "(top)" : in_cell(path))
                << "\n\n| key | default | allowed | meaning |\n"
                << "|---|---|---|---|\n";
          has_entries     = true;
          const Tree &one = is_entry(a) ? a : b;
          const auto  get = [](const Tree &tree, const Tree &otherwise) {
            return (is_entry(tree) ? tree : otherwise)
              .at("default_value")
              .get<std::string>();
          };
          out << "| " << name
              << (!is_entry(a) ? " (3D only)" :
                  !is_entry(b) ? " (2D only)" :
                                 "")
              << " | " << both(get(a, b), get(b, a)) << " | "
              << in_cell(
                   describe(one.at("pattern_description").get<std::string>()))
              << " | " << in_cell(one.at("documentation").get<std::string>())
              << " |\n";
        }
      for (const std::string &name : names)
        {
          const Tree &a = other(in_2d, name), &b = other(in_3d, name);
          if (!is_entry(a) && !is_entry(b))
            print_section(a, b, path.empty() ? name : path + "/" + name, out);
        }
    }



    template <int dim>
    Tree
    tree_of_parameters()
    {
      Scene<dim>        scene;
      std::stringstream json;
      scene.parameters().print_parameters(
        json, ParameterHandler::JSON | ParameterHandler::KeepDeclarationOrder);
      return Tree::parse(json);
    }
  } // namespace



  void
  print_parameter_reference(std::ostream &out)
  {
    out << "# Parameters\n\n"
           "Written by `moraine parameters`. A heading is the path of a "
           "section; `<name>` is any name you like.\nUnits are yours: length, "
           "stress, time and mass have to fit each other.\nSection "
           "`Constants` holds names of your own: with `set h = 0.2` there, "
           "`$h` in any value stands for 0.2.\nWhere a number is wanted, "
           "arithmetic gives it: `100/7`, `2*$h`, `sqrt(2)*pi`, in lists too; "
           "a constant that is arithmetic or an expression stands for its "
           "value. In tables and lists that blanks separate, write it without "
           "blanks.\n";
    print_section(tree_of_parameters<2>(), tree_of_parameters<3>(), "", out);
  }
} // namespace moraine
